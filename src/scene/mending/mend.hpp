// SPDX-License-Identifier: MIT
#pragma once

// Repairs primitives and scenes so that they can be drawn: indices, normals, tangents, weights, shared
// vertices.

#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

namespace estampe::gltf {

/// Converts strips, fans and loops to lists. `mode` is glTF's (0 points ... 6 triangle fan). Leaves out
/// triangles of a strip or fan that use a vertex twice, and an incomplete last one.
[[nodiscard]] std::vector<uint32_t> list_indices(int mode, const std::vector<uint32_t>& indices);

/// Keeps the vertices at `order`, in that order, in every array of the primitive and its morph targets.
void pick_vertices(Primitive& primitive, const std::vector<uint32_t>& order);

/// Drops vertices that no index uses, if they are the majority.
void drop_unused_vertices(Primitive& primitive);

/// Gives every triangle its own vertices and one flat normal, as glTF requires for a file without normals.
void make_flat_normals(Primitive& primitive);

/// Replaces normals that are zero or not finite by the average of the faces around them, and makes all of
/// them unit length. Returns how many were replaced.
[[nodiscard]] size_t repair_normals(Primitive& primitive);

/// Computes tangents along +u of UV set `uv_set`, averaged over the faces at each vertex and orthogonal to
/// its normal.
void make_tangents(Primitive& primitive, uint32_t uv_set);

/// Makes the weights sum to one; joints without weight become joint 0. A vertex without usable weights
/// follows its first joint. Returns how many such vertices there were.
[[nodiscard]] size_t normalise_weights(Primitive& primitive);

} // namespace estampe::gltf

namespace estampe {

/// Repairs a primitive so that it can be drawn: drops triangles, lines and points whose vertices are missing
/// or not finite, replaces bad normals, computes missing ones, makes weights sum to one, and merges equal
/// vertices. Each repair adds a line about `name` to `warnings`. Cost: about 0.4 s for a million triangles.
void mend_primitive(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// An index for the position of each vertex, from 0: vertices at equal positions have the same index. Stores
/// the number of distinct positions in `count` unless it is null. Cost: linear.
[[nodiscard]] std::vector<uint32_t> places_of_vertices(const Primitive& primitive, size_t* count = nullptr);

/// Reverses the winding of a triangle by swapping its last two corners; its edge marks follow.
void turn_triangle(Primitive& primitive, size_t triangle);

/// Makes the winding of triangles that share an edge consistent: in each connected piece, reverses the part
/// with the smaller area. Edges of more than two triangles separate pieces. A piece that cannot be made
/// consistent, such as a Moebius strip, is not changed. Requires a primitive of triangles with indices in
/// range. Returns how many triangles were reversed. Cost: linear in triangles, and small if all agree.
size_t agree_winding(Primitive& primitive);

/// Calls agree_winding(), and adds a line about `name` to `warnings` if triangles were reversed.
void agree_winding(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// Crease angle of 47 degrees, so that the eight sides of a coarse tube are still shaded smoothly.
inline constexpr float usual_crease_rad = 0.82F;

/// Computes unit normals of triangles: the angle-weighted average of the faces that meet at a position, but
/// not across edges sharper than `crease_rad`. Vertices that are equal in every respect, including the new
/// normals, are merged, in the order in which the triangles use them.
///
/// `groups` has a smoothing group for each triangle, or is empty. Triangles of one group are smoothed however
/// sharp the edge between them, those of group 0 are flat, and `crease_rad` decides among those without a
/// group, `no_index`. Uses a second thread for large meshes, with the same result. Cost: about 0.25 s for a
/// million triangles.
void make_crease_normals(Primitive& primitive, float crease_rad, std::span<const uint32_t> groups = {});

/// Merges vertices that are equal in every respect.
void share_vertices(Primitive& primitive);

/// Checks that every index of the scene is in range, that nodes form a forest, and that animations are well
/// formed. Throws Error with `where` as its place.
void check_structure(const Scene& scene, const std::string& where);

/// Repairs the meshes of a scene so that they can be drawn. Primitives without a material get the first one,
/// which is added if there is none; mend_primitive() repairs each; those with nothing to draw are removed.
/// Throws Error with `where` as its place when nothing is left.
void mend_meshes(Scene& scene, const std::string& where);

/// The last step of every reader: repairs the meshes, reverses pieces that are inside out, and computes the
/// tangents that materials need. Throws Error with `where` as its place when there is nothing to draw.
void finish_import(Scene& scene, const std::string& where);

/// Calls `read`, and throws Error if it runs out of memory.
template <typename Read>
Scene within_memory(const std::string& where, Read read)
{
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw Error("does not fit into memory", where);
    } catch (const std::length_error&) {
        throw Error("does not fit into memory", where);
    }
}

} // namespace estampe
