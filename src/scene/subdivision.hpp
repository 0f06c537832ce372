// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <estampe/scene.hpp>

namespace estampe {

/// The triangles of `primitive` divided into four, `levels` times, towards the smooth surface that they are
/// the cage of. Vertices at one place are one; borders stay; edges of more than two triangles count as
/// borders. The result has positions and smooth normals alone. Cost: linear in the triangles of the result.
///
/// Source  Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987
[[nodiscard]] Primitive subdivided(const Primitive& primitive, uint32_t levels);

} // namespace estampe
