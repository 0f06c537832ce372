// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe {

/// Turns a scene whose coordinates have `up` pointing up so that this axis becomes +y: all roots become
/// children of one new root node, so that cameras, lights, skins and animations turn with the meshes. What
/// was in front comes to +z: of z up it is -y, as Blender exports glTF. Changes nothing if y is up already.
void turn_up(Scene& scene, UpAxis up);

} // namespace estampe
