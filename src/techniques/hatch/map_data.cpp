// SPDX-License-Identifier: MIT
#include "techniques/hatch/map_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include "gpu/upload.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {
namespace {

using shared::ramp_length;
using shared::ramp_rows;
using shared::ramp_steps;

/// Levels coarser than this hold too few strokes to measure.
constexpr uint32_t smallest_measured_px = 32;

float contrasted(float value, float contrast)
{
    return std::clamp((value - 0.5F) * contrast + 0.5F, 0.0F, 1.0F);
}

/// One row: for darknesses from 0 to 1 the x in [low, high] at which `ink_at`, which rises, is that dark.
void invert(const std::function<double(double)>& ink_at, double low, double high, float* row)
{
    constexpr int samples = 512;
    std::array<double, samples + 1> ink{};
    const auto x_of = [&](int i) { return low + (high - low) * i / samples; };
    for (int i = 0; i <= samples; ++i) {
        ink.at(static_cast<size_t>(i)) = ink_at(x_of(i));
    }
    int at = 0;
    for (uint32_t i = 0; i < ramp_length; ++i) {
        const double wanted = static_cast<double>(i) / (ramp_length - 1);
        while (at + 1 < samples && ink.at(static_cast<size_t>(at) + 1) < wanted) {
            ++at;
        }
        const double below = ink.at(static_cast<size_t>(at));
        const double above = ink.at(static_cast<size_t>(at) + 1);
        const double part = above > below ? std::clamp((wanted - below) / (above - below), 0.0, 1.0) : 0.0;
        row[i] = static_cast<float>(x_of(at) + part * (x_of(at + 1) - x_of(at)));
    }
}

/// How often each threshold occurs between a level and a coarser one, in 1024 classes.
using Histogram = std::array<double, 1024>;

/// Mean ink of texels with these thresholds when asked for `asked`.
double ink_of(const Histogram& histogram, double asked, float contrast)
{
    double sum = 0.0;
    for (size_t i = 0; i < histogram.size(); ++i) {
        const double threshold = (static_cast<double>(i) + 0.5) / static_cast<double>(histogram.size());
        sum +=
            histogram.at(i) * std::clamp((asked - threshold) * static_cast<double>(contrast) + 0.5, 0.0, 1.0);
    }
    return sum;
}

/// Samples `image`, of `side` texels, in between them, at (x, y) in texels of its own.
float sampled(const std::vector<uint8_t>& image, uint32_t side, float x, float y)
{
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const auto texel = [&](float column, float row) {
        const auto wrap = [&](float value) {
            return static_cast<uint32_t>(static_cast<int>(value)) & (side - 1);
        };
        return static_cast<float>(image[static_cast<size_t>(wrap(row)) * side + wrap(column)]) / 255.0F;
    };
    const float across = x - 0.5F - left;
    const float down = y - 0.5F - top;
    return std::lerp(std::lerp(texel(left, top), texel(left + 1, top), across),
                     std::lerp(texel(left, top + 1), texel(left + 1, top + 1), across), down);
}

/// Adds the thresholds `step` sixteenths of the way from `fine` to `coarse`; `coarse_per_fine` is how far one
/// goes in texels of the coarse image as one goes one in those of the fine.
void count(Histogram& histogram, const std::vector<uint8_t>& fine, uint32_t fine_side,
           const std::vector<uint8_t>& coarse, uint32_t coarse_side, uint32_t step)
{
    const float towards = (static_cast<float>(step) + 0.5F) / static_cast<float>(ramp_steps);
    const uint32_t stride = std::max(fine_side / 128, 1U);
    for (uint32_t y = 0; y < fine_side; y += stride) {
        for (uint32_t x = 0; x < fine_side; x += stride) {
            const float here = static_cast<float>(fine[static_cast<size_t>(y) * fine_side + x]) / 255.0F;
            const float there = sampled(coarse, coarse_side, 0.5F * (static_cast<float>(x) + 0.5F),
                                        0.5F * (static_cast<float>(y) + 0.5F));
            const float threshold = std::lerp(here, there, towards);
            const auto at = static_cast<size_t>(threshold * static_cast<float>(histogram.size()));
            histogram.at(std::min(at, histogram.size() - 1)) += 1.0;
        }
    }
}

void normalise(Histogram& histogram)
{
    double sum = 0.0;
    for (const double share : histogram) {
        sum += share;
    }
    for (double& share : histogram) {
        share /= std::max(sum, 1.0);
    }
}

/// Mean ink between tones `tone` and the next, over all levels that are large enough; 0 is paper.
double ink_between(const MapData& map, double tone, float contrast)
{
    const auto lower = static_cast<size_t>(tone);
    const auto part = static_cast<float>(tone - static_cast<double>(lower));
    const auto value = [&](size_t of_tone, size_t level, size_t i) {
        if (of_tone == 0 || of_tone > map.level_of_tone.size()) {
            return of_tone == 0 ? 0.0F : 1.0F;
        }
        return static_cast<float>(map.level_of_tone[of_tone - 1][level][i]) / 255.0F;
    };
    double sum = 0.0;
    double samples = 0.0;
    for (size_t level = 0; map.size_px >> level >= smallest_measured_px; ++level) {
        const size_t texels = map.level_of_tone.front()[level].size();
        const size_t stride = std::max<size_t>(texels / 4093, 1) | 1U;
        for (size_t i = 0; i < texels; i += stride) {
            sum += static_cast<double>(
                contrasted(std::lerp(value(lower, level, i), value(lower + 1, level, i), part), contrast));
            samples += 1.0;
        }
    }
    return sum / std::max(samples, 1.0);
}

} // namespace

