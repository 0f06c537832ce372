// SPDX-License-Identifier: MIT
#pragma once

// The methods that mesh_method() chooses from.

#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::terrain {

/// Square grids about the eye, one within the other, each of twice the cell of the one within and with a hole
/// for it. A grid goes with the eye in steps of two of its cells, so that its even vertices are vertices of
/// the next. Its outermost triangles use even vertices alone along the border, and heights there are those
/// that the next grid would have: neighbours share their edges bit for bit. As the hole may be off by a cell
/// each way, a trim of one column and one row of cells goes where the gap is.
class Rings : public MeshMethod {
public:
    explicit Rings(const TerrainMeshing& meshing);

    [[nodiscard]] MeshTopology topology() const override;
    [[nodiscard]] std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                          const glm::dvec2& anchor_m) const override;

private:
    double cell_m_;
    uint32_t cells_;
    uint32_t levels_ = 1;
};

/// One even grid that goes with the eye in steps of its own cell, three quarters of it ahead; it turns with
/// the eye by right angles alone, so that no vertex ever leaves the lattice.
class Grid : public MeshMethod {
public:
    explicit Grid(const TerrainMeshing& meshing);

    [[nodiscard]] MeshTopology topology() const override;
    [[nodiscard]] std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                          const glm::dvec2& anchor_m) const override;

private:
    double cell_m_;
    uint32_t cells_;
};

/// A mesh that is there already: its vertices are raised by the heights where they stand.
class Raised : public MeshMethod {
public:
    explicit Raised(ObjectTriangles object);

    [[nodiscard]] MeshTopology topology() const override;
    [[nodiscard]] std::vector<shared::TerrainLevel> place(const EyePlace& eye,
                                                          const glm::dvec2& anchor_m) const override;

private:
    ObjectTriangles object_;
    float spacing_m_; ///< about how far vertices are apart
};

/// The finest cell as it is: a power of two, so that places of vertices are exact numbers.
[[nodiscard]] double cell_of(const TerrainMeshing& meshing);

/// Cells along a side as they are: a multiple of four, at least `least`.
[[nodiscard]] uint32_t cells_of(const TerrainMeshing& meshing, uint32_t least);

} // namespace estampe::terrain
