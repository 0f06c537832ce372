// SPDX-License-Identifier: MIT
#pragma once

// Somebody on foot: gravity, steps, slopes, sand that gives way, and walls.

#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/trails.hpp>

#include "solids.hpp"

namespace walk {

/// Loose ground under a place.
struct Sand {
    double height_m = 0.0;
    glm::dvec2 slope{0.0}; ///< d height / dx, d height / dz
};

/// The ground at x and z.
using SandAt = std::function<Sand(const glm::dvec2& place_m)>;

/// A person, as a capsule over legs that take steps.
struct Body {
    float radius_m = 0.3F;
    float height_m = 1.8F;
    float eye_m = 1.68F;
    float step_m = 0.42F; ///< as high as a foot is put; below it nothing is in the way
    float walk_m_s = 1.7F;
    float run_m_s = 4.6F;
    float jump_m_s = 3.2F;
    float steepest_deg = 50.0F; ///< of stone that is stood on
    float repose_deg = 31.0F;   ///< of sand that is stood on: beyond that it slides
};

/// What the walker wants.
struct Intent {
    glm::dvec2 way{0.0}; ///< x and z of the world, at most of length 1
    bool runs = false;
    bool jumps = false;
};

/// Where somebody stands.
struct Footing {
    double height_m = 0.0;
    glm::dvec3 normal{0.0, 1.0, 0.0};
    bool is_sand = false;
};

/// The ground that a body is over, and what stands on it.
class Place {
public:
    /// `solids` is to outlive it.
    Place(const Solids& solids, SandAt sand) : solids_(&solids), sand_(std::move(sand)) {}

    [[nodiscard]] const Solids& solids() const { return *solids_; }

    [[nodiscard]] Sand sand(const glm::dvec2& place_m) const { return sand_(place_m); }

    /// The highest ground under a foot that is put down at `place_m` from a step above it, at most `drop_m`
    /// below; sand is nowhere fallen through.
    [[nodiscard]] std::optional<Footing> footing(const glm::dvec3& place_m, const Body& body,
                                                 double drop_m) const;

    /// The place to which a body is pushed level out of what it stands in; nothing where there is no room.
    [[nodiscard]] std::optional<glm::dvec3> pushed_out(const glm::dvec3& feet_m, const Body& body) const;

private:
    const Solids* solids_;
    SandAt sand_;
    mutable std::vector<Triangle> near_;
};

/// Goes in steps of a 120th of a second, always the same ones: the same intents lead to the same places.
/// Cost of a second's steps: about 1 ms.
class Walker {
public:
    static constexpr double step_s = 1.0 / 120.0;

    Walker(Place place, const Body& body, const glm::dvec3& feet_m);

    /// Goes on for so long of a clock; what is left of a step is kept for the next call.
    void advance(const Intent& intent, double seconds);
    /// One step.
    void step(const Intent& intent);

    /// To another place, at rest.
    void put(const glm::dvec3& feet_m);

    [[nodiscard]] const Body& body() const { return body_; }

    [[nodiscard]] const Place& place() const { return place_; }

    [[nodiscard]] const glm::dvec3& feet_m() const { return feet_m_; }

    [[nodiscard]] const glm::dvec3& velocity_m_s() const { return velocity_m_s_; }

    /// Where it looks from; stairs do not shake it. Between steps, where the clock is.
    [[nodiscard]] glm::dvec3 eye_m() const;

    [[nodiscard]] bool is_on_ground() const { return is_on_ground_; }

    [[nodiscard]] bool is_on_sand() const { return is_on_ground_ && footing_.is_sand; }

    [[nodiscard]] bool is_sliding() const { return is_sliding_; }

    /// What it has left in the sand since the last call: steps, and where it slid.
    [[nodiscard]] std::vector<estampe::TrailStamp> take_prints();

private:
    void steer(const Intent& intent);
    void slide();
    /// Goes level, as far as there is room. Returns whether all of it was.
    bool go(const glm::dvec2& way_m);
    void rise_or_fall();
    void leave_prints(const glm::dvec3& from_m);
    void carry_eye();

    Place place_;
    Body body_;
    glm::dvec3 feet_m_;
    glm::dvec3 velocity_m_s_{0.0};
    Footing footing_;
    bool is_on_ground_ = false;
    bool is_sliding_ = false;
    double eye_height_m_ = 0.0; ///< of the world
    glm::dvec3 eye_before_m_{0.0};
    double left_s_ = 0.0;
    double gone_m_ = 0.0; ///< since the last print
    bool is_left_foot_ = false;
    std::vector<estampe::TrailStamp> prints_;
};

} // namespace walk