std::vector<float> measured_ramp(const MapData& map, float contrast)
{
    std::vector<float> ramp(static_cast<size_t>(ramp_rows) * ramp_length);
    const double margin = 0.5 / static_cast<double>(std::max(contrast, 1.0F));
    for (uint32_t step = 0; step < ramp_steps; ++step) {
        Histogram between_levels{};
        for (size_t level = 0; map.size_px >> (level + 1) >= smallest_measured_px; ++level) {
            const uint32_t side = map.size_px >> level;
            count(between_levels, map.threshold_of_level[level], side, map.threshold_of_level[level + 1],
                  side / 2, step);
        }
        Histogram over_itself{};
        count(over_itself, map.threshold_of_level[0], map.size_px, map.threshold_of_level[0], map.size_px,
              step);
        for (Histogram* histogram : {&between_levels, &over_itself}) {
            normalise(*histogram);
            const uint32_t row = step + (histogram == &over_itself ? ramp_steps : 0U);
            invert([&](double asked) { return ink_of(*histogram, asked, contrast); }, -margin, 1.0 + margin,
                   &ramp[static_cast<size_t>(row) * ramp_length]);
        }
    }
    const double last = static_cast<double>(map.level_of_tone.size()) + 1.0;
    invert([&](double tone) { return ink_between(map, std::min(tone, last - 1e-6), contrast); }, 0.0, last,
           &ramp[static_cast<size_t>(ramp_rows - 1) * ramp_length]);
    return ramp;
}

MapImages upload_map(gpu::Device& device, const MapData& map, float contrast)
{
    MapImages images;
    images.size_px = map.size_px;
    images.tone_count = static_cast<uint32_t>(map.level_of_tone.size());
    images.level_count = static_cast<uint32_t>(map.threshold_of_level.size());
    const auto upload = [&](const std::vector<const std::vector<std::vector<uint8_t>>*>& layers) {
        const gpu::ImageDesc desc{.width = map.size_px,
                                  .height = map.size_px,
                                  .format = gpu::Format::r8,
                                  .layers = static_cast<uint32_t>(layers.size()),
                                  .mips = images.level_count};
        gpu::Image image(device, "tonal art map", desc, true);
        gpu::upload_layers(device, image, [&](uint32_t layer) {
            gpu::LayerPixels pixels;
            for (const std::vector<uint8_t>& level : *layers[layer]) {
                const auto bytes = std::as_bytes(std::span(level));
                pixels.levels.emplace_back(bytes.begin(), bytes.end());
            }
            return pixels;
        });
        return image;
    };
    std::vector<const std::vector<std::vector<uint8_t>>*> tones;
    for (const auto& tone : map.level_of_tone) {
        tones.push_back(&tone);
    }
    images.tones = upload(tones);
    images.thresholds = upload({&map.threshold_of_level});
    images.ramp = gpu::upload_buffer(device, "ramp", measured_ramp(map, contrast));
    return images;
}

} // namespace estampe::hatch
