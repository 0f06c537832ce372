// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::terrain {

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

} // namespace estampe::terrain
