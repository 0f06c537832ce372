// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <numeric>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/gltf/convert.hpp"
#include "scene/gltf/extras.hpp"

namespace estampe::gltf {
namespace {

Index index_of(int index)
{
    return index < 0 ? no_index : static_cast<Index>(index);
}

std::string node_pointer(size_t node)
{
    return fmt::format("/nodes/{}", node);
}

glm::dvec3 vector_of(const std::vector<double>& numbers, const glm::dvec3& otherwise)
{
    return numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2]) : otherwise;
}

glm::dquat unit_rotation(Data& data, const glm::dquat& rotation, const std::string& pointer)
{
    const double length = glm::length(rotation);
    if (!std::isfinite(length) || length < 1e-6) {
        data.warn(pointer, "is not a rotation; none is used");
        return {1.0, 0.0, 0.0, 0.0};
    }
    return rotation / length;
}

void place_node(Data& data, const tinygltf::Node& source, Node& node, const std::string& pointer)
{
    if (source.matrix.size() == 16) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) {
            matrix[i / 4][i % 4] = source.matrix[static_cast<size_t>(i)];
        }
        if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
            data.fail(pointer + "/matrix", "is not an affine transform: the last row is not 0 0 0 1");
        }
        node.matrix = matrix;
        return;
    }
    node.transform.translation = vector_of(source.translation, glm::dvec3(0.0));
    node.transform.scale = vector_of(source.scale, glm::dvec3(1.0));
    if (source.rotation.size() == 4) {
        const auto& r = source.rotation;
        node.transform.rotation =
            unit_rotation(data, glm::dquat(r[3], r[0], r[1], r[2]), pointer + "/rotation");
    }
}

/// Removes instances whose transforms are identical. Without the removal, a small file could create any
/// number of copies at one place, because all values of an accessor without data are zero.
void drop_same(Data& data, std::vector<glm::mat4>& instances, const std::string& pointer)
{
    using Bits = std::array<uint32_t, 16>;
    const auto bits_of = [&](size_t i) { return std::bit_cast<Bits>(instances[i]); };
    std::vector<size_t> order(instances.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const auto difference = bits_of(a) <=> bits_of(b);
        return std::is_neq(difference) ? std::is_lt(difference) : a < b;
    });
    std::vector<bool> is_again(instances.size(), false);
    size_t count = 0;
    for (size_t i = 1; i < order.size(); ++i) {
        if (bits_of(order[i - 1]) == bits_of(order[i])) {
            is_again[order[i]] = true;
            ++count;
        }
    }
    if (count == 0) {
        return;
    }
    std::vector<glm::mat4> kept;
    kept.reserve(instances.size() - count);
    for (size_t i = 0; i < instances.size(); ++i) {
        if (!is_again[i]) {
            kept.push_back(instances[i]);
        }
    }
    instances = std::move(kept);
    data.warn(pointer + "/extensions/EXT_mesh_gpu_instancing",
              fmt::format("{} instances stand exactly where another does; they are left out", count));
}

std::vector<glm::mat4> import_instances(Data& data, const tinygltf::Node& source, const std::string& pointer)
{
    const auto extension = source.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == source.extensions.end()) {
        return {};
    }
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    size_t count = 0;
    const auto read = [&](const char* name, int components) -> std::vector<float> {
        if (!attributes.Has(name)) {
            return {};
        }
        const std::string at = pointer + "/extensions/EXT_mesh_gpu_instancing/attributes/" + name;
        const int accessor = attributes.Get(name).GetNumberAsInt();
        const size_t found = accessor_of(data, accessor).count;
        if (component_count(accessor_of(data, accessor)) != components) {
            data.fail(at, fmt::format("accessor {} does not have {} components", accessor, components));
        }
        if (count != 0 && found != count) {
            data.fail(at, fmt::format("has {} elements, another attribute has {}", found, count));
        }
        count = found;
        return read_floats(data, accessor, components);
    };
    const std::vector<float> translations = read("TRANSLATION", 3);
    const std::vector<float> rotations = read("ROTATION", 4);
    const std::vector<float> scales = read("SCALE", 3);
    data.spend(count * sizeof(glm::mat4), pointer);
    std::vector<glm::mat4> instances;
    instances.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        Transform transform;
        if (!translations.empty()) {
            transform.translation = {translations[i * 3], translations[i * 3 + 1], translations[i * 3 + 2]};
        }
        if (!rotations.empty()) {
            const float* r = &rotations[i * 4];
            transform.rotation = unit_rotation(data, glm::dquat(r[3], r[0], r[1], r[2]), pointer);
        }
        if (!scales.empty()) {
            transform.scale = {scales[i * 3], scales[i * 3 + 1], scales[i * 3 + 2]};
        }
        const glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), transform.translation) *
                                  glm::mat4_cast(transform.rotation) *
                                  glm::scale(glm::dmat4(1.0), transform.scale);
        for (int column = 0; column < 4; ++column) {
            if (!std::isfinite(glm::dot(matrix[column], glm::dvec4(1.0)))) {
                data.fail(pointer + "/extensions/EXT_mesh_gpu_instancing",
                          fmt::format("instance {} is not finite", i));
            }
        }
        instances.emplace_back(matrix);
    }
    drop_same(data, instances, pointer);
    return instances;
}

