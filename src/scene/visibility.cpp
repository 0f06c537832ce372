// SPDX-License-Identifier: MIT
#include "scene/visibility.hpp"

namespace estampe {

std::vector<bool> visible_nodes(const Scene& scene)
{
    std::vector<bool> visible;
    visible.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        visible.push_back(node.visible);
    }
    std::vector<Index> open = scene.roots;
    while (!open.empty()) {
        const Index index = open.back();
        open.pop_back();
        for (const Index child : scene.nodes[index].children) {
            visible[child] = visible[child] && visible[index];
            open.push_back(child);
        }
    }
    return visible;
}

void hide_invisible(Scene& scene)
{
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!visible[i]) {
            Node& node = scene.nodes[i];
            node.visible = false;
            node.mesh = node.skin = node.light = no_index;
            node.instances.clear();
        }
    }
}

bool has_visible_light(const Scene& scene)
{
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (visible[i] && scene.nodes[i].light != no_index) {
            return true;
        }
    }
    return false;
}

} // namespace estampe
