// SPDX-License-Identifier: MIT
#pragma once

// Somebody who walks through the temple, and what comes of it.

#include <cstdint>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "ending.hpp"
#include "walk/chart.hpp"
#include "walk/walker.hpp"
#include "world/world.hpp"

namespace temple {

/// What of the scene cannot be walked through.
[[nodiscard]] walk::Solids solids_of(const estampe::Scene& scene);

/// The sand at a moment that may go on; both are to outlive it.
[[nodiscard]] walk::SandAt sand_of(const estampe::Terrain& desert, const double& time_s);

class Visit final : public worlds::Visit {
public:
    /// Of a scene that build_temple() made from that seed; begins where the avenue does. Cost: 0.2 s.
    Visit(const estampe::Scene& scene, uint64_t seed);

    /// For so long, at a moment of the scene.
    void go(const walk::Intent& intent, double seconds, double time_s) override;

    [[nodiscard]] walk::Walker& walker() override { return *walker_; }

    [[nodiscard]] const walk::Walker& walker() const { return *walker_; }

    [[nodiscard]] const walk::Solids& solids() const { return solids_; }

    /// How long ago the last hall was reached; nothing before.
    [[nodiscard]] std::optional<double> since_arrival_s() const { return since_arrival_s_; }

    [[nodiscard]] bool has_arrived() const override { return since_arrival_s_.has_value(); }

    [[nodiscard]] const Ending& ending() const { return ending_; }

private:
    estampe::Terrain desert_;
    double time_s_ = 0.0;
    walk::Solids solids_;
    Ending ending_;
    std::optional<walk::Walker> walker_;
    std::optional<double> since_arrival_s_;
};

} // namespace temple
