// SPDX-License-Identifier: MIT
#pragma once

// The grid that a fluid is worked out on, and what bounds it.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/fluid/fluid.glsl.h"

namespace estampe::fluid {

/// What is at both ends of an axis.
enum class Edge : uint8_t {
    periodic, ///< they meet
    no_slip,  ///< walls that hold what touches them
    free_slip ///< walls that what touches them glides along
};

/// Velocities stand on the faces of cells, one component on each (marker-and-cell), quantities in their
/// middle.
struct Grid {
    glm::uvec3 cells{0, 0, 1}; ///< 4 to 4096 along x and y; along z 1 for two dimensions, or 4 to 256
    float cell_m = 1.0F;
    std::array<Edge, 3> edges{Edge::no_slip, Edge::no_slip, Edge::no_slip};
    glm::vec3 lid_m_per_s{0.0F}; ///< of the wall at the high end of y, along itself

    [[nodiscard]] bool is_volume() const { return cells.z > 1; }

    [[nodiscard]] uint32_t dimensions() const { return is_volume() ? 3 : 2; }

    [[nodiscard]] uint64_t cell_count() const { return uint64_t{cells.x} * cells.y * cells.z; }

    [[nodiscard]] bool is_periodic(uint32_t axis) const { return edges[axis] == Edge::periodic; }

    bool operator==(const Grid&) const = default;
};

/// Stands for open ends: what comes near a face, but for the low one of y, goes over into the air outside.
struct Rim {
    float breadth_m = 0.0F;   ///< 0: none
    float share_per_s = 0.0F; ///< at the face, at first

    bool operator==(const Rim&) const = default;
};

/// Throws std::logic_error for what is no grid.
void check_grid(const Grid& grid);

/// What the shaders are told of it: constants, and bits of their variants.
[[nodiscard]] shared::FluidGrid grid_constants(const Grid& grid);
[[nodiscard]] uint32_t grid_bits(const Grid& grid);

/// An image array of `channels` numbers a cell; there are at least two layers, so that it is an array to
/// shaders.
[[nodiscard]] gpu::ImageDesc field_desc(const Grid& grid, uint32_t channels);
[[nodiscard]] gpu::ImageDesc velocity_desc(const Grid& grid);

/// So many sets of vectors in the middle of cells, which are read as they stand: a texel each, slice by
/// slice, in halves: ways of some cells to a thousandth, and forces.
[[nodiscard]] gpu::ImageDesc vectors_desc(const Grid& grid, uint32_t sets);

/// A thread a cell.
void dispatch_over_cells(gpu::Pass& pass, const Grid& grid);

/// Constants of a pass over a grid, behind those of the grid.
template <class T>
struct WithGrid {
    shared::FluidGrid grid;
    T rest;
};

} // namespace estampe::fluid
