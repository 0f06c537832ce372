// SPDX-License-Identifier: MIT
#pragma once

// How a person would take a scene: from which side, what of it, whether one is inside of it, where to stand
// then and where its lamp hangs, and whether a sun can light it at all. All of it follows from a cloud of
// points on the surfaces at rest, so it is the same at every moment and cheap.

#include <array>
#include <optional>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// Where the sun of the house stands: low, and to the left of an eye that stands at 35 degrees.
inline constexpr float house_sun_azimuth_deg = -34.0F;
inline constexpr float house_sun_elevation_deg = 45.0F;

/// A place where the sun hardly reaches: a room, a hall, a cave.
struct Shelter {
    glm::dvec3 lamp{0.0};                    ///< below the middle of the ceiling, or below what glows there
    std::optional<glm::dvec3> towards_light; ///< where daylight comes in; none when it is closed
    std::vector<SurfacePoint> seen;          ///< what the view shows, normals towards the eye
    glm::dvec3 origin{0.0};                  ///< of `seen`, in the world
};

enum class Standpoint : uint8_t {
    outside, ///< three quarters, from slightly above
    opening, ///< level, through the open or nearest side of a room
    inside   ///< in a corner of a closed room
};

/// Where a sun is, in degrees.
struct SunPlace {
    double azimuth_deg = 0.0; ///< 0 is +z, 90 +x
    double elevation_deg = 0.0;
};

/// The sun over ground that nothing stands on. That of the house would leave dunes without shade, which are
/// no steeper than 34 degrees where the wind comes down and next to level where it comes from: in its place
/// stands a low one upwind. Any other is as it was asked for. `wind_deg` is where the wind goes, from +x
/// towards +z.
[[nodiscard]] SunPlace sun_over_ground(const SunPlace& asked, double wind_deg);

struct ViewAnalysis {
    Standpoint standpoint = Standpoint::outside;
    double azimuth_rad = 0.61; ///< of the eye, seen from the scene: 0 is +z, a quarter turn +x
    double elevation_rad = 0.31;
    double sun_side = 1.0;      ///< -1: the house's sun stands at the eye's other hand
    double sun_swing_rad = 0.0; ///< how far it moves towards the eye's back
    bool cut_wall = false;      ///< the side to look in through must be cut away
    Bounds subject;             ///< what to show: a wide floor counts only where something stands on it
    glm::dvec3 corner{0.0};     ///< the eye, inside
    std::optional<Shelter> shelter;
    std::optional<double> wind_deg; ///< over ground that nothing stands on

    /// Unit vector to a sun whose bearing is given for an eye at the house's 35 degrees, turned with the eye
    /// and moved to where it models what is seen.
    [[nodiscard]] glm::dvec3 towards_sun(double azimuth_deg, double elevation_deg) const;
};

/// Cost: two visits of all vertices and triangles, and about ten of 32,768 points.
[[nodiscard]] ViewAnalysis analyze_view(const Scene& scene);
[[nodiscard]] ViewAnalysis analyze_view(const SurfaceCloud& cloud);

/// The shelter around an eye, when nearly every direction above it is closed.
[[nodiscard]] std::optional<Shelter> shelter_around(const SurfaceCloud& cloud, const glm::dvec3& eye);

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

/// What the outermost surfaces show to the middle of the scene, along -x, +x, -y, +y, -z, +z.
struct Walls {
    std::array<bool, 6> inward{};    ///< a wall of a room: at the side of the box, it faces the middle alone
    std::array<bool, 6> closed{};    ///< something stands there, whichever way it faces
    std::array<bool, 6> two_sided{}; ///< what stands there is seen from both sides

    /// At least four of the six sides face inwards, as a room's do and a model's skin does not.
    [[nodiscard]] bool room() const;

    /// Whether one of the four upright sides is open, as a stage's or a doll's house's is.
    [[nodiscard]] bool has_opening() const;

    /// The side of the four upright ones to look in through: an open one, +z first, else +z.
    [[nodiscard]] size_t opening() const;
};

/// Cost: linear in points.
[[nodiscard]] Walls find_walls(const SurfaceCloud& cloud);

} // namespace estampe
