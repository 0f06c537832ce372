// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::python {

/// Computes the normals of a triangle mesh. The normal of a corner is the average of the faces at the
/// corner's position, weighted by their angles there. Only those faces count whose own normal differs by at
/// most `crease_deg` from the normal of the corner's face: 0 shades every face flat, 180 shades the whole
/// surface smoothly. Vertices whose corners get different normals are repeated, together with their other
/// attributes. The number and order of triangles stay. Cost: linear in triangles, and quadratic in the faces
/// of one position.
void compute_normals(Primitive& primitive, double crease_deg);

} // namespace estampe::python
