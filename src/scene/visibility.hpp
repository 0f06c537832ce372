// SPDX-License-Identifier: MIT
#pragma once

// Determines which nodes are visible, and what a camera can see of the visible nodes.

#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Returns for each node whether Node::visible is set for the node and all its ancestors. All code that
/// draws, lights, bounds or counts a scene calls this function, or works on a scene after hide_invisible().
/// Cost: linear in nodes.
[[nodiscard]] std::vector<bool> visible_nodes(const Scene& scene);

/// Removes mesh, skin, instances and light from invisible nodes, and sets their Node::visible to false. The
/// nodes themselves are kept, because cameras, joints and the indices of other nodes refer to them.
void hide_invisible(Scene& scene);

/// Returns whether any visible node has a light.
[[nodiscard]] bool has_visible_light(const Scene& scene);

/// What a camera can see of a scene.
enum class ViewContent : uint8_t {
    /// Nothing is in view; certain: everything is behind the camera, before its near plane or beside its
    /// view.
    nothing,
    /// Only back faces are in view; certain: all surfaces in view are one-sided and face away, so none is
    /// drawn.
    backs_only,
    something, ///< something may be in view, but surfaces may still hide each other or cover no pixel
};

/// Result of find_in_view(): what is in view, and a node whose back faces are in view.
struct InView {
    ViewContent content = ViewContent::nothing;
    Index backs_of = no_index; ///< for backs_only: a node whose back faces are in view; prefers the
                               ///< smallest bounding box that contains the eye
    bool holds_eye = false;    ///< the bounding box of `backs_of` contains the eye
};

/// Tests what `camera` can see of the visible nodes on a page of this aspect (width / height). A scene with a
/// terrain or without meshes always returns `something`. Cost: a box test for each mesh and each node, and
/// triangle tests until a triangle in view is two-sided or faces the camera. After 4 million triangles the
/// result is `something`. The cost is linear in vertices if only deforming meshes are in view.
[[nodiscard]] InView find_in_view(const Scene& scene, const ScenePose& pose, const Camera& camera,
                                  double aspect);

} // namespace estampe