/// Sets the parent of each node. Throws Error when a node has two parents or is its own ancestor.
void link_nodes(const Data& data, Scene& scene)
{
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        for (size_t c = 0; c < scene.nodes[i].children.size(); ++c) {
            const Index child = scene.nodes[i].children[c];
            if (scene.nodes[child].parent != no_index) {
                data.fail(fmt::format("{}/children/{}", node_pointer(i), c),
                          fmt::format("node {} already has the parent {}", child, scene.nodes[child].parent),
                          "export the file again: its nodes must form trees");
            }
            scene.nodes[child].parent = static_cast<Index>(i);
        }
    }
    std::vector<bool> reached(scene.nodes.size(), false);
    std::vector<Index> open;
    for (Index i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent == no_index) {
            scene.roots.push_back(i);
            open.push_back(i);
        }
    }
    while (!open.empty()) {
        const Index node = open.back();
        open.pop_back();
        reached[node] = true;
        open.insert(open.end(), scene.nodes[node].children.begin(), scene.nodes[node].children.end());
    }
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost != reached.end()) {
        data.fail(node_pointer(static_cast<size_t>(lost - reached.begin())) + "/children",
                  "the node is its own ancestor: the node tree has a cycle", "export the file again");
    }
}

/// Removes the content of all nodes outside the scene that the file selects. The nodes keep their transforms,
/// because joints may depend on them.
void clear_nodes_outside(const tinygltf::Scene& shown, Scene& scene)
{
    std::vector<bool> inside(scene.nodes.size(), false);
    std::vector<Index> open;
    for (const int root : shown.nodes) {
        open.push_back(static_cast<Index>(root));
    }
    while (!open.empty()) {
        const Index node = open.back();
        open.pop_back();
        if (inside[node]) {
            continue;
        }
        inside[node] = true;
        open.insert(open.end(), scene.nodes[node].children.begin(), scene.nodes[node].children.end());
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!inside[i]) {
            Node& node = scene.nodes[i];
            node.mesh = node.skin = node.camera = node.light = no_index;
            node.instances.clear();
        }
    }
}

void import_lights(Data& data, Scene& scene)
{
    const auto& sources = data.model().lights;
    for (size_t i = 0; i < sources.size(); ++i) {
        const tinygltf::Light& source = sources[i];
        Light& light = scene.lights.emplace_back();
        light.name = source.name;
        light.type = source.type == "directional" ? LightType::directional
                     : source.type == "spot"      ? LightType::spot
                                                  : LightType::point;
        light.color = glm::vec3(vector_of(source.color, glm::dvec3(1.0)));
        light.intensity = static_cast<float>(source.intensity);
        light.range_m = static_cast<float>(source.range);
        light.outer_cone_rad = static_cast<float>(source.spot.outerConeAngle);
        light.inner_cone_rad = std::min(static_cast<float>(source.spot.innerConeAngle), light.outer_cone_rad);
        read_light_extras(data, source.extras, fmt::format("/extensions/KHR_lights_punctual/lights/{}", i),
                          light);
    }
}

/// Imports light links (groups of lights). The links of a node apply to its children unless the children
/// override them.
void import_links(Data& data, Scene& scene)
{
    std::vector<Index> open(scene.roots);
    while (!open.empty()) {
        const Index index = open.back();
        open.pop_back();
        Node& node = scene.nodes[index];
        if (node.parent != no_index) {
            node.links = scene.nodes[node.parent].links;
        }
        read_link_extras(data, data.model().nodes[index].extras, node_pointer(index), node.links);
        open.insert(open.end(), node.children.begin(), node.children.end());
    }
}

void import_cameras(Data& data, Scene& scene)
{
    const auto& sources = data.model().cameras;
    for (size_t i = 0; i < sources.size(); ++i) {
        const tinygltf::Camera& source = sources[i];
        const std::string pointer = fmt::format("/cameras/{}", i);
        SceneCamera& camera = scene.cameras.emplace_back();
        camera.name = source.name;
        camera.orthographic = source.type == "orthographic";
        if (camera.orthographic) {
            camera.half_height_m = std::abs(source.orthographic.ymag);
            camera.near_m = source.orthographic.znear;
            if (!(camera.half_height_m > 1e-9)) {
                data.fail(pointer + "/orthographic/ymag", "should not be zero");
            }
        } else {
            constexpr double widest_rad = 3.14;
            camera.vertical_fov_rad = std::min(source.perspective.yfov, widest_rad);
            camera.near_m = source.perspective.znear;
            if (!(camera.vertical_fov_rad > 0.0)) {
                data.fail(pointer, "lacks \"perspective\"");
            }
            if (!(camera.near_m > 0.0)) {
                data.warn(pointer + "/perspective/znear", "is zero; 0.01 m is used");
                camera.near_m = 0.01;
            }
        }
    }
}

