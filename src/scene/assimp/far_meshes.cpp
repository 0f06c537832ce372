// SPDX-License-Identifier: MIT
#include "scene/assimp/far_meshes.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace estampe {
namespace {

/// How far apart neighbouring floats are at the far end of a mesh, in parts of its size.
double step_in_sizes(const Mesh& mesh)
{
    Bounds bounds;
    for (const Primitive& primitive : mesh.primitives)
        for (const glm::vec3& position : primitive.positions)
            bounds.extend(position);
    const glm::dvec3 size = bounds.max - bounds.min;
    const double length = std::max({size.x, size.y, size.z});
    const glm::dvec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const double farthest = std::max({reach.x, reach.y, reach.z});
    if (bounds.empty() || !(length > 0.0))
        return 0.0;
    return farthest * static_cast<double>(std::numeric_limits<float>::epsilon()) / length;
}

} // namespace

void warn_of_far_meshes(Scene& scene)
{
    constexpr double visible_step = 1e-4;
    size_t count = 0;
    double coarsest = 0.0;
    std::string name;
    for (const Mesh& mesh : scene.meshes) {
        const double step = step_in_sizes(mesh);
        if (!(step > visible_step))
            continue;
        ++count;
        if (step > coarsest) {
            coarsest = step;
            name = mesh.name;
        }
    }
    if (count > 0)
        scene.warnings.push_back(fmt::format(
            "{} mesh{} lie{} too far from the origin for their coordinates to be read exactly: \"{}\" by "
            "1/{:.0f} "
            "of its size; move the model to the origin in the program that wrote the file",
            count, count == 1 ? "" : "es", count == 1 ? "s" : "", name, std::max(1.0, 1.0 / coarsest)));
}

} // namespace estampe
