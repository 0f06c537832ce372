// SPDX-License-Identifier: MIT
#include "scene/stl/stl_import.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "scene/input/finish.hpp"
#include "scene/input/origin.hpp"
#include "scene/stl/stl_data.hpp"

namespace estampe {
namespace {

Bounds bounds_of(const stl::Solid& solid)
{
    Bounds bounds;
    for (const glm::dvec3& position : solid.positions)
        if (is_usable(position))
            bounds.extend(position);
    return bounds;
}

Primitive primitive_of(stl::Solid& solid, const glm::dvec3& origin)
{
    Primitive primitive;
    primitive.positions.reserve(solid.positions.size());
    for (const glm::dvec3& position : solid.positions)
        primitive.positions.emplace_back(position - origin);
    std::vector<glm::dvec3>().swap(solid.positions);
    for (const glm::vec4& color : solid.colors)
        primitive.colors.insert(primitive.colors.end(), 3, color);
    std::vector<glm::vec4>().swap(solid.colors);
    primitive.indices.resize(primitive.positions.size());
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    return primitive;
}

/// Leaves out facets that are points: what a file holds that was not written to its end is zeros. They would
/// count for the size of the scene.
void drop_points(stl::Data& data)
{
    uint64_t dropped = 0;
    for (stl::Solid& solid : data.solids) {
        const std::vector<glm::dvec3>& positions = solid.positions;
        size_t kept = 0;
        for (size_t i = 0; i < positions.size() / 3; ++i) {
            if (positions[3 * i] == positions[3 * i + 1] && positions[3 * i] == positions[3 * i + 2]) {
                ++dropped;
                continue;
            }
            if (kept != i) {
                std::copy_n(solid.positions.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                            solid.positions.begin() + static_cast<std::ptrdiff_t>(3 * kept));
                if (!solid.colors.empty())
                    solid.colors[kept] = solid.colors[i];
            }
            ++kept;
        }
        solid.positions.resize(3 * kept);
        solid.colors.resize(std::min(solid.colors.size(), kept));
    }
    std::erase_if(data.solids, [](const stl::Solid& solid) { return solid.positions.empty(); });
    if (dropped > 0)
        data.warnings.push_back(
            fmt::format("{} facets left out: all their corners are in one place", dropped));
}

Scene import(Input& input)
{
    stl::Data data = stl::parse(input);
    drop_points(data);
    Scene scene;
    scene.name = std::filesystem::path(input.name()).stem().string();
    scene.warnings = std::move(data.warnings);
    Material& material = scene.materials.emplace_back();
    material.name = "DefaultMaterial";
    material.double_sided = true;
    material.metallic = 0.0F;
    std::vector<Bounds> bounds;
    Bounds all;
    for (const stl::Solid& solid : data.solids) {
        bounds.push_back(bounds_of(solid));
        if (!bounds.back().empty()) {
            all.extend(bounds.back().min);
            all.extend(bounds.back().max);
        }
    }
    scene.nodes.emplace_back().name = scene.name;
    scene.roots = {0};
    for (size_t i = 0; i < data.solids.size(); ++i) {
        const auto index = static_cast<Index>(scene.nodes.size());
        Node& node = scene.nodes.emplace_back();
        node.name = data.solids[i].name.empty() ? scene.name : data.solids[i].name;
        node.parent = 0;
        node.mesh = static_cast<Index>(i);
        node.transform.translation = object_origin(bounds[i], file_origin(all));
        scene.nodes[0].children.push_back(index);
        Mesh& mesh = scene.meshes.emplace_back();
        mesh.name = node.name;
        mesh.primitives.push_back(primitive_of(data.solids[i], node.transform.translation));
    }
    data = {};
    finish_import(scene, input.name());
    return scene;
}

} // namespace

Scene load_stl(const std::filesystem::path& path)
{
    Input input(path);
    return within_memory(input.name(), [&] { return import(input); });
}

Scene load_stl_bytes(std::span<const std::byte> bytes, const std::string& name)
{
    Input input(bytes, name);
    return within_memory(name, [&] { return import(input); });
}

} // namespace estampe
