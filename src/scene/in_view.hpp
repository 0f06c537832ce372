// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe {

/// What a camera can see of a scene.
enum class ViewContent : uint8_t {
    nothing,    ///< certain: all of it lies behind the camera, before its near plane or beside its view
    backs_only, ///< certain: surfaces are in view, but all are one-sided and turn their undrawn backs to it
    something,  ///< perhaps, since surfaces in view may still hide each other or miss every pixel
};

/// What is in view, and of what the backs are.
struct InView {
    ViewContent content = ViewContent::nothing;
    Index backs_of = no_index; ///< for backs_only: a node whose backs are in view, if possible one whose box
                               ///< holds the eye; the smallest of these
    bool holds_eye = false;    ///< the box of `backs_of` holds the eye
};

/// Looks at the scene through `camera` on a page of this aspect (width / height). Hidden nodes do not count.
/// A terrain always counts as something, and so does a scene without meshes. Cost: a box for each mesh and
/// each node and some triangles, until one in view is found that is two-sided or faces the camera; at most 4
/// million triangles, after which the answer is `something`. Linear in vertices where meshes bend and nothing
/// else is in view.
[[nodiscard]] InView find_in_view(const Scene& scene, const ScenePose& pose, const Camera& camera,
                                  double aspect);

} // namespace estampe
