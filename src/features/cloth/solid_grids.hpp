// SPDX-License-Identifier: MIT
#pragma once

// What cloth runs into by numbers on grids: the ground about it, and meshes of any form.

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>

#include "techniques/cloth/solids/colliders.hpp"

namespace estampe::features {

/// Where a sheet hangs, in anchor space.
struct SheetPlace {
    Bounds box;
    std::optional<Bounds> stays_in; ///< however it swings; it may come anywhere where there is none
};

class SolidGrids {
public:
    SolidGrids() = default;

    /// Distances to each mesh that is a collider of its own form, 40 cells long. Cost: see
    /// cloth::grid_of_distances().
    explicit SolidGrids(const Scene& scene);

    /// Heights of the scene's ground under the sheets that may come down to it, at half seconds; returns
    /// whether they are others than before. Of ground that is steeper than sand lies, what is narrower than a
    /// quarter of a sheet may not be seen to come near. Cost: where ground or sheets are others than before
    /// 25 samples of the ground for each that stays somewhere, and up to 9,409 below those that do; else
    /// none.
    bool follow_ground(const Scene& scene, std::span<const SheetPlace> sheets, const glm::dvec3& anchor,
                       double time_s);

    [[nodiscard]] const std::vector<cloth::SolidGrid>& grids() const { return grids_; }

    /// The ground in anchor space, where one was followed that some sheet may come down to.
    [[nodiscard]] std::optional<cloth::Solid> ground() const;

    /// A mesh in its place; nothing for one without triangles.
    [[nodiscard]] std::optional<cloth::Solid> placed_mesh(Index mesh, const glm::dmat4& place) const;

private:
    struct GroundKey {
        glm::dvec4 box_m{0.0};
        glm::dvec3 anchor{0.0};
        double time_s = 0.0;
        const terrain::Program* program = nullptr;
        std::vector<double> lows_m; ///< of what sheets stay in, in quarters of a metre

        bool operator==(const GroundKey&) const = default;
    };

    std::vector<cloth::SolidGrid> grids_;                ///< the ground first, if any
    std::map<std::pair<Index, bool>, uint32_t> of_mesh_; ///< and whether it is mirrored
    std::optional<GroundKey> ground_;
    bool is_ground_near_ = false;
    std::optional<Terrain> terrain_; ///< that it is of
};

} // namespace estampe::features
