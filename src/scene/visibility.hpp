// SPDX-License-Identifier: MIT
#pragma once

// Finds hidden nodes, and what a camera can see of the visible ones.

#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Whether each node is visible: Node::visible of the node and of all its ancestors. All code that draws,
/// lights, bounds or counts a scene uses this, or works on a scene that has been through hide_invisible().
/// Cost: linear in nodes.
[[nodiscard]] std::vector<bool> visible_nodes(const Scene& scene);

/// Removes mesh, skin, instances and light from invisible nodes, and sets Node::visible of each to false. The
/// nodes stay, because cameras, joints and the indices of other nodes depend on them.
void hide_invisible(Scene& scene);

/// Whether a visible node carries a light.
[[nodiscard]] bool has_visible_light(const Scene& scene);

/// What a camera can see of a scene.
enum class ViewContent : uint8_t {
    nothing,    ///< certain: everything lies behind the camera, before its near plane or beside its view
    backs_only, ///< certain: surfaces are in view, but all are one-sided and turn their undrawn backs to it
    something,  ///< perhaps, since surfaces in view may still hide each other or miss every pixel
};

/// What is in view, and a node whose backs are in view.
struct InView {
    ViewContent content = ViewContent::nothing;
    Index backs_of = no_index; ///< for backs_only: a node whose backs are in view; prefers the smallest box
                               ///< with the eye inside
    bool holds_eye = false;    ///< the box of `backs_of` holds the eye
};

/// Tests what `camera` can see of the scene on a page of this aspect (width / height). Hidden nodes are
/// ignored. A terrain always counts as something, and so does a scene without meshes. Cost: a box for each
/// mesh and each node and some triangles, until one in view is found that is two-sided or faces the camera;
/// at most 4 million triangles, after which the answer is `something`. Linear in vertices if meshes deform
/// and nothing else is in view.
[[nodiscard]] InView find_in_view(const Scene& scene, const ScenePose& pose, const Camera& camera,
                                  double aspect);

} // namespace estampe
