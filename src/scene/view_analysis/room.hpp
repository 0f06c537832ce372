// SPDX-License-Identifier: MIT
#pragma once

// Rooms: whether one is inside of a scene, where to stand in it, and where its lamp hangs.

#include <optional>

#include "scene/view_analysis/view_analysis.hpp"
#include "scene/view_analysis/view_axes.hpp"

namespace estampe {

/// The room seen through the side at `azimuth_rad`; daylight comes in unless that side is `walled`.
[[nodiscard]] Shelter room_behind(const SurfaceCloud& cloud, double azimuth_rad, bool walled);

/// The shelter that a view from outside shows, when hardly a tenth of what is seen lies in the sun.
[[nodiscard]] std::optional<Shelter> shade_below(const SurfaceCloud& cloud, const Bounds& subject,
                                                 const ViewAxes& axes, const glm::dvec3& towards_sun);

/// Where to stand in a scene that hides most of itself and is hollow.
struct CornerView {
    glm::dvec3 eye{0.0};
    double azimuth_rad = 0.0; ///< of the eye, seen from the middle of the room
    double elevation_rad = 0.0;
    Bounds room; ///< what the eye sees
};

/// Whether a scene that is closed all around holds a space where a person could stand: 1.6 to 25 m high, and
/// at least 1.6 m wide and deep. Cost: seven visits of all points.
[[nodiscard]] bool could_stand_inside(const SurfaceCloud& cloud);

/// None when views from all around show most of the surface, when nobody could stand inside, when there is
/// nothing to see inside, neither things nor windows, as in an empty box, or when there is no free view.
/// Cost: a dozen visits of all points, of which most scenes need four.
[[nodiscard]] std::optional<CornerView> corner_view(const SurfaceCloud& cloud);

} // namespace estampe
