// SPDX-License-Identifier: MIT
#include <algorithm>

#include "techniques/light/light.hpp"

namespace estampe::light {

Paling ground_paling(const Bounds& bounds, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                     float most)
{
    constexpr double lowest_sun = 0.02; // below it shadows have no end
    const glm::dvec3 level(-towards_sun.x, 0.0, -towards_sun.z);
    if (bounds.empty() || towards_sun.y < lowest_sun || glm::length(level) < 1e-6) {
        return {};
    }
    const glm::dvec3 away = glm::normalize(level);
    const double thrown_m = glm::length(level) / towards_sun.y * (bounds.max.y - bounds.min.y);
    const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
    const double end_m = std::max(thrown_m + std::abs(away.x) * half.x + std::abs(away.z) * half.z, 1e-9);
    const glm::dvec3 share_per_m = away * (static_cast<double>(most) / end_m);
    return {.share_per_m = glm::vec3(share_per_m),
            .share_at_anchor = static_cast<float>(glm::dot(share_per_m, anchor - bounds.center()))};
}

} // namespace estampe::light
