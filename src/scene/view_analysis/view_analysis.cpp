// SPDX-License-Identifier: MIT
#include "scene/view_analysis/view_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <estampe/default_light.hpp>

#include "scene/view_analysis/subject.hpp"
#include "scene/view_analysis/surface_points.hpp"
#include "scene/visibility.hpp"

namespace estampe {
namespace {

// Azimuth of the default eye: 35 degrees from the front towards the right.
constexpr double house_azimuth_rad = 0.61;
constexpr double house_elevation_rad = 0.31; // elevation of the default eye: 18 degrees

/// A three-quarter view that can be chosen; the default view comes first. The scores of all views except the
/// default view are reduced. Another view is then chosen only if it shows more. Views from behind must show
/// much more, because glTF models face +z.
struct Candidate {
    double azimuth_rad;
    double handicap;
};

constexpr std::array<Candidate, 4> candidates{{{house_azimuth_rad, 1.0},
                                               {-house_azimuth_rad, 0.93},
                                               {std::numbers::pi - house_azimuth_rad, 0.8},
                                               {std::numbers::pi + house_azimuth_rad, 0.8}}};

/// Returns how far the upper third of a scene is in front of the whole scene, towards +z, relative to the
/// scene's radius. The value is large for an animal, because its head is high and in front. The value is zero
/// if the upper third is off to the side, or thin like the back of a chair.
double head_lead(const SurfaceCloud& cloud, const Bounds& subject)
{
    const double neck = glm::mix(subject.min.y, subject.max.y, 2.0 / 3.0) - cloud.origin.y;
    glm::dvec3 whole{0.0};
    glm::dvec3 head{0.0};
    glm::dmat2 spread{0.0};
    double head_count = 0.0;
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 p(point.position);
        whole += p;
        if (p.y < neck)
            continue;
        head += p;
        head_count += 1.0;
        const glm::dvec2 level(p.x, p.z);
        spread += glm::outerProduct(level, level);
    }
    if (head_count < 32.0)
        return 0.0;
    whole /= static_cast<double>(cloud.points.size());
    head /= head_count;
    const glm::dvec2 middle(head.x, head.z);
    spread = spread / head_count - glm::outerProduct(middle, middle);
    const glm::dvec2 lean = middle - glm::dvec2(whole.x, whole.z);
    constexpr double thin = 0.4;
    constexpr double aslant = 0.3;
    if (std::abs(lean.x) > aslant * std::abs(lean.y) || spread[1][1] < thin * thin * spread[0][0])
        return 0.0;
    return lean.y / subject.radius();
}

double best_azimuth(const SurfaceCloud& cloud, const Bounds& subject)
{
    constexpr double head_weight = 0.6;
    const double lead = head_lead(cloud, subject);
    double best = 0.0;
    double azimuth_rad = house_azimuth_rad;
    for (const Candidate& candidate : candidates) {
        const ViewAxes axes = look_from(candidate.azimuth_rad, house_elevation_rad);
        const double score = candidate.handicap * interest(cloud, see_from_afar(cloud, axes, subject)) *
                             (1.0 - head_weight * lead * axes.forward.z);
        if (score > best) {
            best = score;
            azimuth_rad = candidate.azimuth_rad;
        }
    }
    return azimuth_rad;
}

/// Chooses the position of the default sun. The sun stays if a fair share of the visible points is in light
/// and a fair share in shade. If too few points are in light or in shade, the sun is moved towards the eye,
/// or to the other side of the eye.
void set_sun(ViewAnalysis& analysis, const SurfaceCloud& cloud)
{
    struct Place {
        double side, swing_rad;
    };

    constexpr std::array<Place, 4> places{{{1.0, 0.0}, {1.0, 0.33}, {-1.0, 0.0}, {-1.0, 0.33}}};
    constexpr double wanted = 0.7;
    constexpr double slack = 0.18;
    const ViewAxes axes = look_from(analysis.azimuth_rad, analysis.elevation_rad);
    const std::vector<uint32_t> points = seen_points(see_from_afar(cloud, axes, analysis.subject));
    double best = std::numeric_limits<double>::infinity();
    ViewAnalysis tried = analysis;
    for (const Place& place : places) {
        tried.sun_side = place.side;
        tried.sun_swing_rad = place.swing_rad;
        const glm::dvec3 sun = tried.towards_sun(house_sun_azimuth_deg, house_sun_elevation_deg);
        const double miss = std::max(std::abs(lit_share(cloud, points, axes, sun) - wanted) - slack, 0.0);
        if (miss < best) {
            best = miss;
            analysis.sun_side = place.side;
            analysis.sun_swing_rad = place.swing_rad;
        }
    }
}

/// Returns the azimuth of a vertical side of a box. Sides are numbered as in Walls.
double side_azimuth(size_t side)
{
    constexpr std::array<double, 6> azimuths{
        -0.5 * std::numbers::pi, 0.5 * std::numbers::pi, 0.0, 0.0, std::numbers::pi, 0.0};
    return azimuths[side];
}

} // namespace

