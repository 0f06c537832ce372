// SPDX-License-Identifier: MIT
#include "scene/turn_up.hpp"

#include <numbers>

namespace estampe {
namespace {

/// The quarter or half turn that brings `up` to +y.
glm::dquat rotation_of(UpAxis up)
{
    constexpr double quarter = 0.5 * std::numbers::pi;
    constexpr glm::dvec3 x(1.0, 0.0, 0.0);
    constexpr glm::dvec3 z(0.0, 0.0, 1.0);
    switch (up) {
    case UpAxis::x:
        return glm::angleAxis(quarter, z);
    case UpAxis::minus_x:
        return glm::angleAxis(-quarter, z);
    case UpAxis::minus_y:
        return glm::angleAxis(2.0 * quarter, z);
    case UpAxis::z:
        return glm::angleAxis(-quarter, x);
    case UpAxis::minus_z:
        return glm::angleAxis(quarter, x);
    case UpAxis::y:
        break;
    }
    return {1.0, 0.0, 0.0, 0.0};
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
    node.transform.rotation = rotation_of(up);
    for (const Index root : scene.roots)
        scene.nodes[root].parent = turned;
    scene.nodes.push_back(std::move(node));
    scene.roots = {turned};
}

} // namespace estampe
