// SPDX-License-Identifier: MIT
#include "techniques/hatch/hatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>

#include "gpu/resources.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {
namespace {

using shared::ramp_length;
using shared::ramp_steps;

/// Largest number of places along a side at which a mip level is measured.
constexpr uint32_t measured_side = 96;

/// Fills one row of the ramp with the inverse of the increasing function `ink_at`. The row contains, for each
/// darkness from 0 to 1, the argument x in [low, high] at which the function `ink_at` reaches that darkness.
void invert(const std::function<double(double)>& ink_at, double low, double high, float* row)
{
    constexpr size_t samples = 256;
    std::array<double, samples + 1> ink{};
    const auto x_of = [&](size_t i) { return low + (high - low) * static_cast<double>(i) / samples; };
    for (size_t i = 0; i <= samples; ++i) {
        ink.at(i) = ink_at(x_of(i));
    }
    size_t at = 0;
    for (uint32_t i = 0; i < ramp_length; ++i) {
        const double wanted = static_cast<double>(i) / (ramp_length - 1);
        while (at + 1 < samples && ink.at(at + 1) < wanted) {
            ++at;
        }
        const double rise = ink.at(at + 1) - ink.at(at);
        const double part = rise > 0.0 ? std::clamp((wanted - ink.at(at)) / rise, 0.0, 1.0) : 0.0;
        row[i] = static_cast<float>(x_of(at) + part * (x_of(at + 1) - x_of(at)));
    }
}

/// A bilinear lookup in an image: the values of the four nearest texels, from 0 to 1, and their weights.
struct Four {
    std::array<float, 4> value;
    std::array<float, 4> share;

