// SPDX-License-Identifier: MIT
#include "scene/importers.hpp"

#include <numeric>

#include "scene/input/input.hpp"
#include "scene/mending/mend.hpp"
#include "scene/pictures/picture_files.hpp"
#include "scene/ply/ply_parse.hpp"

namespace estampe {
namespace {

glm::vec2 turned_over(const glm::vec2& uv)
{
    return {uv.x, 1.0F - uv.y};
}

std::vector<glm::vec3> moved(const std::vector<glm::dvec3>& positions, const glm::dvec3& origin)
{
    std::vector<glm::vec3> result;
    result.reserve(positions.size());
    for (const glm::dvec3& position : positions)
        result.emplace_back(position - origin);
    return result;
}

/// Returns a primitive with all vertices in the order of the file.
Primitive with_vertices(const ply::Data& data, const std::vector<glm::vec3>& positions)
{
    Primitive primitive;
    primitive.positions = positions;
    primitive.normals = data.normals;
    primitive.colors = data.colors;
    primitive.uvs[0].reserve(data.uvs.size());
    for (const glm::vec2& uv : data.uvs)
        primitive.uvs[0].push_back(turned_over(uv));
    return primitive;
}

/// Returns a primitive with the triangles that use one texture. Each corner becomes a vertex, because corners
/// have their own attributes.
Primitive with_corners(const ply::Data& data, const std::vector<glm::vec3>& positions, uint32_t texture)
{
    Primitive primitive;
    primitive.material = texture;
    for (size_t i = 0; i < data.triangles.size(); ++i) {
        if (!data.face_textures.empty() && data.face_textures[i / 3] != texture)
            continue;
        const uint32_t vertex = data.triangles[i];
        primitive.positions.push_back(positions[vertex]);
        if (!data.normals.empty())
            primitive.normals.push_back(data.normals[vertex]);
        if (!data.corner_uvs.empty())
            primitive.uvs[0].push_back(turned_over(data.corner_uvs[i]));
        else if (!data.uvs.empty())
            primitive.uvs[0].push_back(turned_over(data.uvs[vertex]));
        if (!data.colors.empty())
            primitive.colors.push_back(data.colors[vertex]);
        else if (!data.face_colors.empty())
            primitive.colors.push_back(data.face_colors[i / 3]);
    }
    primitive.indices.resize(primitive.positions.size());
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    return primitive;
}

void add_primitives(ply::Data& data, const glm::dvec3& origin, std::vector<Primitive>& primitives)
{
    std::vector<glm::vec3> positions = moved(data.positions, origin);
    std::vector<glm::dvec3>().swap(data.positions);
    const bool has_corners = !data.corner_uvs.empty() || !data.face_textures.empty() ||
                             (!data.face_colors.empty() && data.colors.empty());
    if (!data.lines.empty()) {
        Primitive& lines = primitives.emplace_back(with_vertices(data, positions));
        lines.topology = Topology::lines;
        lines.indices = std::move(data.lines);
    }
    if (has_corners) {
        const size_t textures = std::max<size_t>(data.texture_files.size(), 1);
        for (uint32_t texture = 0; texture < (data.face_textures.empty() ? 1 : textures); ++texture)
            primitives.push_back(with_corners(data, positions, texture));
        return;
    }
    const bool is_cloud = data.triangles.empty() && primitives.empty() && !data.promises_faces;
    if (!is_cloud && data.triangles.empty())
        return;
    Primitive& primitive = primitives.emplace_back(with_vertices(data, {}));
    primitive.positions = std::move(positions);
    primitive.topology = is_cloud ? Topology::points : Topology::triangles;
    primitive.indices = std::move(data.triangles);
    if (is_cloud) {
        primitive.indices.resize(primitive.positions.size());
        std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    }
}

void add_materials(const std::vector<std::string>& texture_files, Scene& scene)
{
    for (size_t i = 0; i < std::max<size_t>(texture_files.size(), 1); ++i) {
        Material& material = scene.materials.emplace_back();
        material.name = material_without_name;
        material.double_sided = true;
        material.metallic = 0.0F;
        if (i < texture_files.size()) {
            material.base_color_texture.texture = static_cast<Index>(scene.textures.size());
            scene.textures.emplace_back().name = texture_files[i];
        }
    }
}

Scene import_ply(Input& input, const std::filesystem::path* path, const ReadScope& scope)
{
    ply::Data data = ply::parse(input);
    Scene scene;
    const std::filesystem::path name(input.name());
    scene.name = name.stem().string();
    scene.warnings = std::move(data.warnings);
    add_materials(data.texture_files, scene);
    Bounds bounds;
    for (const glm::dvec3& position : data.positions)
        if (is_usable(position))
            bounds.extend(position);
    Node& node = scene.nodes.emplace_back();
    node.name = scene.name;
    node.mesh = 0;
    node.transform.translation = file_origin(bounds);
    scene.roots = {0};
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.name = scene.name;
    add_primitives(data, node.transform.translation, mesh.primitives);
    data = {};
    std::vector<ImageSource> sources;
    for (const Texture& texture : scene.textures)
        sources.push_back({.file = texture.name, .bytes = {}});
    FileFinder finder(
        path != nullptr ? std::vector{path->parent_path()} : std::vector<std::filesystem::path>{}, scope);
    load_pictures(scene, sources, finder);
    finish_import(scene, input.name());
    return scene;
}

} // namespace

Scene load_ply(const std::filesystem::path& path, const ReadScope& scope)
{
    Input input(path, scope);
    return within_memory(input.name(), [&] { return import_ply(input, &path, scope); });
}

Scene load_ply_bytes(std::span<const std::byte> bytes, const std::string& name)
{
    Input input(bytes, name);
    return within_memory(name, [&] { return import_ply(input, nullptr, {}); });
}

} // namespace estampe
