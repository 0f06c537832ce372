// SPDX-License-Identifier: MIT
#include "scene/importers.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "scene/input/input.hpp"
#include "scene/mending/mend.hpp"
#include "scene/obj/obj_materials.hpp"
#include "scene/obj/obj_parse.hpp"

namespace estampe {
namespace {

using obj::Piece;

constexpr float grey = 0.6F;

/// Adds all vertices as points. A file with only vertices is a point cloud from a scanner.
void add_cloud(obj::Data& data)
{
    Piece& cloud = data.pieces.emplace_back();
    cloud.topology = Topology::points;
    cloud.indices.resize(data.positions.size());
    std::iota(cloud.indices.begin(), cloud.indices.end(), 0U);
    cloud.vertices.resize(data.positions.size());
    for (uint32_t i = 0; i < data.positions.size(); ++i)
        cloud.vertices[i].position = i;
}

/// Returns how many items of a list of `count` no face, line or point uses; `number` is the member of Corner
/// that refers to the list. An OBJ file does not say how many faces follow, but a file that was cut off, or
/// that lost lines or has some twice, has items that nothing uses.
size_t unused_items(const obj::Data& data, size_t count, uint32_t obj::Corner::*number)
{
    std::vector<bool> is_used(count, false);
    for (const Piece& piece : data.pieces)
        for (const obj::Corner& corner : piece.vertices)
            if (corner.*number < count)
                is_used[corner.*number] = true;
    return static_cast<size_t>(std::count(is_used.begin(), is_used.end(), false));
}

/// Returns the bounds of each object, over all its pieces.
std::vector<Bounds> bounds_of_objects(const obj::Data& data)
{
    std::vector<Bounds> bounds(data.objects.size());
    for (const Piece& piece : data.pieces)
        for (const obj::Corner& corner : piece.vertices)
            if (is_usable(data.positions[corner.position]))
                bounds[piece.object].extend(data.positions[corner.position]);
    return bounds;
}

Primitive primitive_of(const obj::Data& data, Piece& piece, const glm::dvec3& origin)
{
    Primitive primitive;
    primitive.topology = piece.topology;
    primitive.material = piece.material;
    primitive.indices = std::move(piece.indices);
    const size_t count = piece.vertices.size();
    primitive.positions.resize(count);
    for (size_t i = 0; i < count; ++i)
        primitive.positions[i] = glm::vec3(data.positions[piece.vertices[i].position] - origin) +
                                 glm::vec3(0.0F); // adding zero turns negative zeros into positive zeros
    if (piece.has_normals) {
        primitive.normals.resize(count, glm::vec3(0.0F));
        for (size_t i = 0; i < count; ++i)
            if (piece.vertices[i].normal != no_index)
                primitive.normals[i] = data.normals[piece.vertices[i].normal];
    }
    if (std::any_of(piece.vertices.begin(), piece.vertices.end(),
                    [](const obj::Corner& corner) { return corner.uv != no_index; })) {
        primitive.uvs[0].resize(count, glm::vec2(0.0F, 1.0F));
        for (size_t i = 0; i < count; ++i)
            if (piece.vertices[i].uv != no_index) {
                const glm::vec2& uv = data.uvs[piece.vertices[i].uv];
                primitive.uvs[0][i] = glm::vec2(uv.x, 1.0F - uv.y);
            }
    }
    if (!data.colors.empty()) {
        primitive.colors.resize(count);
        for (size_t i = 0; i < count; ++i)
            primitive.colors[i] = data.colors[piece.vertices[i].position];
    }
    std::vector<obj::Corner>().swap(piece.vertices);
    return primitive;
}

/// Adds nodes for the objects that have something to draw, and for the parents of drawn objects.
class Nodes {
public:
    Nodes(const obj::Data& data, Scene& scene, const std::string& root_name)
        : data_(data), scene_(scene), node_of_object_(data.objects.size(), no_index),
          has_groups_(data.objects.size(), false)
    {
        scene_.nodes.emplace_back().name = root_name;
        scene_.roots.push_back(0);
        for (const obj::Object& object : data.objects)
            if (object.parent != no_index)
                has_groups_[object.parent] = true;
    }

