// SPDX-License-Identifier: MIT
#pragma once

// What becomes of the temple when somebody has come to the middle of its last hall: fires sink to embers,
// from there outwards, daylight grows in the halls, and the gratings of the cells go down into the floor.
// Nothing is said.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

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

} // namespace temple
