// SPDX-License-Identifier: MIT
#pragma once

// A walk through the temple, the ending, and an automatic tour of the whole temple. The ending begins when
// the visitor reaches the middle of the last hall. During the ending, fires become embers, daylight in the
// halls brightens, and the gratings of the cells sink into the floor: first near the last hall, then farther
// away.

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
    static constexpr double lasts_s = 24.0; ///< Length of the ending; afterwards nothing changes any more

    /// Prepares the ending for a scene. `scene` was made by build_temple() with `seed`; it may be destroyed
    /// afterwards.
    Ending(const estampe::Scene& scene, uint64_t seed);

    /// Returns whether a visitor at this position starts the ending.
    [[nodiscard]] bool begins_at(const glm::dvec3& feet_m) const;

    /// Returns the brightness of the lights at a time after the start of the ending; negative times give the
    /// scene's own values.
    [[nodiscard]] std::vector<estampe::LightBrightness> lights(double after_s) const;

    /// Returns the transforms of flames and gratings at a time after the start of the ending, for
    /// Renderer::place().
    [[nodiscard]] std::vector<estampe::NodePlace> nodes(double after_s) const;

    /// Returns the node of the gratings, which block the way until the ending opens them.
    [[nodiscard]] estampe::Index gratings() const { return gratings_.node; }

    /// Returns whether the gratings no longer block the way, at a time after the start of the ending.
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

/// Returns the parts of the scene that block a walker.
[[nodiscard]] walk::Solids solids_of(const estampe::Scene& scene);

/// Returns a function for the sand's height at the time `time_s`, which may change between calls; both
/// arguments must outlive the returned function.
[[nodiscard]] walk::SandAt sand_of(const estampe::Terrain& desert, const double& time_s);

class Visit final : public worlds::Visit {
public:
    /// Starts a walk. `scene` was made by build_temple() with `seed`. The walk begins at the start of the
    /// avenue. Cost: 0.2 s.
    Visit(const estampe::Scene& scene, uint64_t seed);

    /// Lets the visitor walk for `seconds`; `time_s` is the scene's time.
    void go(const walk::Intent& intent, double seconds, double time_s) override;

    [[nodiscard]] walk::Walker& walker() override { return *walker_; }

    [[nodiscard]] const walk::Walker& walker() const { return *walker_; }

    [[nodiscard]] const walk::Solids& solids() const { return solids_; }

    /// Returns the seconds since the visitor reached the last hall; nothing if the visitor has not reached
    /// it.
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
    /// Plans an automatic tour. `visit` has just begun and must outlive this object. Cost: half a second.
    Tour(const Visit& visit, uint64_t seed);

    /// Returns how the walker must move now to follow the tour.
    [[nodiscard]] walk::Intent intent();

    /// Returns how often the tour has been completed.
    [[nodiscard]] size_t rounds() const { return rounds_; }

    /// Returns the number of rooms on the tour that are not cells.
    [[nodiscard]] size_t halls() const { return halls_; }

private:
    [[nodiscard]] glm::dvec2 target_m() const { return {way_.at(next_).x, way_.at(next_).z}; }

    /// Returns the reachable place nearest to a room's middle.
    [[nodiscard]] std::optional<glm::dvec2> find_open(const Room& room) const;

    const Visit& visit_;
    walk::Chart chart_;
    std::vector<glm::dvec3> way_;
    size_t next_ = 0;
    size_t rounds_ = 0;
    size_t halls_ = 0;
};

} // namespace temple