    Index node_of(uint32_t object)
    {
        if (node_of_object_[object] != no_index)
            return node_of_object_[object];
        const obj::Object& source = data_.objects[object];
        // The mesh is translated to the origin of its coordinates only by its own node. The parent node gets
        // no translation, because it may also contain groups.
        const Index parent = source.parent == no_index ? 0 : node_of(source.parent);
        const auto index = static_cast<Index>(scene_.nodes.size());
        Node& node = scene_.nodes.emplace_back();
        node.name = source.name;
        node.parent = parent;
        scene_.nodes[parent].children.push_back(index);
        node_of_object_[object] = index;
        return index;
    }

    /// Returns the node for the meshes of an object, translated to `origin`. The result is the node of the
    /// object itself. If the object also contains groups, the result is a new child node, because the
    /// translation must not apply to the groups.
    Index node_of_mesh(uint32_t object, const glm::dvec3& origin)
    {
        Index index = node_of(object);
        if (has_groups_[object] && origin != glm::dvec3(0.0)) {
            const Index parent = index;
            index = static_cast<Index>(scene_.nodes.size());
            Node& node = scene_.nodes.emplace_back();
            node.name = data_.objects[object].name;
            node.parent = parent;
            scene_.nodes[parent].children.push_back(index);
        }
        scene_.nodes[index].transform.translation = origin;
        return index;
    }

private:
    const obj::Data& data_;
    Scene& scene_;
    std::vector<Index> node_of_object_;
    std::vector<bool> has_groups_;
};

void add_meshes(obj::Data& data, Scene& scene, const std::string& root_name)
{
    const std::vector<Bounds> bounds = bounds_of_objects(data);
    Bounds all;
    for (const Bounds& each : bounds)
        if (!each.empty()) {
            all.extend(each.min);
            all.extend(each.max);
        }
    const glm::dvec3 origin_of_file = file_origin(all);
    Nodes nodes(data, scene, root_name);
    std::vector<Index> mesh_of_object(data.objects.size(), no_index);
    for (Piece& piece : data.pieces) {
        if (piece.indices.empty())
            continue;
        const glm::dvec3 origin = object_origin(bounds[piece.object], origin_of_file);
        Index& mesh = mesh_of_object[piece.object];
        if (mesh == no_index) {
            mesh = static_cast<Index>(scene.meshes.size());
            scene.meshes.emplace_back().name = data.objects[piece.object].name;
            scene.nodes[nodes.node_of_mesh(piece.object, origin)].mesh = mesh;
        }
        const std::vector<uint32_t> groups = std::move(piece.smoothing_groups);
        Primitive primitive = primitive_of(data, piece, origin);
        if (!groups.empty() && primitive.normals.empty()) {
            agree_winding(primitive, data.objects[piece.object].name, scene.warnings);
            make_crease_normals(primitive, usual_crease_rad, groups);
            (void)gltf::repair_normals(primitive); // faces with zero area get normals here
        }
        scene.meshes[mesh].primitives.push_back(std::move(primitive));
    }
}

void warn_of_losses(const obj::Losses& losses, size_t vertices, std::vector<std::string>& warnings)
{
    const auto warn_of_cut = [&warnings](uint64_t said, uint64_t there, const char* what) {
        if (there < said)
            warnings.push_back(fmt::format("is cut off: says {} {}, has {}", said, what, there));
    };
    warn_of_cut(losses.said_vertices, vertices, "vertices");
    warn_of_cut(losses.said_faces, losses.faces, "faces");
    const auto warn = [&warnings](uint64_t count, const char* text) {
        if (count > 0)
            warnings.push_back(fmt::format("{} {}", count, text));
    };
    warn(losses.faces_of_missing_vertices, "faces left out: they name vertices that are not there");
    warn(losses.short_faces, "faces left out: they have too few corners");
    warn(losses.unclean_polygons, "polygons cross themselves: their triangles may be wrong");
    warn(losses.corners_of_missing_attributes,
         "corners name texture coordinates or normals that are not there");
    warn(losses.curves, "curved surfaces left out: only polygons are read");
    if (losses.unread_lines > 0)
        warnings.push_back(fmt::format("{} lines are not OBJ, the first of them line {}: passed over",
                                       losses.unread_lines, losses.first_unread_line));
    if (losses.is_cut_off)
        warnings.emplace_back("ends in the middle of a line: the file seems to be cut off");
}

/// Adds a grey material for all elements without a material.
void add_default_material(obj::Data& data, const glm::vec3& color, Scene& scene)
{
    const auto lacks_material = [](const Piece& piece) { return piece.material == no_index; };
    if (std::none_of(data.pieces.begin(), data.pieces.end(), lacks_material))
        return;
    for (Piece& piece : data.pieces)
        if (lacks_material(piece))
            piece.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = material_without_name,
                               .base_color = glm::vec4(color, 1.0F),
                               .metallic = 0.0F,
                               .double_sided = true});
}

