// SPDX-License-Identifier: MIT
#pragma once

// Camera and page for tests of the sky.

#include <cmath>
#include <numbers>
#include <optional>

#include "features/common/view.hpp"

namespace estampe::sky {

struct View {
    Camera camera;
    glm::uvec2 size_px{120, 90};
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    float pixels_per_mm = 3.0F;
    bool drawn = true;
    std::optional<float> daylight_rad = {};
    std::optional<float> far_m = {}; ///< with it a wall at 50 m hides the left half, and one at 200 m a third

    /// Reversed depth at a pixel.
    [[nodiscard]] float depth_at(glm::uvec2 pixel) const
    {
        const float away_m = 2 * pixel.x < size_px.x ? 50.0F : 6 * pixel.x < 5 * size_px.x ? 200.0F : 1e30F;
        const auto forward = glm::normalize(camera.target - camera.eye);
        const auto straight = glm::dot(direction(glm::dvec2(pixel) + 0.5), forward);
        return far_m ? static_cast<float>(camera.near_m / (static_cast<double>(away_m) * straight)) : 0.0F;
    }

    /// Whether the surface at a pixel is nearer than `far_m`.
    [[nodiscard]] bool is_covered(size_t i) const { return far_m && 2 * (i % size_px.x) < size_px.x; }

    [[nodiscard]] shared::FrameGlobals globals() const
    {
        return features::frame_globals(camera, {}, camera.eye, {.size_px = size_px});
    }

    /// View direction of a place of the page.
    [[nodiscard]] glm::dvec3 direction(glm::dvec2 position_px) const
    {
        const glm::dvec2 ndc = 2.0 * position_px / glm::dvec2(size_px) - 1.0;
        const glm::dvec4 p = glm::inverse(glm::dmat4(globals().clip_from_anchor)) * glm::dvec4(ndc, 0.5, 1.0);
        return glm::normalize(glm::dvec3(p) / p.w);
    }
};

inline glm::dvec2 centre_of(size_t i, glm::uvec2 size_px)
{
    const size_t row = i / size_px.x;
    return {static_cast<double>(i % size_px.x) + 0.5, static_cast<double>(row) + 0.5};
}

inline Camera looking(double elevation_deg, double bearing_deg, double fov_rad)
{
    const double up = elevation_deg * std::numbers::pi / 180.0;
    const double around = bearing_deg * std::numbers::pi / 180.0;
    return {.eye = {3.0, 2.0, 1.0},
            .target = glm::dvec3(3.0, 2.0, 1.0) + glm::dvec3(std::cos(up) * std::sin(around), std::sin(up),
                                                             -std::cos(up) * std::cos(around)),
            .vertical_fov_rad = fov_rad};
}

} // namespace estampe::sky
