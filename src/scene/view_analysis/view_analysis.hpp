// SPDX-License-Identifier: MIT
#pragma once

// Chooses view and light for a scene that does not specify them: the viewing direction, the subject, an eye
// position inside a room, the position of a lamp, and whether a sun can light the scene. The choice depends
// only on a cloud of points on the surfaces in the rest pose. Therefore it is fast and does not change over
// time.

#include <array>
#include <optional>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// Azimuth of the default sun, which is to the left of the eye and low. The value is valid for an eye at an
/// azimuth of 35 degrees.
inline constexpr float house_sun_azimuth_deg = -34.0F;
inline constexpr float house_sun_elevation_deg = 45.0F;

/// A place that hardly any sunlight reaches, such as a room, a hall or a cave.
struct Shelter {
    glm::dvec3 lamp{0.0}; ///< position of the lamp: below the middle of the ceiling, or below a light
    std::optional<glm::dvec3> towards_light; ///< direction to the incoming daylight; none in a closed room
    std::vector<SurfacePoint> seen; ///< points that are visible in the view; their normals face the eye
    glm::dvec3 origin{0.0};         ///< world position to which `seen` is relative
};

enum class Standpoint : uint8_t {
    outside, ///< three-quarter view, from slightly above
    opening, ///< horizontal view, through the open or nearest side of a room
    inside   ///< view from a corner of a closed room
};

/// Position of a sun, in degrees.
struct SunPlace {
    double azimuth_deg = 0.0; ///< direction of the sun: 0 is +z, 90 is +x
    double elevation_deg = 0.0;
};

/// Returns the position of the sun over bare ground without objects. With the default sun, dunes would have
/// no shade, because their lee side is at most 34 degrees steep and their windward side is nearly horizontal.
/// Therefore a low sun from the windward side replaces the default sun. Any other sun in `asked` is returned
/// unchanged. `wind_towards_deg` is the direction towards which the wind blows: 0 is +z, 90 is +x.
[[nodiscard]] SunPlace sun_over_ground(const SunPlace& asked, double wind_towards_deg);

struct ViewAnalysis {
    Standpoint standpoint = Standpoint::outside;
    double azimuth_rad = 0.61; ///< direction from the scene to the eye: 0 is +z, a quarter turn +x
    double elevation_rad = 0.31;
    double sun_side = 1.0; ///< -1 mirrors the default sun to the other side of the eye
    /// Angle by which the sun is turned away from its default position, towards the back of the eye.
    double sun_swing_rad = 0.0;
    bool cut_wall = false;  ///< the view looks in through a wall, which must be cut away
    Bounds subject;         ///< bounds to show; a wide floor counts only below the objects on it
    glm::dvec3 corner{0.0}; ///< position of the eye, if `standpoint` is inside
    std::optional<Shelter> shelter;
    std::optional<double> wind_towards_deg; ///< direction of the wind over bare ground without objects

    /// Returns the unit vector towards a sun. `azimuth_deg` is valid for an eye at the default azimuth of 35
    /// degrees. If the eye is elsewhere, the sun rotates with it. `sun_side` and `sun_swing_rad` then adjust
    /// the azimuth.
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
    Bounds room; ///< bounds of the part of the room that the eye sees
};

/// Returns whether a scene that is closed on all sides contains a space for a standing person: 1.6 to 25 m
/// high, and at least 1.6 m wide and deep. Cost: seven visits of all points.
[[nodiscard]] bool could_stand_inside(const SurfaceCloud& cloud);

/// Finds a view from a corner inside the scene. Returns nothing if views from outside show most of the
/// surface, if a person could not stand inside, if the inside is empty (no objects and no windows), or if no
/// corner has a free view. Cost: a dozen visits of all points; most scenes need only four.
[[nodiscard]] std::optional<CornerView> corner_view(const SurfaceCloud& cloud);

/// The outermost surfaces on each side of the scene, as seen from its middle. The order is as
/// follows: -x, +x, -y, +y, -z, +z.
struct Walls {
    std::array<bool, 6> inward{};    ///< the side has a wall of a room, which faces only the middle
    std::array<bool, 6> closed{};    ///< the side has a surface, which may face in any direction
    std::array<bool, 6> two_sided{}; ///< the surface on this side is visible from both sides

    /// Returns whether the scene is a room: surfaces on at least four of its six sides face inwards. The
    /// surfaces of a model face outwards.
    [[nodiscard]] bool room() const;

    /// Returns whether one of the four vertical sides is open, as in a stage or a doll's house.
    [[nodiscard]] bool has_opening() const;

    /// Returns the vertical side through which the eye looks in: an open side, preferably +z; +z if no side
    /// is open.
    [[nodiscard]] size_t opening() const;
};

/// Classifies the six sides of the scene. Cost: linear in points.
[[nodiscard]] Walls find_walls(const SurfaceCloud& cloud);

} // namespace estampe
