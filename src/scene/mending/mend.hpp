// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <estampe/scene.hpp>

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

} // namespace estampe
