// SPDX-License-Identifier: MIT
#include "techniques/tam/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "style/color.hpp"

namespace estampe::tam {
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
            // The last few, too small to tell apart, would run out of the column.
            if (level < 2 || corner.x + size_px <= margin_px + (tone + 1) * (map.size_px + margin_px)) {
                paste(sheet, map.level_of_tone[tone][level], size_px, corner, colors);
            }
            corner.x += level == 0 ? 0 : size_px + margin_px / 3;
        }
    }
    return sheet;
}

} // namespace estampe::tam
