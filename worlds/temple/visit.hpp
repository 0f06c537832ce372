// SPDX-License-Identifier: MIT
#pragma once

// Somebody who walks through the temple: what comes of it when the middle of the last hall is reached (fires
// sink to embers, from there outwards, daylight grows in the halls, and the gratings of the cells go down
// into the floor; nothing is said), and a tour of all of it that nobody's hands are needed for.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "plan.hpp"
#include "walk/chart.hpp"
#include "walk/walker.hpp"
#include "world/world.hpp"

namespace temple {

class Ending {
public:
    static constexpr double lasts_s = 24.0; ///< then all is as it stays

    /// Of a scene that build_temple() made from that seed, which may be gone afterwards.
    Ending(const estampe::Scene& scene, uint64_t seed);

    /// Whether one who stands there brings it about.
    [[nodiscard]] bool begins_at(const glm::dvec3& feet_m) const;

    /// Lights as they are so long after; before it, of negative seconds, as the scene has them.
    [[nodiscard]] std::vector<estampe::LightBrightness> lights(double after_s) const;

    /// The same of flames and gratings, for Renderer::place().
    [[nodiscard]] std::vector<estampe::NodePlace> nodes(double after_s) const;

    /// The gratings that stand in the way until then.
    [[nodiscard]] estampe::Index gratings() const { return gratings_.node; }

    /// When nobody runs into them any more.
    [[nodiscard]] static bool are_open(double after_s);

private:
    struct Light {
        estampe::LightBrightness at_first;
        bool is_daylight = false;
        double begins_s = 0.0;
    };

    struct Flame {
        estampe::NodePlace at_first;
        double begins_s = 0.0;
    };

    glm::dvec2 middle_m_{0.0};
    std::vector<Light> lights_;
    std::vector<Flame> flames_;
    estampe::NodePlace gratings_;
};

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

class Tour {
public:
    /// Of a visit that has just begun, which is to outlive it. Cost: half a second.
    Tour(const Visit& visit, uint64_t seed);

    /// What the walker is to do now.
    [[nodiscard]] walk::Intent intent();

    /// How often it has come back to where it began.
    [[nodiscard]] size_t rounds() const { return rounds_; }

    /// Rooms on the way that are no cells.
    [[nodiscard]] size_t halls() const { return halls_; }

private:
    [[nodiscard]] glm::dvec2 target_m() const { return {way_.at(next_).x, way_.at(next_).z}; }

    /// The place nearest to a room's middle that can be gone to.
    [[nodiscard]] std::optional<glm::dvec2> find_open(const Room& room) const;

    const Visit& visit_;
    walk::Chart chart_;
    std::vector<glm::dvec3> way_;
    size_t next_ = 0;
    size_t rounds_ = 0;
    size_t halls_ = 0;
};

} // namespace temple
