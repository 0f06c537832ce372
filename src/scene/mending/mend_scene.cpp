// SPDX-License-Identifier: MIT
#include "scene/mending/mend_scene.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/progress_watch.hpp"
#include "scene/gltf/geometry.hpp"
#include "scene/mending/mend.hpp"

namespace estampe {

namespace {

// Shares of a load between which meshes are mended: files are read before.
constexpr double mending_from = 0.4;
constexpr double mending_to = 0.85;

} // namespace

void mend_meshes(Scene& scene, const std::string& where)
{
    if (scene.materials.empty()) {
        scene.materials.emplace_back();
        scene.materials.front().double_sided = true;
    }
    size_t elements = 0;
    size_t done = 0;
    for (Mesh& mesh : scene.meshes) {
        size_t targets = 0;
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.material >= scene.materials.size())
                primitive.material = 0;
            mend_primitive(primitive, mesh.name, scene.warnings);
            targets = std::max(targets, primitive.morph_targets.size());
        }
        std::erase_if(mesh.primitives, [](const Primitive& primitive) { return primitive.indices.empty(); });
        mesh.morph_weights.assign(targets, 0.0F);
        elements += mesh.primitives.size();
        report_progress(std::lerp(mending_from, mending_to,
                                  static_cast<double>(++done) / static_cast<double>(scene.meshes.size())));
    }
    if (elements == 0)
        throw Error(scene.warnings.empty() ? std::string("has no triangles, lines or points")
                                           : fmt::format("has nothing to draw ({})", scene.warnings.back()),
                    where, "give a file with meshes");
}

void make_needed_tangents(Scene& scene)
{
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            const TextureRef& normals = scene.materials[primitive.material].normal_texture;
            if (normals.texture != no_index && primitive.topology == Topology::triangles &&
                !primitive.uvs[normals.uv_set].empty())
                gltf::make_tangents(primitive, normals.uv_set);
        }
    }
}

} // namespace estampe
