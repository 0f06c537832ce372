// SPDX-License-Identifier: MIT
#pragma once

// Views from a named side or from a bearing, which hold the whole subject: plans, elevations, isometric
// views.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <estampe/scene.hpp>

namespace estampe {

/// A side to look from. glTF's models face +z, so `front` looks from +z; `right` looks from +x and `left`
/// from -x. In the views from the top and from the bottom +x points to the right of the page.
enum class NamedView : uint8_t { front, back, left, right, top, bottom, isometric, three_quarter };

/// The names of all views as they are typed: "front", "three-quarter" and so on, in the order of NamedView.
[[nodiscard]] std::span<const char* const> view_names();

/// The view of that name; nothing if there is no such view.
[[nodiscard]] std::optional<NamedView> named_view(std::string_view name);

/// From which direction a view is taken, and how. The defaults look at the front.
struct ViewDirection {
    double azimuth_deg = 0.0;         ///< bearing of the eye: 0 looks from +z and sees the front, 90 from +x
    double elevation_deg = 0.0;       ///< height of the eye above the horizon: 90 looks straight down, -90 up
    std::optional<double> distance_m; ///< from the eye to `target`; none: the subject fills the page
    std::optional<glm::dvec3> target; ///< what the eye looks at; none: the middle of the subject
    std::optional<double> fov_deg;    ///< vertical angle of view; none: a slight telephoto, about 29 degrees
    std::optional<double> half_height_m; ///< of a parallel projection; none: the subject fills the page
    bool parallel = false;               ///< parallel (orthographic) projection

    bool operator==(const ViewDirection&) const = default;
};

/// Where a named view looks from. `isometric` looks from 45 degrees and asin(tan 30 deg) above the horizon in
/// parallel projection, so that the three axes have the same length on the page.
[[nodiscard]] ViewDirection direction_of(NamedView view);

/// Reads "azimuth=degrees elevation=degrees [distance=metres] [target=x,y,z] [fov=degrees] [ortho]
/// [ortho=half_height]", in any order, separated by blanks; one of azimuth and elevation is enough. Throws
/// Error that names the wrong part and shows an example of the right form.
[[nodiscard]] ViewDirection parse_view_direction(const std::string& text);

/// The camera that looks from that direction and holds the whole subject in the middle of the page, with a
/// margin of 8 % of the shorter side; without regard to shadows. The subject is that of framing_camera(): all
/// of the scene but wide floors and far strays. `aspect` is width / height. Throws Error when the scene is so
/// large, small or far away that it cannot be drawn. Cost: as framing_camera().
[[nodiscard]] Camera view_camera(const Scene& scene, const ScenePose& pose, double aspect,
                                 const ViewDirection& from);

/// Returns `camera` with parallel projection. Things at the depth of `focus` keep their size on the page; at
/// the depth of the camera's target, if `focus` lies behind the eye.
[[nodiscard]] Camera with_parallel_projection(const Camera& camera, const glm::dvec3& focus);

} // namespace estampe
