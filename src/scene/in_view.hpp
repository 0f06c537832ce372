// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe {

/// Whether anything of the scene may be seen by `camera` on a page of this aspect (width / height). False is
/// certain: every mesh then lies wholly behind the camera, before its near plane or beyond one side of its
/// view. A terrain always counts as seen, and so does a scene without meshes. Cost: a box for each mesh and
/// each node until one is in view; linear in vertices where meshes bend and nothing else is in view.
[[nodiscard]] bool may_see_anything(const Scene& scene, const ScenePose& pose, const Camera& camera,
                                    double aspect);

} // namespace estampe
