// SPDX-License-Identifier: MIT
#pragma once

// Twelve places to look from, and a minute's way of a camera: from the dunes down the avenue, through gate,
// court, arcade and portal, to the last hall.

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

/// From outside to the last hall; eyes stand on what is there.
[[nodiscard]] std::vector<Viewpoint> find_viewpoints(const Plan& plan, const Site& site,
                                                     const estampe::Terrain& desert);

class Flight final : public worlds::CameraPath {
public:
    static constexpr double length_s = 60.0;

    /// Through a scene that build_temple() made from that seed. Cost: about a second.
    Flight(const estampe::Scene& scene, uint64_t seed);

    /// Where it is seen from at a moment of the minute; before and after it as at its ends.
    [[nodiscard]] estampe::Camera camera(double time_s) const override;

    /// When it comes to a stand, in the last hall.
    [[nodiscard]] double arrives_s() const { return arrives_s_; }

    /// Who has flown to the last hall has reached it.
    [[nodiscard]] std::optional<double> end_s() const override { return arrives_s_; }

private:
    struct Key {
        glm::dvec3 eye_m{0.0};
        glm::dvec3 target_m{0.0};
        double fov_rad = 0.9;
    };

    std::vector<Key> keys_; ///< at even times
    double arrives_s_ = 0.0;
};

} // namespace temple
