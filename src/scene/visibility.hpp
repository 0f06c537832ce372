// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Whether each node is visible: Node::visible of the node and of all nodes above it. Everything that draws,
/// lights, bounds or counts a scene asks here, or works on a scene that has been through hide_invisible().
/// Cost: linear in nodes.
[[nodiscard]] std::vector<bool> visible_nodes(const Scene& scene);

/// Takes mesh, skin, instances and light from the nodes that are not visible, and marks each of them itself
/// as hidden. The nodes stay, because cameras, joints and the indices of other nodes depend on them.
void hide_invisible(Scene& scene);

/// Whether a visible node carries a light.
[[nodiscard]] bool has_visible_light(const Scene& scene);

} // namespace estampe
