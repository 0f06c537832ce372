// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

class Check {
public:
    explicit Check(const std::string& where) : where_(where) {}

    void that(bool holds, const char* what) const
    {
        if (!holds)
            throw Error(fmt::format("is damaged: {}", what), where_,
                        "check that the file opens in other programs, or convert it to glTF");
    }

    void index(Index value, size_t size, const char* what) const
    {
        that(value == no_index || value < size, what);
    }

private:
    const std::string& where_;
};

template <typename Matrix>
bool finite(const Matrix& matrix)
{
    for (int column = 0; column < Matrix::length(); ++column)
        for (int row = 0; row < Matrix::length(); ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    return true;
}

void check_tree(const Scene& scene, const Check& check)
{
    std::vector<bool> seen(scene.nodes.size(), false);
    std::vector<std::pair<Index, Index>> pending;
    for (const Index root : scene.roots)
        pending.emplace_back(root, no_index);
    size_t count = 0;
    while (!pending.empty()) {
        const auto [index, parent] = pending.back();
        pending.pop_back();
        check.that(index < scene.nodes.size() && !seen[index] && scene.nodes[index].parent == parent,
                   "its nodes do not form a tree");
        seen[index] = true;
        ++count;
        for (const Index child : scene.nodes[index].children)
            pending.emplace_back(child, index);
    }
    check.that(count == scene.nodes.size(), "its nodes do not form a tree");
}

void check_nodes(const Scene& scene, const Check& check)
{
    for (const Node& node : scene.nodes) {
        check.index(node.mesh, scene.meshes.size(), "a node names a mesh that is not there");
        check.index(node.skin, scene.skins.size(), "a node names a skin that is not there");
        check.index(node.camera, scene.cameras.size(), "a node names a camera that is not there");
        check.index(node.light, scene.lights.size(), "a node names a light that is not there");
        check.that(finite(node.matrix ? *node.matrix : node.transform.matrix()),
                   "the place of a node is not finite");
    }
    for (const Skin& skin : scene.skins) {
        check.that(skin.joints.size() == skin.joint_from_bind.size(), "a skin lacks matrices");
        for (const Index joint : skin.joints)
            check.that(joint < scene.nodes.size(), "a skin names a node that is not there");
        for (const glm::mat4& matrix : skin.joint_from_bind)
            check.that(finite(matrix), "a matrix of a skin is not finite");
    }
}

void check_influences(const Scene& scene, const Check& check)
{
    for (const Node& node : scene.nodes) {
        if (node.skin == no_index || node.mesh == no_index)
            continue;
        const size_t joints = scene.skins[node.skin].joints.size();
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives)
            for (const auto* set : {&primitive.joints_0, &primitive.joints_1})
                for (const glm::u16vec4& four : *set)
                    check.that(std::max({four.x, four.y, four.z, four.w}) < joints,
                               "a vertex hangs on no joint");
    }
}

bool finite_numbers(const std::vector<float>& numbers)
{
    return std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}

void check_animations(const Scene& scene, const Check& check)
{
    for (const Animation& animation : scene.animations) {
        check.that(std::isfinite(animation.duration_s), "an animation has no end");
        for (const AnimationChannel& channel : animation.channels) {
            const size_t each = channel.path == AnimatedPath::rotation ? 4 : 3;
            check.that(channel.node < scene.nodes.size(), "an animation names a node that is not there");
            check.that(channel.values.size() == each * channel.times_s.size(), "an animation lacks values");
            check.that(finite_numbers(channel.times_s) && finite_numbers(channel.values),
                       "an animation has numbers that are not finite");
            check.that(std::is_sorted(channel.times_s.begin(), channel.times_s.end()),
                       "an animation runs backwards");
        }
    }
}

} // namespace

void check_structure(const Scene& scene, const std::string& where)
{
    const Check check(where);
    check_tree(scene, check);
    check_nodes(scene, check);
    check_influences(scene, check);
    check_animations(scene, check);
    for (const Material& material : scene.materials)
        check.index(material.base_color_texture.texture, scene.textures.size(),
                    "a material names a texture that is not there");
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives)
            check.that(primitive.material < scene.materials.size(),
                       "a mesh names a material that is not there");
}

} // namespace estampe
