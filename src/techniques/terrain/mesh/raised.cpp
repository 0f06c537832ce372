// SPDX-License-Identifier: MIT
#include "techniques/terrain/mesh/mesh_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace estampe::terrain {
namespace {

/// The side of a square of which there are as many as pairs of triangles, over the plane.
float spacing_of(const ObjectTriangles& object)
{
    double area = 0.0;
    for (const glm::uvec3& triangle : object.triangles) {
        const glm::dvec3 a = object.places[triangle.x];
        const glm::dvec3 b = object.places[triangle.y] - a;
        const glm::dvec3 c = object.places[triangle.z] - a;
        area += 0.5 * std::abs(b.x * c.z - b.z * c.x);
    }
    const auto pairs = static_cast<double>(std::max<size_t>(object.triangles.size() / 2, 1));
    return static_cast<float>(std::sqrt(area / pairs));
}

} // namespace

Raised::Raised(ObjectTriangles object) : object_(std::move(object)), spacing_m_(spacing_of(object_)) {}

MeshTopology Raised::topology() const
{
    return {.places = object_.places,
            .vertices = std::vector<uint32_t>(object_.places.size()),
            .triangles = object_.triangles};
}

std::vector<shared::TerrainLevel> Raised::place(const EyePlace& /*eye*/, const glm::dvec2& anchor_m) const
{
    constexpr float never = std::numeric_limits<float>::max();
    return {{.origin_m = glm::vec2(-anchor_m), .cell_m = spacing_m_, .fade_from = never, .fade_to = never}};
}

} // namespace estampe::terrain
