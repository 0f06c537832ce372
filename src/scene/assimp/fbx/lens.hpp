// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

#include "scene/assimp/fbx/document.hpp"

namespace estampe::fbx {

/// The lens of a camera of the file: field of view as its aperture mode and gate fit make it, or the height
/// of a parallel projection, and the near plane, in metres. `name` is not set.
[[nodiscard]] SceneCamera lens_of(const Properties& camera, const Document& document);

} // namespace estampe::fbx
