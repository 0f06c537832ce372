// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Makes the meshes of a scene fit to draw: primitives without a material get the first one, which is made if
/// there is none; each is mended as mend_primitive() does; those that have nothing to draw are removed.
/// Throws Error with `where` as its place when nothing is left.
void mend_meshes(Scene& scene, const std::string& where);

/// Computes the tangents of primitives whose material has a picture of normals.
void make_needed_tangents(Scene& scene);

} // namespace estampe
