// SPDX-License-Identifier: MIT
#pragma once

// Views that show the whole subject from a named side or direction: plans, elevations, isometric views.

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

/// Returns the names of all views as users type them: "front", "three-quarter" and so on, in the order of
/// NamedView.
[[nodiscard]] std::span<const char* const> view_names();

/// Returns the view with this name; empty if there is no such view.
[[nodiscard]] std::optional<NamedView> named_view(std::string_view name);

/// Direction, distance and projection of a view. The defaults show the front.
struct ViewDirection {
    /// Direction of the camera as seen from the subject: at 0 the camera looks from +z and shows the front,
    /// at 90 from +x.
    double azimuth_deg = 0.0;
    /// Height of the camera above the horizon: 90 looks straight down, -90 straight up.
    double elevation_deg = 0.0;
    /// Distance from the camera to `target`; empty: the subject fills the page.
    std::optional<double> distance_m;
    std::optional<glm::dvec3> target; ///< Point that the camera looks at; empty: the middle of the subject
    /// Vertical angle of view; empty: about 29 degrees, a slight telephoto lens.
    std::optional<double> fov_deg;
    /// Half the height of a parallel projection; empty: the subject fills the page.
    std::optional<double> half_height_m;
    bool parallel = false; ///< The view has parallel (orthographic) projection

    bool operator==(const ViewDirection&) const = default;
};

/// Returns the direction of a named view. `isometric` looks from 45 degrees and asin(tan 30 deg) above the
/// horizon in parallel projection, so that the three axes have the same length on the page.
[[nodiscard]] ViewDirection direction_of(NamedView view);

/// Parses a view direction from a text of the form "azimuth=degrees elevation=degrees [distance=metres]
/// [target=x,y,z] [fov=degrees] [ortho] [ortho=half_height]", in any order, separated by blanks. Either
/// azimuth or elevation is required. If the text is not valid, throws an Error that names the wrong part and
/// shows a valid example.
[[nodiscard]] ViewDirection parse_view_direction(const std::string& text);

/// Returns a camera that looks from a direction. The camera centres the whole subject on the page, with a
/// margin of 8 % of the shorter side, and leaves no room for shadows. The subject is that of
/// framing_camera(): the whole scene without wide floors and distant outliers. `aspect` is width / height.
/// Throws Error if the scene is too large, small or far away to be drawn. Cost: the same as framing_camera().
[[nodiscard]] Camera view_camera(const Scene& scene, const ScenePose& pose, double aspect,
                                 const ViewDirection& from);

/// Returns a copy of `camera` with parallel projection. Objects as far away as the point `focus` keep their
/// size on the page. If `focus` is behind the camera, objects as far away as the camera's target keep their
/// size.
[[nodiscard]] Camera with_parallel_projection(const Camera& camera, const glm::dvec3& focus);

} // namespace estampe
