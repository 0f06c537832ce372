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

constexpr double visible_step = 1e-4;

} // namespace

void warn_of_far_nodes(Scene& scene)
{
    const Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0, no_index));
    double farthest = 0.0;
    size_t shown = 0;
    for (const Node& node : scene.nodes) {
        const glm::dvec3 place = node.matrix ? glm::dvec3((*node.matrix)[3]) : node.transform.translation;
        farthest = std::max(farthest, glm::length(place));
        shown += node.mesh != no_index ? 1 : 0;
    }
    const double step = farthest * static_cast<double>(std::numeric_limits<float>::epsilon());
    // In the file's unit, which is that of the scene's size but for the scale of the root.
    const double unit_m =
        scene.roots.empty()
            ? 1.0
            : glm::length(glm::dvec3(scene.nodes[scene.roots.front()].matrix.value_or(glm::dmat4(1.0))[0]));
    if (shown > 1 && bounds.radius() > 0.0 && step * unit_m > visible_step * bounds.radius())
        scene.warnings.push_back(fmt::format("nodes lie so far from the origin that they are placed to "
                                             "{:.2g} m only; move the scene to the origin "
                                             "in the program that wrote the file",
                                             step * unit_m));
}

void warn_of_far_meshes(Scene& scene)
{
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
