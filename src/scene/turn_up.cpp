// SPDX-License-Identifier: MIT
#include "scene/turn_up.hpp"

#include <utility>

namespace estampe {
namespace {

/// The quarter or half turn that brings `up` to +y, by where the axes go; exact, as no angle would be.
glm::dmat3 rotation_of(UpAxis up)
{
    constexpr glm::dvec3 x(1.0, 0.0, 0.0);
    constexpr glm::dvec3 y(0.0, 1.0, 0.0);
    constexpr glm::dvec3 z(0.0, 0.0, 1.0);
    switch (up) {
    case UpAxis::x:
        return {y, -x, z};
    case UpAxis::minus_x:
        return {-y, x, z};
    case UpAxis::minus_y:
        return {-x, -y, z};
    case UpAxis::z:
        return {x, -z, y};
    case UpAxis::minus_z:
        return {x, z, -y};
    case UpAxis::y:
        break;
    }
    return {x, y, z};
}

} // namespace

void turn_up(Scene& scene, UpAxis up)
{
    if (up == UpAxis::y)
        return;
    const auto turned = static_cast<Index>(scene.nodes.size());
    Node node;
    node.name = "up";
    node.children = scene.roots;
    node.matrix = glm::dmat4(rotation_of(up));
    for (const Index root : scene.roots)
        scene.nodes[root].parent = turned;
    scene.nodes.push_back(std::move(node));
    scene.roots = {turned};
}

} // namespace estampe
