// SPDX-License-Identifier: MIT
#pragma once

#include "scene/assimp/converter.hpp"
#include "scene/assimp/fbx/document.hpp"

namespace estampe {

/// Puts into the converted scene what Assimp leaves out of an FBX file: pivots and fixed turns of nodes, axes
/// and unit of the file, cameras and what cameras and lights look at, frame rate and length of animations.
/// The file must have been read with its pivots hidden, see fbx::hide_pivots().
void apply_fbx(Conversion& conversion, const fbx::Document& document);

} // namespace estampe
