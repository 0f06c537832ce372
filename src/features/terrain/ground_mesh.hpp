// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/pose/mesh_data.hpp"
#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::features {

/// The scene with a node and a material "terrain" at their lists' ends, which its terrain is drawn as.
[[nodiscard]] Scene with_terrain_node(const Scene& scene);

/// The object that a terrain raises, as it stands in the rest pose; nothing for other methods. Throws Error
/// where the scene has no such object.
[[nodiscard]] terrain::ObjectTriangles raised_object(const Scene& scene);

/// The mesh of the terrain of a scene with such a node, as it lies before any eye has looked.
[[nodiscard]] pose::ForeignMesh ground_mesh(const Scene& scene);

/// What another terrain in place of a scene's own asks for.
struct TerrainChange {
    bool is_cut_otherwise = false; ///< all is to be laid out anew: triangles differ, or the anchor would
    Bounds bounds;                 ///< of the scene with it
};

/// `layout` is of the scene with its own terrain. Cost: two samples.
[[nodiscard]] TerrainChange change_of(const pose::MeshData& layout, const Terrain& own, const Terrain& other);

} // namespace estampe::features
