// SPDX-License-Identifier: MIT
#pragma once

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

} // namespace estampe::terrain