Scene import_obj(Input& input, const std::filesystem::path* path, const ReadScope& scope)
{
    obj::Data data = obj::parse(input);
    Scene scene;
    const std::filesystem::path name(input.name());
    scene.name = name.stem().string();
    const obj::Losses losses = data.losses;
    const bool is_cloud = std::all_of(data.pieces.begin(), data.pieces.end(),
                                      [](const Piece& piece) { return piece.indices.empty(); }) &&
                          losses.faces + losses.said_faces + losses.curves == 0;
    warn_of_losses(losses, data.positions.size(), scene.warnings);
    const char* const end = losses.is_cut_off || input.line_was_ended()
                                ? ""
                                : "; its last line has no line end, so it may be cut off";
    if (is_cloud && !data.positions.empty()) {
        add_cloud(data);
        scene.warnings.push_back(
            fmt::format("has no faces, lines or points: its {} vertices are drawn as dots{}",
                        data.positions.size(), end));
    } else if (const size_t unused = unused_items(data, data.positions.size(), &obj::Corner::position);
               unused > 0) {
        scene.warnings.push_back(
            fmt::format("{} of {} vertices belong to no face, line or point and are not drawn{}", unused,
                        data.positions.size(), end));
    }
    const size_t unused_uvs = unused_items(data, data.uvs.size(), &obj::Corner::uv);
    const size_t unused_normals = unused_items(data, data.normals.size(), &obj::Corner::normal);
    if (!is_cloud && unused_uvs + unused_normals > 0)
        scene.warnings.push_back(fmt::format("{} texture coordinates and {} normals belong to no face",
                                             unused_uvs, unused_normals));
    const glm::vec3 default_color(data.colors.empty() ? grey : 1.0F);
    obj::read_materials(path != nullptr ? *path : name,
                        path != nullptr ? data.libraries : std::vector<std::string>{}, data.materials,
                        default_color, scope, scene);
    add_default_material(data, default_color, scene);
    add_meshes(data, scene, name.filename().string());
    data = {};
    finish_import(scene, input.name());
    return scene;
}

} // namespace

Scene load_obj(const std::filesystem::path& path, const ReadScope& scope)
{
    Input input(path, scope);
    return within_memory(input.name(), [&] { return import_obj(input, &path, scope); });
}

Scene load_obj_bytes(std::span<const std::byte> bytes, const std::string& name)
{
    Input input(bytes, name);
    return within_memory(name, [&] { return import_obj(input, nullptr, {}); });
}

} // namespace estampe
