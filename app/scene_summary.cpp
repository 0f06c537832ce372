// SPDX-License-Identifier: MIT
#include "scene_summary.hpp"

#include <algorithm>

#include "scene/visibility.hpp"

namespace estampe::app {
namespace {

struct PrimitiveCounts {
    uint64_t primitives = 0;
    uint64_t triangles = 0;
    uint64_t lines = 0;
    uint64_t points = 0;
    uint64_t vertices = 0;
    uint64_t morph_targets = 0;

    void add(const Primitive& primitive)
    {
        ++primitives;
        vertices += primitive.positions.size();
        morph_targets += primitive.morph_targets.size();
        switch (primitive.topology) {
        case Topology::triangles:
            triangles += primitive.indices.size() / 3;
            break;
        case Topology::lines:
            lines += primitive.indices.size() / 2;
            break;
        case Topology::points:
            points += primitive.indices.size();
            break;
        }
    }
};

/// Triangles in the picture: a mesh counts once for every node and instance that shows it.
uint64_t drawn_triangles(const Scene& scene)
{
    uint64_t drawn = 0;
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (!visible[i] || node.mesh == no_index) {
            continue;
        }
        PrimitiveCounts counts;
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            counts.add(primitive);
        }
        drawn += counts.triangles * std::max<uint64_t>(1, node.instances.size());
    }
    return drawn;
}

} // namespace

SceneSummary summarize(const Scene& scene)
{
    PrimitiveCounts counts;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            counts.add(primitive);
        }
    }
    SceneSummary summary;
    summary.counts = {{"nodes", scene.nodes.size()},
                      {"meshes", scene.meshes.size()},
                      {"primitives", counts.primitives},
                      {"vertices", counts.vertices},
                      {"triangles", counts.triangles},
                      {"triangles drawn", drawn_triangles(scene)},
                      {"lines", counts.lines},
                      {"points", counts.points},
                      {"morph targets", counts.morph_targets},
                      {"materials", scene.materials.size()},
                      {"textures", scene.textures.size()},
                      {"lights", scene.lights.size()},
                      {"cameras", scene.cameras.size()},
                      {"skins", scene.skins.size()},
                      {"animations", scene.animations.size()}};
    for (const SceneCamera& camera : scene.cameras) {
        summary.camera_names.push_back(camera.name);
    }
    summary.bounds = scene_bounds(scene, pose_scene(scene, 0.0, no_index));
    summary.light = default_light(scene);
    return summary;
}

} // namespace estampe::app
