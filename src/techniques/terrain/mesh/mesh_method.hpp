// SPDX-License-Identifier: MIT
#pragma once

// How the plane is divided into triangles: methods behind a small interface, which can be exchanged at run
// time.

#include <cstdint>
#include <memory>
#include <vector>

#include <estampe/terrain.hpp>

#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// The vertices and triangles of a mesh. A level's placement converts vertices to points of the plane.
/// Triangles are counter-clockwise seen from above.
struct MeshTopology {
    std::vector<glm::dvec3> places; ///< world positions of vertices that are in no grid; otherwise empty
    std::vector<uint32_t> vertices; ///< words as described in terrain.glsl.h
    std::vector<glm::uvec3> triangles;
};

/// Position and direction of the eye, projected on the plane (x, z).
struct EyePlace {
    glm::dvec2 eye_m{0.0};
    glm::dvec2 ahead{1.0, 0.0}; ///< of any length
};

class MeshMethod {
public:
    virtual ~MeshMethod() = default;

    /// Cost: linear in vertices.
    [[nodiscard]] virtual MeshTopology topology() const = 0;

    /// Places the levels around an eye, relative to an anchor whose coordinates are whole multiples of 64 m.
    [[nodiscard]] virtual std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                                  const glm::dvec2& anchor_m) const = 0;
};

/// A mesh of the scene in world space.
struct ObjectTriangles {
    std::vector<glm::dvec3> places;
    std::vector<glm::uvec3> triangles;
};

/// Creates the method that `meshing` names; `object` is used by the method that raises a mesh. Source of the
/// rings: Losasso and Hoppe, "Geometry Clipmaps", SIGGRAPH 2004, except that neighbours share vertices, so
/// that no gap remains; of the grid: Zanuttini, "Recherches en rendu non réaliste temps réel", 2008, chapter
/// 5.
[[nodiscard]] std::unique_ptr<MeshMethod> mesh_method(const TerrainMeshing& meshing,
                                                      const ObjectTriangles& object = {});

/// Position of a vertex in the plane, from the anchor in metres, as in terrain_vertices.comp.
[[nodiscard]] glm::vec2 vertex_place(uint32_t vertex, const std::vector<shared::TerrainLevel>& levels);

} // namespace estampe::terrain
