// SPDX-License-Identifier: MIT
#include <cctype>

#include "scene/gltf/convert.hpp"
#include "scene/gltf/extras.hpp"

namespace estampe::gltf {
namespace {

/// "cloth", or that with something behind it that is no letter: "cloth_flag", "Cloth.001".
bool names_cloth(const std::string& name)
{
    constexpr std::string_view word = "cloth";
    for (size_t i = 0; i < word.size(); ++i) {
        if (i >= name.size() || (name[i] | 0x20) != word[i]) {
            return false;
        }
    }
    return name.size() == word.size() || std::isalpha(static_cast<unsigned char>(name[word.size()])) == 0;
}

} // namespace

void import_cloth(const Data& data, Scene& scene)
{
    const auto& sources = data.model();
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (names_cloth(material.name)) {
            material.cloth = Cloth{};
        }
        if (i < sources.materials.size()) {
            read_cloth_extras(data, sources.materials[i].extras, fmt::format("/materials/{}", i),
                              material.cloth);
        }
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        Node& node = scene.nodes[i];
        const std::string pointer = fmt::format("/nodes/{}", i);
        read_collider_extras(data, sources.nodes[i].extras, pointer, node.collider);
        if (names_cloth(node.name) && node.mesh != no_index) {
            node.cloth = Cloth{};
        }
        read_cloth_extras(data, sources.nodes[i].extras, pointer, node.cloth);
        if (node.mesh == no_index) {
            continue;
        }
        for (Primitive& primitive : scene.meshes[node.mesh].primitives) {
            if (cloth_of(scene, node, primitive) != nullptr && !primitive.colors.empty()) {
                for (const glm::vec4& color : primitive.colors) {
                    primitive.held.push_back(glm::clamp(color.x, 0.0F, 1.0F));
                }
                primitive.colors.clear();
            }
        }
    }
}

} // namespace estampe::gltf
