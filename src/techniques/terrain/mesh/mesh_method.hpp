// SPDX-License-Identifier: MIT
#pragma once

// How the plane is cut into triangles: methods behind one small interface, to be swapped while running.

#include <cstdint>
#include <memory>
#include <vector>

#include <estampe/terrain.hpp>

#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// Vertices, which a level's place turns into points of the plane, and triangles between them, which run
/// counter-clockwise from above.
struct MeshTopology {
    std::vector<glm::dvec3> places; ///< in the world, of vertices that are in no grid; else none
    std::vector<uint32_t> vertices; ///< words of terrain.glsl.h
    std::vector<glm::uvec3> triangles;
};

/// Where a picture is taken from, over the plane (x, z).
struct EyePlace {
    glm::dvec2 eye_m{0.0};
    glm::dvec2 ahead{1.0, 0.0}; ///< any length
};

class MeshMethod {
public:
    virtual ~MeshMethod() = default;

    /// Cost: linear in vertices.
    [[nodiscard]] virtual MeshTopology topology() const = 0;

    /// Where the levels stand about an eye, relative to an anchor whose coordinates are whole multiples of 64
    /// m.
    [[nodiscard]] virtual std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                                  const glm::dvec2& anchor_m) const = 0;
};

/// A mesh of the scene, in the world.
struct ObjectTriangles {
    std::vector<glm::dvec3> places;
    std::vector<glm::uvec3> triangles;
};

/// The method that `meshing` names; `object` is for the method that raises one. Source of the rings: Losasso
/// and Hoppe, "Geometry Clipmaps", SIGGRAPH 2004, whose neighbours here share vertices, so that nothing lies
/// between them; of the grid: Zanuttini, "Recherches en rendu non réaliste temps réel", 2008, chapter 5.
[[nodiscard]] std::unique_ptr<MeshMethod> mesh_method(const TerrainMeshing& meshing,
                                                      const ObjectTriangles& object = {});

/// The place of a vertex in the plane, from the anchor in metres; as terrain_vertices.comp finds it.
[[nodiscard]] glm::vec2 vertex_place(uint32_t vertex, const std::vector<shared::TerrainLevel>& levels);

} // namespace estampe::terrain
