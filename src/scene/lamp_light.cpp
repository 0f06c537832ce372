// SPDX-License-Identifier: MIT
#include "scene/lamp_light.hpp"

#include <algorithm>
#include <cmath>

namespace estampe {

float share_along(const SpotBeam& beam, const glm::vec3& along)
{
    float cosine = glm::dot(along, beam.direction);
    if (beam.shape == SpotShape::pyramid) {
        // The angle to the nearest of the sides counts.
        const float aside = std::max(std::abs(glm::dot(along, beam.side)),
                                     std::abs(glm::dot(along, glm::cross(beam.side, beam.direction))));
        cosine /= std::sqrt(std::max(cosine * cosine + aside * aside, 1e-12F));
    }
    const float cone = std::clamp(cosine * beam.cone_scale + beam.cone_offset, 0.0F, 1.0F);
    return cone * cone;
}

float weakened(LightFalloff falloff, float range_m, float distance_2)
{
    const float ratio = range_m > 0.0F ? distance_2 / (range_m * range_m) : 0.0F;
    return falloff == LightFalloff::unit_volume ? std::max(1.0F - ratio, 0.0F)
                                                : std::clamp(1.0F - ratio * ratio, 0.0F, 1.0F) / distance_2;
}

} // namespace estampe
