// SPDX-License-Identifier: MIT
#pragma once

// Makes primitives and scenes fit to draw: indices, normals, tangents, weights, shared vertices.

#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <estampe/error.hpp>
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

namespace estampe {

/// Makes a primitive fit to draw: drops triangles, lines and points whose vertices are missing or not finite,
/// replaces bad normals, computes missing ones, makes weights sum to one, and shares equal vertices. Each
/// repair adds a line about `name` to `warnings`. Cost: about 0.4 s for a million triangles.
void mend_primitive(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// The number of each vertex's place, from 0: vertices at equal positions have one. `count`, where it is
/// given, becomes how many places there are. Cost: linear.
[[nodiscard]] std::vector<uint32_t> places_of_vertices(const Primitive& primitive, size_t* count = nullptr);

/// Swaps the last two corners of a triangle, so that it is seen from its other side; its edge marks follow.
void turn_triangle(Primitive& primitive, size_t triangle);

/// Turns triangles around so that those which share an edge agree on its side: in each connected piece, the
/// smaller part by area. Edges of more than two triangles part pieces; a piece that cannot agree, as a
/// Moebius strip, stays as it is. The primitive is of triangles, its indices are in range. Returns how many
/// were turned. Cost: linear in triangles, and small where all agree.
size_t agree_winding(Primitive& primitive);

/// The same, with a line about `name` in `warnings` when triangles were turned.
void agree_winding(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// 47 degrees, so that the eight sides of a coarse tube still run together.
inline constexpr float usual_crease_rad = 0.82F;

/// Normals of triangles, of unit length: averaged by angle over the faces that meet at a place, but not
/// across edges sharper than `crease_rad`. Vertices that are equal in every respect, their new normals too,
/// become one, in the order in which the triangles name them.
///
/// `groups` has a smoothing group for each triangle, or is empty. Triangles of one group run together however
/// sharp the edge between them, those of group 0 are flat, and those without a group, `no_index`, follow
/// `crease_rad` among each other. Uses a second thread for large meshes; the result is the same. Cost: about
/// 0.25 s for a million triangles.
void make_crease_normals(Primitive& primitive, float crease_rad, std::span<const uint32_t> groups = {});

/// Makes vertices that are equal in every respect one.
void share_vertices(Primitive& primitive);

/// Checks that every index of the scene is in range, that nodes form a forest, and that animations are well
/// formed. Throws Error with `where` as its place.
void check_structure(const Scene& scene, const std::string& where);

/// Makes the meshes of a scene fit to draw: primitives without a material get the first one, which is made if
/// there is none; each is mended as mend_primitive() does; those that have nothing to draw are removed.
/// Throws Error with `where` as its place when nothing is left.
void mend_meshes(Scene& scene, const std::string& where);

/// What every reader does in the end: mends the meshes, turns what is inside out, computes the tangents that
/// materials need. Throws Error with `where` as its place when there is nothing to draw.
void finish_import(Scene& scene, const std::string& where);

/// Calls `read`, and throws Error where it runs out of memory.
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
