// SPDX-License-Identifier: MIT
#include "scene/reader/crossing.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <estampe/error.hpp>

#include "scene/scene_limits.hpp"

namespace estampe {
namespace {

void make_printable(std::vector<std::string>& texts)
{
    for (std::string& text : texts)
        std::ranges::replace_if(
            text, [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; },
            ' ');
}

} // namespace

void check_received_scene(Scene& scene, const std::string& where)
{
    const auto has_normals = [](const Primitive& primitive) {
        return primitive.topology != Topology::triangles ||
               primitive.normals.size() == primitive.positions.size();
    };
    const bool has_what_readers_add =
        !scene.materials.empty() && std::ranges::all_of(scene.meshes, [&](const Mesh& mesh) {
            return std::ranges::all_of(mesh.primitives, has_normals);
        });
    if (!has_what_readers_add || !structural_faults(scene).empty())
        throw Error("what was read from it came back damaged", where);
    make_printable(scene.warnings);
}

} // namespace estampe
