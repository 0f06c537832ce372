// SPDX-License-Identifier: MIT
#include "viewer/ground.hpp"

#include <algorithm>
#include <cmath>

#include "scene/static_triangles.hpp"

namespace estampe::viewer {
namespace {

/// Twice the area of a triangle seen from above, with its sign.
float area_above(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

} // namespace

Ground::Ground(const Scene& scene)
{
    const StaticTriangles all = static_triangles(scene);
    anchor_ = all.anchor;
    for (size_t i = 0; i + 2 < all.positions.size(); i += 3) {
        const std::array corners{all.positions[i], all.positions[i + 1], all.positions[i + 2]};
        if (area_above(corners[0], corners[1], corners[2]) != 0.0F) {
            triangles_.push_back(corners);
        }
    }
}

std::optional<double> Ground::height_under(const glm::dvec3& place) const
{
    const glm::vec3 from(place - anchor_);
    std::optional<float> highest;
    for (const auto& [a, b, c] : triangles_) {
        if (from.x < std::min({a.x, b.x, c.x}) || from.x > std::max({a.x, b.x, c.x}) ||
            from.z < std::min({a.z, b.z, c.z}) || from.z > std::max({a.z, b.z, c.z})) {
            continue;
        }
        const float whole = area_above(a, b, c);
        const float by_a = area_above(from, b, c) / whole;
        const float by_b = area_above(a, from, c) / whole;
        const float by_c = 1.0F - by_a - by_b;
        const float y = by_a * a.y + by_b * b.y + by_c * c.y;
        if (by_a >= 0.0F && by_b >= 0.0F && by_c >= 0.0F && y <= from.y && (!highest || y > *highest)) {
            highest = y;
        }
    }
    return highest ? std::optional(anchor_.y + static_cast<double>(*highest)) : std::nullopt;
}

} // namespace estampe::viewer
