// SPDX-License-Identifier: MIT
#pragma once

// What cloth runs into by numbers on grids: the ground about it, and meshes of any form.

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>

#include "techniques/cloth/colliders.hpp"

namespace estampe::frame {

class SolidGrids {
public:
    SolidGrids() = default;

    /// Distances to each mesh that is a collider of its own form, 40 cells long. Cost: see
    /// cloth::grid_of_distances().
    explicit SolidGrids(const Scene& scene);

    /// Heights of the scene's ground under a box in anchor space, at half seconds; returns whether they are
    /// others than before. Cost: up to 9,409 samples of the ground when they are, else none.
    bool follow_ground(const Scene& scene, const Bounds& box, const glm::dvec3& anchor, double time_s);

    [[nodiscard]] const std::vector<cloth::SolidGrid>& grids() const { return grids_; }

    /// The ground in anchor space, once it has been followed.
    [[nodiscard]] std::optional<cloth::Solid> ground() const;

    /// A mesh in its place; nothing for one without triangles.
    [[nodiscard]] std::optional<cloth::Solid> placed_mesh(Index mesh, const glm::dmat4& place) const;

private:
    struct GroundKey {
        glm::dvec4 box_m{0.0};
        glm::dvec3 anchor{0.0};
        double time_s = 0.0;
        const terrain::Program* program = nullptr;

        bool operator==(const GroundKey&) const = default;
    };

    std::vector<cloth::SolidGrid> grids_;                ///< the ground first, if any
    std::map<std::pair<Index, bool>, uint32_t> of_mesh_; ///< and whether it is mirrored
    std::optional<GroundKey> ground_;
    std::optional<Terrain> terrain_; ///< that it is of
};

} // namespace estampe::frame
