// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::terrain {

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

} // namespace estampe::terrain
