// SPDX-License-Identifier: MIT
#include <algorithm>
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

/// The red of a texture at a place, between its four nearest texels.
float red_at(const Texture& texture, glm::vec2 uv)
{
    const auto wrapped = [](int at, int size, Wrap wrap) {
        if (wrap == Wrap::clamp) {
            return std::clamp(at, 0, size - 1);
        }
        const int period = wrap == Wrap::mirror ? 2 * size : size;
        const int within = (at % period + period) % period;
        return within < size ? within : period - 1 - within;
    };
    const glm::ivec2 size(texture.image.width, texture.image.height);
    const glm::vec2 place = glm::clamp(uv, -1e4F, 1e4F) * glm::vec2(size) - 0.5F;
    const glm::ivec2 corner(glm::floor(place));
    const glm::vec2 share = place - glm::vec2(corner);
    const auto red = [&](int x, int y) {
        const auto column = static_cast<size_t>(wrapped(corner.x + x, size.x, texture.wrap_u));
        const auto row = static_cast<size_t>(wrapped(corner.y + y, size.y, texture.wrap_v));
        return static_cast<float>(texture.image.rgba.at(4 * (row * static_cast<size_t>(size.x) + column)));
    };
    return glm::mix(glm::mix(red(0, 0), red(1, 0), share.x), glm::mix(red(0, 1), red(1, 1), share.x),
                    share.y) /
           255.0F;
}

/// By a texture if it says so and has UVs, else by its vertices' colours.
void hold(Primitive& primitive, const Scene& scene, Index texture)
{
    if (texture != no_index && !primitive.uvs[0].empty()) {
        primitive.held.clear();
        for (const glm::vec2& uv : primitive.uvs[0]) {
            primitive.held.push_back(red_at(scene.textures[texture], uv));
        }
        return;
    }
    if (!primitive.colors.empty()) {
        for (const glm::vec4& color : primitive.colors) {
            primitive.held.push_back(glm::clamp(color.x, 0.0F, 1.0F));
        }
        primitive.colors.clear();
    }
}

} // namespace

void import_cloth(Data& data, const std::map<Index, Index>& held_textures, Scene& scene)
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
        const auto of_node = held_texture(data, sources.nodes[i].extras, pointer);
        for (Primitive& primitive : scene.meshes[node.mesh].primitives) {
            if (cloth_of(scene, node, primitive) == nullptr) {
                continue;
            }
            const bool has_material = primitive.material < sources.materials.size();
            const auto texture = of_node || !has_material
                                     ? of_node
                                     : held_texture(data, sources.materials[primitive.material].extras,
                                                    fmt::format("/materials/{}", primitive.material));
            hold(primitive, scene, texture ? held_textures.at(*texture) : no_index);
        }
    }
}

} // namespace estampe::gltf
