// SPDX-License-Identifier: MIT
#pragma once

// Methods that divide the ground plane into triangles. All methods share one small interface, so the method
// can be changed at run time.

#include <cstdint>
#include <memory>
#include <vector>

#include <estampe/terrain.hpp>

#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// The vertices and triangles of a terrain's mesh. A vertex is stored as a column and row of one level of
/// detail. The position of the level of detail converts column and row to a point of the plane. Triangles are
/// counter-clockwise as seen from above.
struct MeshTopology {
    /// World positions of the vertices if they are in no grid; otherwise empty.
    std::vector<glm::dvec3> places;
    std::vector<uint32_t> vertices; ///< one word per vertex: column, row, part and level, see terrain.glsl.h
    std::vector<glm::uvec3> triangles;
};

/// Position and direction of the eye, projected to the plane (x, z).
struct EyePlace {
    glm::dvec2 eye_m{0.0};
    glm::dvec2 ahead{1.0, 0.0}; ///< direction of view; its length does not matter
};

class MeshMethod {
public:
    virtual ~MeshMethod() = default;

    /// Computes the vertices and triangles. Cost: linear in the number of vertices.
    [[nodiscard]] virtual MeshTopology topology() const = 0;

    /// Computes the position of each level of detail around an eye, relative to an anchor point. The anchor's
    /// coordinates must be whole multiples of 64 m.
    [[nodiscard]] virtual std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                                  const glm::dvec2& anchor_m) const = 0;
};

/// A mesh of the scene, with positions in world space.
struct ObjectTriangles {
    std::vector<glm::dvec3> places;
    std::vector<glm::uvec3> triangles;
};

/// Creates the method that `meshing` names. Only the method that raises an existing mesh uses `object`.
///
/// Source  rings: Losasso and Hoppe, "Geometry Clipmaps", SIGGRAPH 2004, but neighbouring rings share
/// vertices, so that no gap remains; grid: Zanuttini, "Recherches en rendu non réaliste temps réel", 2008,
/// chapter 5
[[nodiscard]] std::unique_ptr<MeshMethod> mesh_method(const TerrainMeshing& meshing,
                                                      const ObjectTriangles& object = {});

/// Position of a vertex in the plane, in metres from the anchor. The shader terrain_vertices.comp computes an
/// equal position.
[[nodiscard]] glm::vec2 vertex_place(uint32_t vertex, const std::vector<shared::TerrainLevel>& levels);

} // namespace estampe::terrain
