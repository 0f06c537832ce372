// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/pose/mesh_data.hpp"
#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::features {

/// Returns the scene with a node and a material "terrain" appended to its lists. The terrain is drawn as this
/// node.
[[nodiscard]] Scene with_terrain_node(const Scene& scene);

/// Returns the triangles of the object that the terrain displaces, in the rest pose; empty if the terrain
/// uses another mesh method. Throws Error if the scene lacks the object that the terrain displaces.
[[nodiscard]] terrain::ObjectTriangles raised_object(const Scene& scene);

/// Returns the terrain's mesh for the time before the first view, which places the vertices. `scene` must
/// come from with_terrain_node().
[[nodiscard]] pose::ForeignMesh ground_mesh(const Scene& scene);

/// The consequences of replacing the terrain of a scene by another terrain.
struct TerrainChange {
    /// The layout of the scene must be built again, since triangles or anchor (origin of positions) differ.
    bool is_cut_otherwise = false;
    Bounds bounds; ///< Bounds of the scene with the new terrain
};

/// Compares two terrains to find what a replacement changes; `layout` is the layout of the scene with the
/// terrain `own`. Cost: two samples of the terrain.
[[nodiscard]] TerrainChange change_of(const pose::MeshData& layout, const Terrain& own, const Terrain& other);

} // namespace estampe::features
