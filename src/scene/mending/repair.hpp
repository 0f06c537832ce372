// SPDX-License-Identifier: MIT
#pragma once

// What files of real tools get wrong in a way that can be told from the data, whatever their format. Each
// function changes a loaded scene in place; load_scene calls all of them.

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Turns around triangles of two-sided materials whose corners run against all three of their normals, so
/// that both say the same side. Renderers take the side of a two-sided surface from the order of the corners:
/// a mesh of mixed order with right normals would be lit as a patchwork. One-sided triangles stay as they
/// are, since their order says what may be seen. Cost: linear in triangles.
void turn_by_normals(Scene& scene);

/// Leaves out outline hulls: larger copies of a mesh, turned inside out and one-sided, with which games draw
/// outlines. Estampe draws lines of its own; a hull would darken and enclose the figure. One line in
/// `Scene::warnings` for each. Cost: linear in vertices and triangles, and square in meshes of one triangle
/// count.
void leave_out_outline_hulls(Scene& scene);

/// Gives materials of alpha mode `blend` the mode that their alpha asks for, sampled over the surfaces they
/// cover: `mask` where nearly all of it is either clear or solid, as leaves, hair and fences are, and
/// `opaque` where all of it is solid. Lines and shadows then follow the alpha. Glass, smoke and soft decals
/// stay blended, and Material::has_clear_parts says whether they end at the edges of their surfaces. Cost:
/// linear in triangles of such materials, at most half a million samples per material.
void find_cut_out_materials(Scene& scene);

/// Turns over what a file has inside out: two-sided pieces of meshes that are closed and wound one way all
/// over, with their backs to the outside. What is one-sided stays, since its winding says what may be seen. A
/// piece with other things inside, but for such as it is itself, is a room and stays. Adds a line to
/// Scene::warnings for each mesh. Cost: about 0.01 s for 70,000 triangles that are all right.
void turn_outside(Scene& scene);

} // namespace estampe