void import_skins(Data& data, Scene& scene)
{
    const auto& sources = data.model().skins;
    for (size_t i = 0; i < sources.size(); ++i) {
        const std::string pointer = fmt::format("/skins/{}", i);
        Skin& skin = scene.skins.emplace_back();
        skin.name = sources[i].name;
        for (const int joint : sources[i].joints) {
            skin.joints.push_back(static_cast<Index>(joint));
        }
        if (skin.joints.empty()) {
            data.fail(pointer + "/joints", "has no joints");
        }
        skin.joint_from_bind.assign(skin.joints.size(), glm::mat4(1.0F));
        const int accessor = sources[i].inverseBindMatrices;
        if (accessor < 0) {
            continue;
        }
        const std::string at = pointer + "/inverseBindMatrices";
        if (component_count(accessor_of(data, accessor)) != 16 ||
            accessor_of(data, accessor).count < skin.joints.size()) {
            data.fail(at, fmt::format("accessor {} does not hold a matrix for each of {} joints", accessor,
                                      skin.joints.size()));
        }
        const std::vector<glm::mat4> matrices = read_vectors<glm::mat4>(data, accessor);
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            for (int column = 0; column < 4; ++column) {
                if (!std::isfinite(glm::dot(matrices[j][column], glm::vec4(1.0F)))) {
                    data.fail(at, fmt::format("matrix {} is not finite", j), "export the file again");
                }
            }
            skin.joint_from_bind[j] = matrices[j];
        }
    }
}

/// Returns the highest joint index that any vertex of a primitive uses.
uint32_t highest_joint(const Primitive& primitive)
{
    uint32_t highest = 0;
    for (const auto* set : {&primitive.joints_0, &primitive.joints_1}) {
        for (const glm::u16vec4& joints : *set) {
            highest = std::max(
                {highest, uint32_t{joints.x}, uint32_t{joints.y}, uint32_t{joints.z}, uint32_t{joints.w}});
        }
    }
    return highest;
}

void check_skinned_node(Data& data, const Scene& scene, Node& node, const std::string& pointer)
{
    if (node.skin == no_index || node.mesh == no_index) {
        return;
    }
    const auto& primitives = scene.meshes[node.mesh].primitives;
    const size_t joints = scene.skins[node.skin].joints.size();
    bool skinned = false;
    for (const Primitive& primitive : primitives) {
        skinned = skinned || !primitive.joints_0.empty();
        if (const uint32_t highest = highest_joint(primitive); highest >= joints) {
            data.fail(pointer + "/skin", fmt::format("mesh {} names joint {}, but skin {} has {}", node.mesh,
                                                     highest, node.skin, joints));
        }
    }
    if (!skinned && !primitives.empty()) {
        data.warn(pointer + "/skin",
                  fmt::format("mesh {} has no joints and weights; it is drawn unskinned", node.mesh));
        node.skin = no_index;
    }
}

Node import_node(Data& data, const Scene& scene, const tinygltf::Node& source, const std::string& pointer)
{
    Node node;
    node.name = source.name;
    for (const int child : source.children) {
        node.children.push_back(static_cast<Index>(child));
    }
    if (const auto shown = source.extensions.find("KHR_node_visibility"); shown != source.extensions.end()) {
        node.visible = !shown->second.Has("visible") || shown->second.Get("visible").Get<bool>();
    }
    place_node(data, source, node, pointer);
    node.mesh = index_of(source.mesh);
    node.skin = index_of(source.skin);
    node.camera = index_of(source.camera);
    if (const auto light = source.extensions.find("KHR_lights_punctual"); light != source.extensions.end()) {
        node.light = index_of(light->second.Get("light").GetNumberAsInt());
    }
    if (node.mesh != no_index && !source.weights.empty()) {
        node.morph_weights.assign(source.weights.begin(), source.weights.end());
        node.morph_weights.resize(scene.meshes[node.mesh].morph_weights.size(), 0.0F);
    }
    node.instances = import_instances(data, source, pointer);
    check_skinned_node(data, scene, node, pointer);
    return node;
}

} // namespace

void import_nodes(Data& data, Scene& scene)
{
    import_lights(data, scene);
    import_cameras(data, scene);
    import_skins(data, scene);
    const tinygltf::Model& model = data.model();
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        scene.nodes.push_back(import_node(data, scene, model.nodes[i], node_pointer(i)));
    }
    link_nodes(data, scene);
    import_links(data, scene);
    if (!model.scenes.empty()) {
        const auto shown = static_cast<size_t>(std::max(model.defaultScene, 0));
        scene.name = model.scenes[shown].name;
        clear_nodes_outside(model.scenes[shown], scene);
    }
}

} // namespace estampe::gltf
