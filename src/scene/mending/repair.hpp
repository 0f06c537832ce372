// SPDX-License-Identifier: MIT
#pragma once

// Repairs of common faults in files of any format, if the data alone reveals the fault. Each repair function
// changes a loaded scene in place. load_scene() calls all repair functions.

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reverses triangles of two-sided materials if all three normals contradict the winding. The winding decides
/// which side of a two-sided surface is lit, so a mesh with mixed winding and right normals would be lit as a
/// patchwork. One-sided triangles are not changed, because their winding defines from which side they are
/// visible. Cost: linear in triangles.
void turn_by_normals(Scene& scene);

/// Removes outline hulls: enlarged copies of a mesh, inside out and one-sided, with which games draw
/// outlines. Estampe draws outlines itself, and a hull would enclose and darken the figure. Adds a line to
/// Scene::warnings for each hull. Cost: linear in vertices and triangles, and quadratic in the number of
/// meshes with equal triangle count.
void leave_out_outline_hulls(Scene& scene);

/// Replaces the alpha mode of a material by a cheaper mode if the alpha values allow it. Alpha is sampled
/// over the surfaces of the material. If nearly all samples are fully clear or solid, as for leaves, hair and
/// fences, the mode becomes `mask`. If all samples are solid, the mode becomes `opaque`, also instead of
/// `mask`. Lines and shadows can then follow the alpha. Glass, smoke and soft decals stay blended;
/// Material::has_clear_parts tells whether parts of their surfaces are fully transparent. Also sets
/// Material::is_foliage. Cost: linear in triangles of the examined materials, at most half a million samples
/// per material.
void find_cut_out_materials(Scene& scene);

/// Reverses the winding of closed, two-sided, consistently wound pieces of meshes that are inside out.
/// One-sided pieces are not changed, because their winding defines from which side they are visible. If a
/// piece contains other pieces that are not inside out, it is a room and is not changed. Adds a line to
/// Scene::warnings for each changed mesh. Cost: about 0.01 s for 70,000 triangles that need no change.
void turn_outside(Scene& scene);

} // namespace estampe
