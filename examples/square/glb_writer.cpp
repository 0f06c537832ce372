// SPDX-License-Identifier: MIT
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "square.hpp"

namespace square {
namespace {

using estampe::Primitive;
using estampe::Scene;
using nlohmann::json;

constexpr int component_u32 = 5125;
constexpr int component_f32 = 5126;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;

/// The binary chunk of the file, with its buffer views and accessors.
class Buffers {
public:
    template <typename Value>
    size_t add(const std::vector<Value>& values, const char* type, int component, int target)
    {
        const size_t size = values.size() * sizeof(Value);
        const size_t offset = bytes_.size();
        bytes_.resize(offset + size);
        std::memcpy(bytes_.data() + offset, values.data(), size);
        views_.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
        accessors_.push_back({{"bufferView", views_.size() - 1},
                              {"componentType", component},
                              {"count", values.size()},
                              {"type", type}});
        return accessors_.size() - 1;
    }

    size_t add_positions(const std::vector<glm::vec3>& positions)
    {
        const size_t index = add(positions, "VEC3", component_f32, target_vertices);
        glm::vec3 low = positions.front();
        glm::vec3 high = low;
        for (const glm::vec3& p : positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        accessors_[index]["min"] = {low.x, low.y, low.z};
        accessors_[index]["max"] = {high.x, high.y, high.z};
        return index;
    }

    void move_into(json& document) const
    {
        document["buffers"] = {{{"byteLength", bytes_.size()}}};
        document["bufferViews"] = views_;
        document["accessors"] = accessors_;
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    json views_ = json::array();
    json accessors_ = json::array();
};

json describe_primitive(const Primitive& primitive, Buffers& buffers)
{
    // glTF's texture coordinates run downwards, these run in metres. They are not flipped: both directions
    // work.
    const json attributes = {
        {"POSITION", buffers.add_positions(primitive.positions)},
        {"NORMAL", buffers.add(primitive.normals, "VEC3", component_f32, target_vertices)},
        {"TEXCOORD_0", buffers.add(primitive.uvs[0], "VEC2", component_f32, target_vertices)}};
    return {{"attributes", attributes},
            {"indices", buffers.add(primitive.indices, "SCALAR", component_u32, target_indices)},
            {"material", primitive.material}};
}

json describe_meshes(const Scene& scene, Buffers& buffers)
{
    json meshes = json::array();
    for (const estampe::Mesh& mesh : scene.meshes) {
        json primitives = json::array();
        for (const Primitive& primitive : mesh.primitives)
            primitives.push_back(describe_primitive(primitive, buffers));
        meshes.push_back({{"name", mesh.name}, {"primitives", primitives}});
    }
    return meshes;
}

json describe_materials(const Scene& scene)
{
    json materials = json::array();
    for (const estampe::Material& material : scene.materials) {
        const glm::vec4& color = material.base_color;
        json described = {{"name", material.name},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {color.x, color.y, color.z, color.w}},
                            {"metallicFactor", material.metallic},
                            {"roughnessFactor", material.roughness}}}};
        if (material.double_sided)
            described["doubleSided"] = true;
        materials.push_back(described);
    }
    return materials;
}

json describe_nodes(const Scene& scene)
{
    json nodes = json::array();
    for (const estampe::Node& node : scene.nodes) {
        const estampe::Transform& place = node.transform;
        json described = {
            {"name", node.name},
            {"translation", {place.translation.x, place.translation.y, place.translation.z}},
            {"rotation", {place.rotation.x, place.rotation.y, place.rotation.z, place.rotation.w}}};
        if (node.mesh != estampe::no_index)
            described["mesh"] = node.mesh;
        if (node.camera != estampe::no_index)
            described["camera"] = node.camera;
        if (node.light != estampe::no_index)
            described["extensions"]["KHR_lights_punctual"]["light"] = node.light;
        nodes.push_back(described);
    }
    return nodes;
}

json describe_scene(const Scene& scene, Buffers& buffers)
{
    json document = {{"asset", {{"version", "2.0"}, {"generator", "estampe"}}},
                     {"scene", 0},
                     {"scenes", {{{"name", scene.name}, {"nodes", scene.roots}}}},
                     {"nodes", describe_nodes(scene)},
                     {"meshes", describe_meshes(scene, buffers)},
                     {"materials", describe_materials(scene)},
                     {"extensionsUsed", scene.extensions_used}};
    for (const estampe::SceneCamera& camera : scene.cameras)
        document["cameras"].push_back(
            {{"name", camera.name},
             {"type", "perspective"},
             {"perspective", {{"yfov", camera.vertical_fov_rad}, {"znear", camera.near_m}}}});
    for (const estampe::Light& light : scene.lights)
        document["extensions"]["KHR_lights_punctual"]["lights"].push_back(
            {{"name", light.name},
             {"type", "directional"},
             {"color", {light.color.x, light.color.y, light.color.z}},
             {"intensity", light.intensity}});
    buffers.move_into(document);
    return document;
}

void append_u32(std::string& bytes, size_t value)
{
    const auto word = static_cast<uint32_t>(value);
    for (uint32_t shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>((word >> shift) & 0xFFU));
}

void append_chunk(std::string& bytes, std::string_view kind, std::string content, char padding)
{
    content.resize((content.size() + 3) / 4 * 4, padding);
    append_u32(bytes, content.size());
    bytes += kind;
    bytes += content;
}

} // namespace

void write_glb(const Scene& scene, const std::filesystem::path& path)
{
    Buffers buffers;
    std::string chunks;
    append_chunk(chunks, "JSON", describe_scene(scene, buffers).dump(), ' ');
    append_chunk(chunks, std::string_view("BIN\0", 4), buffers.bytes(), '\0');
    std::string file = "glTF";
    append_u32(file, 2);
    append_u32(file, 12 + chunks.size());
    file += chunks;
    estampe::write_file_atomically(path, std::as_bytes(std::span(file)));
}

} // namespace square
