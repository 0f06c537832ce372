// SPDX-License-Identifier: MIT
#pragma once

// Chooses view and light for a scene that does not specify them: the viewing direction, the subject, whether
// and where the eye is inside, where a lamp hangs, and whether a sun can light the scene at all. The choice
// depends only on a cloud of points on the surfaces in the rest pose. So it is fast and does not change over
// time.

#include <array>
#include <optional>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// Azimuth of the default sun: to the left of the eye, which is at 35 degrees. The sun is low.
inline constexpr float house_sun_azimuth_deg = -34.0F;
inline constexpr float house_sun_elevation_deg = 45.0F;

/// A place that hardly any sunlight reaches, such as a room, a hall or a cave.
struct Shelter {
    glm::dvec3 lamp{0.0};                    ///< below the middle of the ceiling, or below a light
    std::optional<glm::dvec3> towards_light; ///< direction to the incoming daylight; none in a closed room
    std::vector<SurfacePoint> seen;          ///< points visible in the view; normals face the eye
    glm::dvec3 origin{0.0};                  ///< world position to which `seen` is relative
};

enum class Standpoint : uint8_t {
    outside, ///< three-quarter view, from slightly above
    opening, ///< horizontal view, through the open or nearest side of a room
    inside   ///< view from a corner of a closed room
};

/// Position of a sun, in degrees.
struct SunPlace {
    double azimuth_deg = 0.0; ///< 0 is +z, 90 +x
    double elevation_deg = 0.0;
};

/// Position of the sun over bare ground, on which no object stands. The default sun would leave dunes without
/// shade, because their lee side is at most 34 degrees steep and their windward side nearly horizontal. So a
/// low sun from the windward side replaces the default sun. Any other sun in `asked` is returned unchanged.
/// `wind_towards_deg` is the direction towards which the wind blows: 0 is +z, 90 is +x.
[[nodiscard]] SunPlace sun_over_ground(const SunPlace& asked, double wind_towards_deg);

struct ViewAnalysis {
    Standpoint standpoint = Standpoint::outside;
    double azimuth_rad = 0.61; ///< direction from the scene to the eye: 0 is +z, a quarter turn +x
    double elevation_rad = 0.31;
    double sun_side = 1.0;      ///< -1 mirrors the default sun to the other side of the eye
    double sun_swing_rad = 0.0; ///< angle by which the sun moves towards the back of the eye
    bool cut_wall = false;      ///< the view looks in through a wall, which must be cut away
    Bounds subject;             ///< bounds to show; a wide floor counts only below the objects on it
    glm::dvec3 corner{0.0};     ///< position of the eye, if `standpoint` is inside
    std::optional<Shelter> shelter;
    std::optional<double> wind_towards_deg; ///< direction of the wind over bare ground without objects

    /// Unit vector towards a sun. `azimuth_deg` is valid for an eye at the default 35 degrees. If the eye is
    /// elsewhere, the sun rotates with it. `sun_side` and `sun_swing_rad` then adjust the azimuth.
    [[nodiscard]] glm::dvec3 towards_sun(double azimuth_deg, double elevation_deg) const;
};

/// Analyses a scene in its rest pose, or a point cloud, and chooses its view and light. Cost: two visits of
/// all vertices and triangles, and about ten visits of 32,768 points.
[[nodiscard]] ViewAnalysis analyze_view(const Scene& scene);
[[nodiscard]] ViewAnalysis analyze_view(const SurfaceCloud& cloud);

/// Describes the shelter (a place without sun) around an eye, if nearly every direction above the eye is
/// closed.
[[nodiscard]] std::optional<Shelter> shelter_around(const SurfaceCloud& cloud, const glm::dvec3& eye);

/// Describes the room that is seen through the side at `azimuth_rad`. Daylight enters through this side
/// unless the side is `walled`.
[[nodiscard]] Shelter room_behind(const SurfaceCloud& cloud, double azimuth_rad, bool walled);

/// Describes the shelter that a view from outside shows, if at most a tenth of the visible points are in the
/// sun.
[[nodiscard]] std::optional<Shelter> shade_below(const SurfaceCloud& cloud, const Bounds& subject,
                                                 const ViewAxes& axes, const glm::dvec3& towards_sun);

/// An eye position inside a hollow scene that hides most of its surface from outside.
struct CornerView {
    glm::dvec3 eye{0.0};
    double azimuth_rad = 0.0; ///< direction of the eye from the middle of the room
    double elevation_rad = 0.0;
    Bounds room; ///< bounds of what the eye sees
};

/// Whether a scene that is closed on all sides contains a space for a standing person: 1.6 to 25 m high, and
/// at least 1.6 m wide and deep. Cost: seven visits of all points.
[[nodiscard]] bool could_stand_inside(const SurfaceCloud& cloud);

/// Finds a view from a corner inside the scene. Returns nothing if views from outside show most of the
/// surface, if a person could not stand inside, if the inside is empty (no objects and no windows), or if no
/// corner has a free view. Cost: a dozen visits of all points; most scenes need only four.
[[nodiscard]] std::optional<CornerView> corner_view(const SurfaceCloud& cloud);

/// The outermost surfaces on each side of the scene, as seen from its middle, in the order -x, +x, -y, +y,
/// -z, +z.
struct Walls {
    std::array<bool, 6> inward{};    ///< the side has a wall of a room, which faces only the middle
    std::array<bool, 6> closed{};    ///< the side has a surface, whichever way it faces
    std::array<bool, 6> two_sided{}; ///< the surface on this side is visible from both sides

    /// Whether the scene is a room: at least four of its six sides face inwards. The surfaces of a model face
    /// outwards.
    [[nodiscard]] bool room() const;

    /// Whether one of the four vertical sides is open, as in a stage or a doll's house.
    [[nodiscard]] bool has_opening() const;

    /// The vertical side through which to look in: an open side, +z before the others; +z if no side is open.
    [[nodiscard]] size_t opening() const;
};

/// Classifies the six sides of the scene. Cost: linear in points.
[[nodiscard]] Walls find_walls(const SurfaceCloud& cloud);

} // namespace estampe
