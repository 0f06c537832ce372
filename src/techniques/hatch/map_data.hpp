// SPDX-License-Identifier: MIT
#pragma once

// Tonal art maps on the GPU, and what darkness to ask them for.

#include <cstdint>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {

/// How a map's tones come together.
enum class MapTone : uint8_t {
    order = shared::map_in_order,  ///< stroke by stroke, by the thresholds
    blend = shared::map_in_blends, ///< between two tones, with contrast about the middle
    step = shared::map_in_steps    ///< one tone or the next
};

/// A tonal art map as the shading takes it: squares of 8-bit texels, row by row from the top, from the finest
/// level of `size_px` texels a side, a power of two, to the last of one.
struct MapData {
    uint32_t size_px = 0;
    std::vector<std::vector<std::vector<uint8_t>>> level_of_tone; ///< coverage, 255 ink; lightest tone first
    std::vector<std::vector<uint8_t>> threshold_of_level; ///< darkness times 255 at which a texel is inked
};

/// The ramp that hatch.glsl.h describes, for a way to bring tones together and the contrast of the shading:
/// found by measuring the map, so that the mean ink is the darkness wanted, at every level and between any
/// two, whatever the map's own tones are. Cost: 60 ms for 512 px.
[[nodiscard]] std::vector<float> measured_ramp(const MapData& map, MapTone tone, float contrast);

struct MapImages {
    gpu::Image tones;      ///< r8, a layer a tone
    gpu::Image thresholds; ///< r8
    gpu::Buffer ramp;
    uint32_t size_px = 0;
    uint32_t tone_count = 0;
    uint32_t level_count = 0;
};

/// `map` has at least one tone. Throws Error when memory runs out.
[[nodiscard]] MapImages upload_map(gpu::Device& device, const MapData& map, MapTone tone, float contrast);

} // namespace estampe::hatch
