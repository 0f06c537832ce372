// SPDX-License-Identifier: MIT
#pragma once

// Simulates a person who walks: gravity, steps, slopes, sand that is soft, and walls.

#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/trails.hpp>

#include "solids.hpp"

namespace walk {

/// Height and slope of loose ground below a place.
struct Sand {
    double height_m = 0.0;
    glm::dvec2 slope{0.0}; ///< Slope of the sand: d height / dx and d height / dz
};

/// Function that returns the sand at x and z.
using SandAt = std::function<Sand(const glm::dvec2& place_m)>;

/// The body of a person, as a capsule above legs that take steps.
struct Body {
    float radius_m = 0.3F;
    float height_m = 1.8F;
    float eye_m = 1.68F;
    float step_m = 0.42F; ///< Height of the highest step; lower obstacles do not block the body
    float walk_m_per_s = 1.7F;
    float run_m_per_s = 4.6F;
    float jump_m_per_s = 3.2F;
    float steepest_deg = 50.0F; ///< Steepest slope of stone on which the body can stand
    /// Steepest slope of sand on which the body can stand; on steeper sand the walker slides.
    float repose_deg = 31.0F;
};

/// The movement that a walker should make, as input of the simulation.
struct Intent {
    glm::dvec2 way{0.0}; ///< Direction along x and z of the world; its length is 1 at most
    bool runs = false;
    bool jumps = false;
};

/// The ground on which a person stands.
struct Footing {
    double height_m = 0.0;
    glm::dvec3 normal{0.0, 1.0, 0.0};
    bool is_sand = false;
};

/// The ground and the obstacles around a walker's body.
class Place {
public:
    /// Describes the surroundings of a walker. `solids` must outlive this object.
    Place(const Solids& solids, SandAt sand) : solids_(&solids), sand_(std::move(sand)) {}

    [[nodiscard]] const Solids& solids() const { return *solids_; }

    [[nodiscard]] Sand sand(const glm::dvec2& place_m) const { return sand_(place_m); }

    /// Finds the highest ground under a foot that is put down at `place_m`, from the height of a step above
    /// the place to `drop_m` below. If the place is below the sand's surface, the sand counts as ground.
    [[nodiscard]] std::optional<Footing> footing(const glm::dvec3& place_m, const Body& body,
                                                 double drop_m) const;

    /// Returns the nearest position to which a body must be pushed horizontally to leave solids; nothing if
    /// there is no room.
    [[nodiscard]] std::optional<glm::dvec3> pushed_out(const glm::dvec3& feet_m, const Body& body) const;

private:
    const Solids* solids_;
    SandAt sand_;
    mutable std::vector<Triangle> near_;
};

/// A walking person, simulated in fixed steps of a 120th of a second, so that the same input always gives the
/// same positions. Cost: about 1 ms per simulated second.
class Walker {
public:
    static constexpr double step_s = 1.0 / 120.0;

    Walker(Place place, const Body& body, const glm::dvec3& feet_m);

    /// Advances the walker by `seconds`. Time that is less than a whole step is kept for the next call.
    void advance(const Intent& intent, double seconds);
    /// Advances the walker by one step of the simulation.
    void step(const Intent& intent);

    /// Moves the walker to another place, at rest.
    void put(const glm::dvec3& feet_m);

    [[nodiscard]] const Body& body() const { return body_; }

    [[nodiscard]] const Place& place() const { return place_; }

    [[nodiscard]] const glm::dvec3& feet_m() const { return feet_m_; }

    [[nodiscard]] const glm::dvec3& velocity_m_per_s() const { return velocity_m_s_; }

    /// Returns the position of the walker's eye, interpolated between steps and smoothed on stairs.
    [[nodiscard]] glm::dvec3 eye_m() const;

    [[nodiscard]] bool is_on_ground() const { return is_on_ground_; }

    [[nodiscard]] bool is_on_sand() const { return is_on_ground_ && footing_.is_sand; }

    [[nodiscard]] bool is_sliding() const { return is_sliding_; }

    /// Returns the marks that the walker left in the sand since the last call of this function: footprints,
    /// and traces of sliding.
    [[nodiscard]] std::vector<estampe::TrailStamp> take_prints();

private:
    void steer(const Intent& intent);
    void slide();
    /// Moves the walker horizontally as far as there is room. Returns whether the whole way was free.
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
    double eye_height_m_ = 0.0; ///< Height of the eye in the world
    glm::dvec3 eye_before_m_{0.0};
    double left_s_ = 0.0;
    double gone_m_ = 0.0; ///< Distance that the walker has gone since the last print
    bool is_left_foot_ = false;
    std::vector<estampe::TrailStamp> prints_;
};

} // namespace walk
