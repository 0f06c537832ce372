// SPDX-License-Identifier: MIT
#pragma once

// The simulation grid of a fluid, and the boundary conditions on its sides.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/fluid/fluid.glsl.h"

namespace estampe::fluid {

/// Boundary condition at both ends of an axis.
enum class Edge : uint8_t {
    periodic, ///< the two ends are connected
    no_slip,  ///< walls that hold the fluid next to them still
    free_slip ///< walls along which the fluid slides
};

/// Marker-and-cell grid: velocity components are stored on cell faces, one component per face; quantities are
/// stored at cell centres.
struct Grid {
    glm::uvec3 cells{0, 0, 1}; ///< 4 to 4096 along x and y. Along z: 1 for a 2D fluid, 4 to 256 for 3D
    float cell_m = 1.0F;
    std::array<Edge, 3> edges{Edge::no_slip, Edge::no_slip, Edge::no_slip};
    glm::vec3 lid_m_per_s{0.0F}; ///< velocity of the wall at the high end of y, parallel to that wall

    [[nodiscard]] bool is_volume() const { return cells.z > 1; }

    [[nodiscard]] uint32_t dimensions() const { return is_volume() ? 3 : 2; }

    [[nodiscard]] uint64_t cell_count() const { return uint64_t{cells.x} * cells.y * cells.z; }

    [[nodiscard]] bool is_periodic(uint32_t axis) const { return edges[axis] == Edge::periodic; }

    bool operator==(const Grid&) const = default;
};

/// Absorbing layer that imitates open ends: near a face, except the low face of y, the fluid is gradually
/// replaced by the outside air.
struct Rim {
    float breadth_m = 0.0F;   ///< 0 turns the layer off
    float share_per_s = 0.0F; ///< initial rate of replacement at the face

    bool operator==(const Rim&) const = default;
};

/// Throws std::logic_error if a member of the grid is out of range.
void check_grid(const Grid& grid);

/// Constants and shader variant bits that describe the grid.
[[nodiscard]] shared::FluidGrid grid_constants(const Grid& grid);
[[nodiscard]] uint32_t grid_bits(const Grid& grid);

/// An image array of `channels` values per cell. It has at least two layers, so that shaders see an array.
[[nodiscard]] gpu::ImageDesc field_desc(const Grid& grid, uint32_t channels);
[[nodiscard]] gpu::ImageDesc velocity_desc(const Grid& grid);

/// `sets` vector fields at cell centres, in half floats: one texel per vector, one layer per slice. They hold
/// displacements of a few cells to a thousandth of a cell, or forces. Shaders fetch them without filtering.
[[nodiscard]] gpu::ImageDesc vectors_desc(const Grid& grid, uint32_t sets);

/// Dispatches one thread per cell.
void dispatch_over_cells(gpu::Pass& pass, const Grid& grid);

/// Push constants of a pass over a grid: the grid's constants, followed by the pass's own.
template <class T>
struct WithGrid {
    shared::FluidGrid grid;
    T rest;
};

} // namespace estampe::fluid
