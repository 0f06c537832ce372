// SPDX-License-Identifier: MIT
#include "techniques/tam/tonal_art_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "style/parameter.hpp"

namespace estampe::tam {
namespace {

void check_images(const std::vector<Gray8>& levels, uint32_t size_px, const std::string& what,
                  const std::string& where)
{
    const size_t wanted = level_count(size_px);
    if (levels.size() != wanted) {
        throw Error(fmt::format("{} has {} levels", what, levels.size()), where,
                    fmt::format("a map of {} px has {}", size_px, wanted));
    }
    for (size_t level = 0; level < wanted; ++level) {
        const size_t side = size_px >> level;
        if (levels[level].size() != side * side) {
            throw Error(fmt::format("level {} of {} has {} texels", level, what, levels[level].size()), where,
                        fmt::format("it must be {0} x {0}", side));
        }
    }
}

/// Returns the darkness between `a` and `b` at which a texel's coverage passes one half, by linear
/// interpolation.
float crossing(float a, float coverage_of_a, float b, float coverage_of_b)
{
    const float rise = coverage_of_b - coverage_of_a;
    return rise <= 0.0F ? b : a + (b - a) * std::clamp((0.5F - coverage_of_a) / rise, 0.0F, 1.0F);
}

} // namespace

size_t level_count(uint32_t size_px)
{
    return static_cast<size_t>(std::bit_width(size_px));
}

double mean_coverage(const Gray8& image)
{
    uint64_t sum = 0;
    for (const uint8_t texel : image) {
        sum += texel;
    }
    return image.empty() ? 0.0 : static_cast<double>(sum) / (255.0 * static_cast<double>(image.size()));
}

Gray8 half_size(const Gray8& image, uint32_t size_px)
{
    const size_t side = size_px / 2;
    Gray8 half(side * side);
    for (size_t y = 0; y < side; ++y) {
        for (size_t x = 0; x < side; ++x) {
            const uint8_t* upper = image.data() + 2 * y * size_px + 2 * x;
            const uint8_t* lower = upper + size_px;
            half[y * side + x] = static_cast<uint8_t>((upper[0] + upper[1] + lower[0] + lower[1] + 2) / 4);
        }
    }
    return half;
}

void check_map(const TonalArtMap& map, const std::string& where)
{
    if (!std::has_single_bit(map.size_px) || map.size_px < min_size_px || map.size_px > max_size_px) {
        throw Error(fmt::format("a tonal art map of {} px", map.size_px), where,
                    fmt::format("its side must be a power of two from {} to {}", min_size_px, max_size_px));
    }
    if (map.darkness.size() < min_tones || map.darkness.size() > max_tones ||
        map.darkness.size() != map.level_of_tone.size()) {
        throw Error(fmt::format("{} darknesses for {} tones", map.darkness.size(), map.level_of_tone.size()),
                    where, fmt::format("there must be as many, {} to {}", min_tones, max_tones));
    }
    float last = 0.0F;
    for (size_t tone = 0; tone < map.darkness.size(); ++tone) {
        const float darkness = map.darkness[tone];
        if (!(darkness > last && darkness < 1.0F)) {
            throw Error(fmt::format("tone {} has darkness {}", tone, darkness), where,
                        "darkness must rise from tone to tone, between 0 and 1");
        }
        last = darkness;
        check_images(map.level_of_tone[tone], map.size_px, fmt::format("tone {}", tone), where);
    }
    if (!map.threshold_of_level.empty()) {
        check_images(map.threshold_of_level, map.size_px, "the set of thresholds", where);
    }
}

Gray8 interpolated_thresholds(const TonalArtMap& map, size_t level)
{
    Gray8 result(map.level_of_tone.front()[level].size());
    for (size_t texel = 0; texel < result.size(); ++texel) {
        float before = 0.0F;
        float coverage_before = 0.0F;
        float threshold = 1.0F;
        bool found = false;
        for (size_t tone = 0; tone < map.darkness.size() && !found; ++tone) {
            const float coverage = static_cast<float>(map.level_of_tone[tone][level][texel]) / 255.0F;
            found = coverage > 0.5F;
            if (found) {
                threshold = crossing(before, coverage_before, map.darkness[tone], coverage);
            }
            before = map.darkness[tone];
            coverage_before = std::max(coverage_before, coverage);
        }
        if (!found) {
            threshold = crossing(before, coverage_before, 1.0F, 1.0F);
        }
        result[texel] = static_cast<uint8_t>(std::lround(threshold * 255.0F));
    }
    return result;
}

std::vector<Gray8> threshold_levels(const TonalArtMap& map)
{
    if (!map.threshold_of_level.empty()) {
        return map.threshold_of_level;
    }
    std::vector<Gray8> levels;
    for (size_t level = 0; level < level_count(map.size_px); ++level) {
        levels.push_back(interpolated_thresholds(map, level));
    }
    return levels;
}

namespace {

using Pixel = std::array<uint8_t, 4>;

void paste(Image& sheet, const Gray8& level, uint32_t size_px, glm::uvec2 corner,
           const std::array<Pixel, 256>& colors)
{
    for (uint32_t y = 0; y < size_px; ++y) {
        for (uint32_t x = 0; x < size_px; ++x) {
            const Pixel& color = colors[level[size_t{y} * size_px + x]];
            const size_t at = (size_t{corner.y + y} * sheet.width + corner.x + x) * 4;
            std::copy(color.begin(), color.end(), sheet.rgba.begin() + static_cast<std::ptrdiff_t>(at));
        }
    }
}

} // namespace

Image preview_sheet(const TonalArtMap& map, const glm::vec3& paper, const glm::vec3& ink)
{
    constexpr uint32_t margin_px = 12;
    std::array<Pixel, 256> colors{};
    for (size_t coverage = 0; coverage < colors.size(); ++coverage) {
        const glm::vec3 linear = glm::mix(paper, ink, static_cast<float>(coverage) / 255.0F);
        const glm::dvec3 encoded = style::srgb_from_linear(linear);
        for (int channel = 0; channel < 3; ++channel) {
            colors[coverage][static_cast<size_t>(channel)] =
                static_cast<uint8_t>(std::lround(255.0 * encoded[channel]));
        }
        colors[coverage][3] = 255;
    }
    const auto tones = static_cast<uint32_t>(map.darkness.size());
    Image sheet;
    sheet.width = margin_px + tones * (map.size_px + margin_px);
    sheet.height = 3 * margin_px + map.size_px + map.size_px / 2;
    for (size_t pixel = 0; pixel < size_t{sheet.width} * sheet.height; ++pixel) {
        sheet.rgba.insert(sheet.rgba.end(), colors[0].begin(), colors[0].end());
    }
    for (uint32_t tone = 0; tone < tones; ++tone) {
        glm::uvec2 corner(margin_px + tone * (map.size_px + margin_px), margin_px);
        for (uint32_t level = 0; level < map.level_of_tone[tone].size(); ++level) {
            const uint32_t size_px = map.size_px >> level;
            if (level == 1) {
                corner.y += map.size_px + margin_px;
            }
            // The last few mip levels are skipped if they do not fit into the column; they are too small to
            // be seen.
            if (level < 2 || corner.x + size_px <= margin_px + (tone + 1) * (map.size_px + margin_px)) {
                paste(sheet, map.level_of_tone[tone][level], size_px, corner, colors);
            }
            corner.x += level == 0 ? 0 : size_px + margin_px / 3;
        }
    }
    return sheet;
}

} // namespace estampe::tam