    [[nodiscard]] float blended() const
    {
        return std::inner_product(value.begin(), value.end(), share.begin(), 0.0F);
    }
};

Four four_at(const std::vector<uint8_t>& image, uint32_t side, float x, float y)
{
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const float across = x - 0.5F - left;
    const float down = y - 0.5F - top;
    Four four{};
    for (uint32_t i = 0; i < 4; ++i) {
        const auto right = static_cast<float>(i & 1U);
        const auto below = static_cast<float>(i >> 1U);
        const auto column = static_cast<uint32_t>(static_cast<int>(left + right)) & (side - 1);
        const auto row = static_cast<uint32_t>(static_cast<int>(top + below)) & (side - 1);
        four.value.at(i) = static_cast<float>(image[static_cast<size_t>(row) * side + column]) / 255.0F;
        four.share.at(i) = std::lerp(1.0F - across, across, right) * std::lerp(1.0F - down, down, below);
    }
    return four;
}

/// Texels looked up in a mip level and, at equal places, in the next coarser mip level.
struct Pair {
    std::vector<Four> fine;
    std::vector<Four> coarse;
};

/// Samples a mip level and the next coarser level. If the number `level` is -1, samples the finest mip level
/// repeated at half the size, and the finest mip level itself.
Pair pair_of(const std::vector<std::vector<uint8_t>>& levels, uint32_t size_px, int level)
{
    const auto fine_level = static_cast<size_t>(std::max(level, 0));
    const size_t coarse_level = level < 0 ? 0 : fine_level + 1;
    const uint32_t fine_side = std::max(size_px >> fine_level, 1U);
    const uint32_t coarse_side = std::max(size_px >> coarse_level, 1U);
    // Pixels of the page may lie anywhere between the map's texel centres. So the samples also lie at several
    // positions within a texel.
    const uint32_t count = std::min(std::max(2 * fine_side, 8U), measured_side);
    const float step = static_cast<float>(fine_side) / static_cast<float>(count);
    Pair pair;
    for (uint32_t y = 0; y < count; ++y) {
        for (uint32_t x = 0; x < count; ++x) {
            const float at_x =
                step * static_cast<float>(x) + 0.25F * static_cast<float>((x + 2 * y) % 4) + 0.125F;
            const float at_y =
                step * static_cast<float>(y) + 0.25F * static_cast<float>((2 * x + y) % 4) + 0.125F;
            pair.fine.push_back(four_at(levels[fine_level], fine_side, at_x, at_y));
            pair.coarse.push_back(four_at(levels[coarse_level], coarse_side, 0.5F * at_x, 0.5F * at_y));
        }
    }
    return pair;
}

double contrasted(double value, double contrast)
{
    return std::clamp((value - 0.5) * contrast + 0.5, 0.0, 1.0);
}

/// Computes one row of the ramp from thresholds. `towards` is the blend from the finer mip level (0) to the
/// coarser mip level (1).
void measure_order(const Pair& thresholds, float towards, double contrast, float* row)
{
    std::array<double, 512> shares{};
    for (size_t i = 0; i < thresholds.fine.size(); ++i) {
        for (uint32_t k = 0; k < 16; ++k) {
            const Four& fine = thresholds.fine[i];
            const Four& coarse = thresholds.coarse[i];
            const float threshold = std::lerp(fine.value.at(k % 4), coarse.value.at(k / 4), towards);
            const auto at = static_cast<size_t>(threshold * static_cast<float>(shares.size()));
            shares.at(std::min(at, shares.size() - 1)) +=
                static_cast<double>(fine.share.at(k % 4) * coarse.share.at(k / 4)) /
                static_cast<double>(thresholds.fine.size());
        }
    }
    const auto ink_at = [&](double asked) {
        double sum = 0.0;
        for (size_t i = 0; i < shares.size(); ++i) {
            const double threshold = (static_cast<double>(i) + 0.5) / static_cast<double>(shares.size());
            sum += shares.at(i) * std::clamp((asked - threshold) * contrast + 0.5, 0.0, 1.0);
        }
        return sum;
    };
    invert(ink_at, -0.5 / contrast, 1.0 + 0.5 / contrast, row);
}

/// Computes one row of the ramp from the tones between paper and full ink.
void measure_layers(const std::vector<Pair>& tones, float towards, double contrast, float* row)
{
    constexpr int per_tone = 8;
    const size_t last = tones.size() + 1;
    const auto value = [&](size_t tone, size_t i) {
        if (tone == 0 || tone >= last) {
            return tone == 0 ? 0.0F : 1.0F;
        }
        return std::lerp(tones[tone - 1].fine[i].blended(), tones[tone - 1].coarse[i].blended(), towards);
    };
    std::vector<double> ink;
    const size_t count = tones.front().fine.size();
    for (size_t step = 0; step <= last * per_tone; ++step) {
        const size_t tone = step / per_tone;
        const float part = static_cast<float>(step % per_tone) / per_tone;
        double sum = 0.0;
        for (size_t i = 0; i < count; ++i) {
            sum += contrasted(static_cast<double>(std::lerp(value(tone, i), value(tone + 1, i), part)),
                              contrast);
        }
        ink.push_back(sum / static_cast<double>(count));
    }
    const auto ink_at = [&](double tone) {
        const double at = std::min(tone * per_tone, static_cast<double>(ink.size() - 1) - 1e-9);
        const auto first = static_cast<size_t>(at);
        return std::lerp(ink[first], ink[first + 1], at - static_cast<double>(first));
    };
    invert(ink_at, 0.0, static_cast<double>(last), row);
}

} // namespace

std::vector<float> measured_ramp(const MapData& map, MapTone tone, float contrast)
{
    const int levels = static_cast<int>(map.threshold_of_level.size());
    std::vector<float> ramp(static_cast<size_t>(levels) * ramp_steps * ramp_length);
    float* row = ramp.data();
    for (int level = -1; level + 1 < levels; ++level) {
        const Pair thresholds = pair_of(map.threshold_of_level, map.size_px, level);
        std::vector<Pair> tones;
        for (const auto& images : map.level_of_tone) {
            tones.push_back(pair_of(images, map.size_px, level));
        }
        for (uint32_t step = 0; step < ramp_steps; ++step, row += ramp_length) {
            const float towards = static_cast<float>(step) / static_cast<float>(ramp_steps - 1);
            if (tone == MapTone::order) {
                measure_order(thresholds, towards, static_cast<double>(contrast), row);
            } else {
                measure_layers(tones, towards, static_cast<double>(contrast), row);
            }
        }
    }
    return ramp;
}

MapImages upload_map(gpu::Device& device, const MapData& map, MapTone tone, float contrast)
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
    for (const auto& levels : map.level_of_tone) {
        tones.push_back(&levels);
    }
    images.tones = upload(tones);
    images.thresholds = upload({&map.threshold_of_level});
    images.ramp = gpu::upload_buffer(device, "ramp", measured_ramp(map, tone, contrast));
    return images;
}

} // namespace estampe::hatch
