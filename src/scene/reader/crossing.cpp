// SPDX-License-Identifier: MIT
#include "scene/reader/crossing.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <estampe/error.hpp>

#include "core/image_codec.hpp"

namespace estampe {
namespace {

/// Checks one scene. All functions throw Error if the scene is damaged.
class SceneCheck {
public:
    SceneCheck(const Scene& scene, const std::string& where) : scene_(scene), where_(where) {}

    void all() const
    {
        for (const Texture& texture : scene_.textures)
            that(is_well_formed(texture.image));
        that(!scene_.materials.empty());
        for (const Material& each : scene_.materials)
            material(each);
        for (const Mesh& mesh : scene_.meshes)
            for (const Primitive& each : mesh.primitives)
                primitive(each);
        forest();
        for (const Node& each : scene_.nodes)
            node(each);
        for (const Skin& each : scene_.skins)
            skin(each);
        for (const Animation& each : scene_.animations)
            for (const AnimationChannel& channel : each.channels)
                animation_channel(channel);
        for (const ScenePortal& portal : scene_.portals) {
            index(portal.from, scene_.cells.size());
            index(portal.to, scene_.cells.size());
        }
    }

private:
    void that(bool holds) const
    {
        if (!holds)
            throw Error("what was read from it came back damaged", where_);
    }

    /// Checks an index that may refer to nothing.
    void index(Index value, size_t size) const { that(value == no_index || value < size); }

    void texture_reference(const TextureRef& reference) const
    {
        index(reference.texture, scene_.textures.size());
        that(reference.uv_set <= 1);
    }

    void cloth(const std::optional<Cloth>& cloth) const
    {
        if (cloth)
            index(cloth->back_material, scene_.materials.size());
    }

    void material(const Material& material) const
    {
        for (const TextureRef* const reference : {&material.base_color_texture, &material.normal_texture,
                                                  &material.occlusion_texture, &material.emissive_texture})
            texture_reference(*reference);
        if (material.toon)
            texture_reference(material.toon->shade_texture);
        cloth(material.cloth);
    }

    /// Checks that an array is empty or has `count` items.
    template <typename Item>
    void length(const std::vector<Item>& items, size_t count) const
    {
        that(items.empty() || items.size() == count);
    }

    void vertex_arrays(const Primitive& primitive) const
    {
        const size_t vertices = primitive.positions.size();
        that(vertices < no_index);
        length(primitive.normals, vertices);
        length(primitive.tangents, vertices);
        length(primitive.uvs[0], vertices);
        length(primitive.uvs[1], vertices);
        length(primitive.colors, vertices);
        length(primitive.joints_0, vertices);
        length(primitive.joints_1, vertices);
        length(primitive.held, vertices);
        that(primitive.weights_0.size() == primitive.joints_0.size());
        that(primitive.weights_1.size() == primitive.joints_1.size());
        that(!primitive.joints_0.empty() || primitive.joints_1.empty());
        for (const MorphTarget& target : primitive.morph_targets) {
            length(target.position_offsets, vertices);
            length(target.normal_offsets, vertices);
        }
    }

    void primitive(const Primitive& primitive) const
    {
        vertex_arrays(primitive);
        const size_t corners = primitive.topology == Topology::triangles ? 3
                               : primitive.topology == Topology::lines   ? 2
                                                                         : 1;
        that(primitive.indices.size() % corners == 0 && primitive.indices.size() < no_index);
        that(highest(primitive.indices) < std::max<size_t>(primitive.positions.size(), 1));
        that(primitive.indices.empty() || !primitive.positions.empty());
        that(primitive.topology != Topology::triangles ||
             primitive.normals.size() == primitive.positions.size());
        length(primitive.edge_marks, primitive.indices.size() / corners);
        that(primitive.material < scene_.materials.size());
        index(primitive.default_material, scene_.materials.size());
        length(primitive.variant_materials, scene_.variants.size());
        for (const Index material : primitive.variant_materials)
            index(material, scene_.materials.size());
    }

    /// Returns the highest index; 0 if there is none. The loop has no branch, so that the compiler uses
    /// vector instructions.
    static uint32_t highest(std::span<const uint32_t> indices)
    {
        uint32_t highest = 0;
        for (const uint32_t index : indices)
            highest = std::max(highest, index);
        return highest;
    }

    void forest() const
    {
        std::vector<bool> seen(scene_.nodes.size(), false);
        std::vector<std::pair<Index, Index>> open; // node and its parent
        const auto open_all = [&](const std::vector<Index>& nodes, Index parent) {
            for (const Index node : nodes) {
                that(node < seen.size() && !seen[node] && scene_.nodes[node].parent == parent);
                seen[node] = true;
                open.emplace_back(node, parent);
            }
        };
        open_all(scene_.roots, no_index);
        size_t count = 0;
        while (!open.empty()) {
            const Index node = open.back().first;
            open.pop_back();
            ++count;
            open_all(scene_.nodes[node].children, node);
        }
        that(count == scene_.nodes.size());
    }

    void node(const Node& node) const
    {
        index(node.mesh, scene_.meshes.size());
        index(node.skin, scene_.skins.size());
        index(node.camera, scene_.cameras.size());
        index(node.light, scene_.lights.size());
        cloth(node.cloth);
        if (node.mesh == no_index || node.skin == no_index)
            return;
        const size_t joints = scene_.skins[node.skin].joints.size();
        for (const Primitive& primitive : scene_.meshes[node.mesh].primitives)
            for (const auto* const set : {&primitive.joints_0, &primitive.joints_1})
                for (const glm::u16vec4& four : *set)
                    that(std::max({four.x, four.y, four.z, four.w}) < joints);
    }

    void skin(const Skin& skin) const
    {
        that(!skin.joints.empty() && skin.joints.size() == skin.joint_from_bind.size());
        that(highest(skin.joints) < scene_.nodes.size());
    }

    void animation_channel(const AnimationChannel& channel) const
    {
        that(channel.node < scene_.nodes.size());
        const size_t parts = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
        const size_t keys = parts * channel.times_s.size();
        that(channel.times_s.empty() == channel.values.empty());
        that(keys == 0 || channel.values.size() % keys == 0);
        const size_t width = keys == 0 ? 0 : channel.values.size() / keys;
        that(channel.path == AnimatedPath::weights || width == 0 ||
             width == (channel.path == AnimatedPath::rotation ? 4 : 3));
        that(std::ranges::is_sorted(channel.times_s));
    }

    const Scene& scene_;
    const std::string& where_;
};

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
    SceneCheck(scene, where).all();
    make_printable(scene.warnings);
}

} // namespace estampe
