// SPDX-License-Identifier: MIT
#pragma once

// Chooses how to view and light a scene that does not say so itself: the side, the subject, whether the eye
// is inside, where it stands there and where a lamp hangs, and whether a sun can light the scene at all.
// Everything follows from a cloud of points on the surfaces in the rest pose, so it does not change over time
// and is cheap.

#include <array>
#include <optional>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// The default sun: low, and to the left of an eye that stands at 35 degrees.
inline constexpr float house_sun_azimuth_deg = -34.0F;
inline constexpr float house_sun_elevation_deg = 45.0F;

/// A place that hardly any sun reaches: a room, a hall, a cave.
struct Shelter {
    glm::dvec3 lamp{0.0};                    ///< below the middle of the ceiling, or below what glows there
    std::optional<glm::dvec3> towards_light; ///< direction to where daylight comes in; none in a closed place
    std::vector<SurfacePoint> seen;          ///< points that the view shows, normals towards the eye
    glm::dvec3 origin{0.0};                  ///< origin of `seen`, in the world
};

enum class Standpoint : uint8_t {
    outside, ///< three-quarter view, from slightly above
    opening, ///< level, through the open or nearest side of a room
    inside   ///< from a corner of a closed room
};

/// Position of a sun, in degrees.
struct SunPlace {
    double azimuth_deg = 0.0; ///< 0 is +z, 90 +x
    double elevation_deg = 0.0;
};

/// The sun over ground that nothing stands on. The default sun would leave dunes without shade, because they
/// are at most 34 degrees steep on the lee side and nearly level on the windward side; it is replaced by a
/// low sun upwind. Any other sun in `asked` is returned as it is. `wind_towards_deg` is the direction towards
/// which the wind blows: 0 is +z, 90 is +x.
[[nodiscard]] SunPlace sun_over_ground(const SunPlace& asked, double wind_towards_deg);

struct ViewAnalysis {
    Standpoint standpoint = Standpoint::outside;
    double azimuth_rad = 0.61; ///< bearing of the eye from the scene: 0 is +z, a quarter turn +x
    double elevation_rad = 0.31;
    double sun_side = 1.0;      ///< -1 mirrors the default sun to the eye's other side
    double sun_swing_rad = 0.0; ///< how far the sun moves towards the eye's back
    bool cut_wall = false;      ///< the side to look in through is a wall that must be cut away
    Bounds subject;             ///< what to show; a wide floor counts only where something stands on it
    glm::dvec3 corner{0.0};     ///< position of the eye, if it is inside
    std::optional<Shelter> shelter;
    std::optional<double> wind_towards_deg; ///< direction of the wind over ground that nothing stands on

    /// Unit vector to a sun whose bearing is given for an eye at the default 35 degrees. The sun turns with
    /// the eye and moves to where it models what is seen.
    [[nodiscard]] glm::dvec3 towards_sun(double azimuth_deg, double elevation_deg) const;
};

/// Analyses a scene in its rest pose, or a point cloud. Cost: two visits of all vertices and triangles, and
/// about ten of 32,768 points.
[[nodiscard]] ViewAnalysis analyze_view(const Scene& scene);
[[nodiscard]] ViewAnalysis analyze_view(const SurfaceCloud& cloud);

/// The shelter around an eye, if nearly every direction above the eye is closed.
[[nodiscard]] std::optional<Shelter> shelter_around(const SurfaceCloud& cloud, const glm::dvec3& eye);

/// The room seen through the side at `azimuth_rad`; daylight comes in there unless the side is `walled`.
[[nodiscard]] Shelter room_behind(const SurfaceCloud& cloud, double azimuth_rad, bool walled);

/// The shelter that a view from outside shows, if hardly a tenth of the visible points lie in the sun.
[[nodiscard]] std::optional<Shelter> shade_below(const SurfaceCloud& cloud, const Bounds& subject,
                                                 const ViewAxes& axes, const glm::dvec3& towards_sun);

/// Where to stand inside a hollow scene that hides most of itself.
struct CornerView {
    glm::dvec3 eye{0.0};
    double azimuth_rad = 0.0; ///< bearing of the eye, seen from the middle of the room
    double elevation_rad = 0.0;
    Bounds room; ///< bounds of what the eye sees
};

/// Whether a scene that is closed all around contains a space where a person could stand: 1.6 to 25 m high,
/// and at least 1.6 m wide and deep. Cost: seven visits of all points.
[[nodiscard]] bool could_stand_inside(const SurfaceCloud& cloud);

/// The view from a corner inside the scene. None if views from all around show most of the surface, if nobody
/// could stand inside, if there is nothing to see inside (neither things nor windows, as in an empty box), or
/// if there is no free view. Cost: a dozen visits of all points; most scenes need only four.
[[nodiscard]] std::optional<CornerView> corner_view(const SurfaceCloud& cloud);

/// What the outermost surfaces on each side show to the middle of the scene, along -x, +x, -y, +y, -z, +z.
struct Walls {
    std::array<bool, 6> inward{};    ///< a wall of a room stands there, facing only the middle
    std::array<bool, 6> closed{};    ///< something stands on this side, whichever way it faces
    std::array<bool, 6> two_sided{}; ///< what stands on this side is visible from both sides

    /// Whether at least four of the six sides face inwards, as those of a room do and a model's skin does
    /// not.
    [[nodiscard]] bool room() const;

    /// Whether one of the four upright sides is open, as in a stage or a doll's house.
    [[nodiscard]] bool has_opening() const;

    /// The upright side to look in through: an open one, +z first; +z if none is open.
    [[nodiscard]] size_t opening() const;
};

/// Classifies the six sides of the scene. Cost: linear in points.
[[nodiscard]] Walls find_walls(const SurfaceCloud& cloud);

} // namespace estampe
