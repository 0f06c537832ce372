// SPDX-License-Identifier: MIT
#pragma once

// The temple's cameras: twelve viewpoints, and a camera path of one minute. The path leads from the dunes
// down the avenue, through gate, court, arcade and portal, to the last hall.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>
#include <estampe/terrain.hpp>

#include "plan.hpp"
#include "site.hpp"
#include "walk/chart.hpp"
#include "world/world.hpp"

namespace temple {

struct Viewpoint {
    std::string name;
    glm::vec3 eye_m{0.0F};
    glm::vec3 target_m{0.0F};
    float vertical_fov_deg = 45.0F;
};

/// Returns viewpoints, ordered from outside the temple to the last hall. Each camera's eye is at standing
/// height above the ground or floor.
[[nodiscard]] std::vector<Viewpoint> find_viewpoints(const Plan& plan, const Site& site,
                                                     const estampe::Terrain& desert);

class Flight final : public worlds::CameraPath {
public:
    static constexpr double length_s = 60.0;

    /// Finds the film's camera path through the scene that build_temple() made with `seed`. Cost: about a
    /// second.
    Flight(const estampe::Scene& scene, uint64_t seed);

    /// Returns the film's camera at a time of its minute. Before the minute, returns the camera at the start
    /// of the path; after the minute, the camera at the end.
    [[nodiscard]] estampe::Camera camera(double time_s) const override;

    /// Returns the time at which the film's camera stops in the last hall.
    [[nodiscard]] double arrives_s() const { return arrives_s_; }

    /// Returns the time at which the camera reaches the last hall, where the ending of the world begins.
    [[nodiscard]] std::optional<double> end_s() const override { return arrives_s_; }

private:
    struct Key {
        glm::dvec3 eye_m{0.0};
        glm::dvec3 target_m{0.0};
        double fov_rad = 0.9;
    };

    std::vector<Key> keys_; ///< Keys of the camera's path, at equal intervals of time
    double arrives_s_ = 0.0;
};

} // namespace temple
