// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Makes a primitive fit to draw: drops triangles, lines and points whose vertices are missing or not finite,
/// replaces bad normals, computes missing ones, makes weights sum to one, and shares equal vertices. Each
/// repair adds a line about `name` to `warnings`. Cost: about 0.1 s for 70,000 triangles without normals.
void mend_primitive(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// Normals of triangles, averaged by angle over the faces that meet at a place, but not across edges sharper
/// than `crease_rad`. Unshares all vertices.
void make_crease_normals(Primitive& primitive, float crease_rad);

/// Makes vertices that are equal in every respect one.
void share_vertices(Primitive& primitive);

/// Checks that every index of the scene is in range, that nodes form a forest, and that animations are well
/// formed. Throws Error with `where` as its place.
void check_structure(const Scene& scene, const std::string& where);

} // namespace estampe
