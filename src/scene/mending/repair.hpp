// SPDX-License-Identifier: MIT
#pragma once

// Repairs common faults of real files that can be recognised from the data, whatever the format. Each
// function changes a loaded scene in place; load_scene() calls all of them.

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reverses triangles of two-sided materials whose winding contradicts all three of their normals. Renderers
/// take the side of a two-sided surface from the winding: a mesh of mixed winding with right normals would be
/// lit as a patchwork. One-sided triangles are not changed, because their winding says from where they are
/// visible. Cost: linear in triangles.
void turn_by_normals(Scene& scene);

/// Removes outline hulls: larger copies of a mesh, inside out and one-sided, with which games draw outlines.
/// Estampe draws its own lines; a hull would darken and enclose the figure. Adds one line to
/// `Scene::warnings` for each. Cost: linear in vertices and triangles, and quadratic in the number of meshes
/// with equal triangle count.
void leave_out_outline_hulls(Scene& scene);

/// Replaces alpha mode `blend` of materials by the mode that their alpha needs, sampled over the surfaces
/// they cover: `mask` if nearly all of it is either clear or solid, as in leaves, hair and fences, and
/// `opaque` if all of it is solid. Lines and shadows can then follow the alpha. Glass, smoke and soft decals
/// stay blended, and Material::has_clear_parts says whether they end at the edges of their surfaces. Cost:
/// linear in triangles of such materials, at most half a million samples per material.
void find_cut_out_materials(Scene& scene);

/// Reverses pieces that are inside out: two-sided, closed and consistently wound pieces of meshes whose backs
/// face outwards. One-sided pieces are not changed, because their winding says from where they are visible. A
/// piece that contains other kinds of pieces is a room and is not changed. Adds a line to Scene::warnings for
/// each mesh. Cost: about 0.01 s for 70,000 triangles that need no change.
void turn_outside(Scene& scene);

} // namespace estampe
