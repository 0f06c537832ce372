// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <estampe/lightmap.hpp>

#include "scene/charts/charts.hpp"

namespace estampe::bake {

/// What is known of the light of one texel.
struct Estimate {
    glm::vec3 light{0.0F};
    float variance = 0.0F; ///< of the brightness of `light`
    glm::vec3 place{0.0F};
    glm::vec3 normal{0.0F};
    bool known = true; ///< false inside of solid things
};

/// Averages each texel with those up to three texels away that lie on the same surface and differ by no more
/// than their noise: a bilateral filter after Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform",
/// 2010, at one scale. Cost: 49 looks a texel.
[[nodiscard]] std::vector<glm::vec3> smoothed(std::span<const charts::Texel> texels,
                                              std::span<const Estimate> estimates, uint32_t size);

/// Lays the texels out as a picture, gives those that are not known the mean of their neighbours, and
/// spreads the edges of charts into their gutters.
[[nodiscard]] LightImage spread(std::span<const charts::Texel> texels, std::span<const Estimate> estimates,
                                std::span<const glm::vec3> light, uint32_t size);

} // namespace estampe::bake
