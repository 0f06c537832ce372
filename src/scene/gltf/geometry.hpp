// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::gltf {

/// Turns strips, fans and loops into lists. `mode` is glTF's (0 points ... 6 triangle fan). Triangles of a
/// strip or fan that use a vertex twice are left out, and so is an incomplete last one.
[[nodiscard]] std::vector<uint32_t> list_indices(int mode, const std::vector<uint32_t>& indices);

/// Keeps the vertices at `order`, in that order, of every array of the primitive, morph targets included.
void pick_vertices(Primitive& primitive, const std::vector<uint32_t>& order);

/// Drops vertices that no index names, when they are most of them.
void drop_unused_vertices(Primitive& primitive);

/// Gives every triangle vertices and a normal of its own: what glTF asks for when a file has no normals.
void make_flat_normals(Primitive& primitive);

/// Replaces normals that are zero or not finite by the average of the faces around them, and makes all of
/// them unit length. Returns how many were replaced.
[[nodiscard]] size_t repair_normals(Primitive& primitive);

/// Tangents along +u of UV set `uv_set`, averaged over the faces at each vertex and orthogonal to its normal.
void make_tangents(Primitive& primitive, uint32_t uv_set);

/// Makes the weights sum to one; joints without weight become joint 0. Returns how many vertices had no
/// usable weight and now hang on their first joint.
[[nodiscard]] size_t normalise_weights(Primitive& primitive);

} // namespace estampe::gltf
