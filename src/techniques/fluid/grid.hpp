// SPDX-License-Identifier: MIT
#pragma once

// The simulation grid of a fluid, and the boundary conditions on the grid's sides.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/fluid/fluid.glsl.h"

namespace estampe::fluid {

/// Boundary condition at both ends of an axis of the fluid's grid.
enum class Edge : uint8_t {
    periodic, ///< the two ends of the axis are connected
    no_slip,  ///< the axis ends at walls that hold the fluid next to the wall still
    free_slip ///< the ends are walls along which the fluid slides
};

/// A fluid's marker-and-cell grid: velocity components are stored on cell faces, one component per face;
/// quantities are stored at cell centres.
struct Grid {
    glm::uvec3 cells{0, 0, 1}; ///< number of cells: 4 to 4096 along x and y; along z 1 (2D) or 4 to 256 (3D)
    float cell_m = 1.0F;
    std::array<Edge, 3> edges{Edge::no_slip, Edge::no_slip, Edge::no_slip};
    glm::vec3 lid_m_per_s{0.0F}; ///< velocity of the wall at the high end of y, parallel to that wall

    [[nodiscard]] bool is_volume() const { return cells.z > 1; }

    [[nodiscard]] uint32_t dimensions() const { return is_volume() ? 3 : 2; }

    [[nodiscard]] uint64_t cell_count() const { return uint64_t{cells.x} * cells.y * cells.z; }

    [[nodiscard]] bool is_periodic(uint32_t axis) const { return edges[axis] == Edge::periodic; }

    bool operator==(const Grid&) const = default;
};

/// Absorbing layer that imitates open ends of the grid. Near a face, except the low face of y, the layer
/// gradually replaces the fluid by outside air.
struct Rim {
    float breadth_m = 0.0F;   ///< thickness of the absorbing layer; 0 turns the layer off
    float share_per_s = 0.0F; ///< rate at which outside air replaces the fluid at an open face of the grid

    bool operator==(const Rim&) const = default;
};

/// Throws std::logic_error if a member of the grid is out of range.
void check_grid(const Grid& grid);

/// Constants and bits of `variant` that describe the grid to shaders.
[[nodiscard]] shared::FluidGrid grid_constants(const Grid& grid);
[[nodiscard]] uint32_t grid_bits(const Grid& grid);

/// Description of an image array with `channels` values per cell. The array has at least two layers, so that
/// shaders see an array.
[[nodiscard]] gpu::ImageDesc field_desc(const Grid& grid, uint32_t channels);
[[nodiscard]] gpu::ImageDesc velocity_desc(const Grid& grid);

/// Description of an image for `sets` vector fields at cell centres, in half floats: one texel per vector,
/// one layer per slice. Half floats hold displacements of a few cells to a thousandth of a cell, or forces.
/// Shaders fetch the texels without filtering.
[[nodiscard]] gpu::ImageDesc vectors_desc(const Grid& grid, uint32_t sets);

/// Dispatches a pass with one thread per cell of the grid.
void dispatch_over_cells(gpu::Pass& pass, const Grid& grid);

/// Push constants of a pass over a grid: the grid's constants, followed by the pass's constants.
template <class T>
struct WithGrid {
    shared::FluidGrid grid;
    T rest;
};

} // namespace estampe::fluid