glm::dvec3 ViewAnalysis::towards_sun(double azimuth_deg, double elevation_deg) const
{
    const double from_eye_rad = glm::radians(azimuth_deg) - house_azimuth_rad + sun_swing_rad;
    return bearing(azimuth_rad + sun_side * from_eye_rad, glm::radians(elevation_deg));
}

SunPlace sun_over_ground(const SunPlace& asked, double wind_towards_deg)
{
    constexpr double low_deg = 16.0;
    constexpr double aside_deg = 35.0;
    const double upwind_deg = wind_towards_deg - 180.0;
    return {.azimuth_deg = asked.azimuth_deg == static_cast<double>(house_sun_azimuth_deg)
                               ? upwind_deg + aside_deg
                               : asked.azimuth_deg,
            .elevation_deg = asked.elevation_deg == static_cast<double>(house_sun_elevation_deg)
                                 ? low_deg
                                 : asked.elevation_deg};
}

ViewAnalysis analyze_view(const SurfaceCloud& cloud)
{
    ViewAnalysis analysis;
    analysis.subject = cloud.bounds;
    if (cloud.points.empty())
        return analysis;
    const Walls walls = find_walls(cloud);
    if (walls.room() && (walls.has_opening() || could_stand_inside(cloud))) {
        const size_t side = walls.opening();
        analysis.standpoint = Standpoint::opening;
        analysis.azimuth_rad = side_azimuth(side);
        analysis.elevation_rad = 0.0;
        analysis.cut_wall = walls.inward[side] && walls.two_sided[side];
        analysis.shelter = room_behind(cloud, analysis.azimuth_rad, walls.inward[side]);
        return analysis;
    }
    analysis.subject = subject_bounds(cloud);
    if (const auto inside = corner_view(cloud)) {
        analysis.standpoint = Standpoint::inside;
        analysis.corner = inside->eye;
        analysis.azimuth_rad = inside->azimuth_rad;
        analysis.elevation_rad = inside->elevation_rad;
        analysis.subject = inside->room;
        analysis.shelter = shelter_around(cloud, inside->eye);
        return analysis;
    }
    const SurfaceCloud subject = within(cloud, analysis.subject);
    analysis.azimuth_rad = best_azimuth(subject, analysis.subject);
    set_sun(analysis, subject);
    analysis.shelter =
        shade_below(cloud, analysis.subject, look_from(analysis.azimuth_rad, analysis.elevation_rad),
                    analysis.towards_sun(house_sun_azimuth_deg, house_sun_elevation_deg));
    return analysis;
}

ViewAnalysis analyze_view(const Scene& scene)
{
    return analyze_view(surface_cloud(scene, pose_scene(scene, 0.0, no_index)));
}

LightChoice default_light(const Scene& scene)
{
    if (has_visible_light(scene)) {
        return LightChoice::own;
    }
    const std::optional<Shelter> shelter = analyze_view(scene).shelter;
    if (!shelter) {
        return LightChoice::sun;
    }
    return shelter->towards_light ? LightChoice::lamp_and_daylight : LightChoice::lamp;
}

} // namespace estampe
