// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "scene/view_analysis/surface_points.hpp"
#include "scene/view_analysis/view_analysis.hpp"

namespace estampe {
namespace {

constexpr int grid = 8;

/// Returns the grid cell of a point, as seen along the axis of a side of the box. Returns nothing if the
/// point is near the rim of the side.
std::optional<size_t> grid_cell(const glm::dvec3& part, int axis)
{
    constexpr double rim = 0.1;
    const double u = (part[(axis + 1) % 3] - rim) / (1.0 - 2.0 * rim);
    const double v = (part[(axis + 2) % 3] - rim) / (1.0 - 2.0 * rim);
    if (!(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0))
        return std::nullopt;
    return static_cast<size_t>(u * grid) * grid + static_cast<size_t>(v * grid);
}

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// The outermost points in a grid cell. Heights are from 0 at the opposite side of the box to 1 at the side
/// itself.
struct Outermost {
    double height = nothing;
    /// Height of the outermost point whose surface faces the middle of the box.
    double inward_height = nothing;
    /// Height of the outermost point whose surface faces away from the middle.
    double outward_height = nothing;
    bool two_sided = false;

    /// Returns whether a wall of a room is at this side of the box. No surface that is visible from outside
    /// may be in front of the wall. Such a surface is the outside of a thick wall, or the second face of a
    /// doubled wall.
    [[nodiscard]] bool is_wall_of_room() const
    {
        return inward_height > at_the_side && inward_height > outward_height + 0.01;
    }

    static constexpr double at_the_side = 0.85;
};

} // namespace

bool Walls::room() const
{
    return std::count(inward.begin(), inward.end(), true) >= 4;
}

bool Walls::has_opening() const
{
    return !inward[opening()];
}

size_t Walls::opening() const
{
    for (const size_t side : {5U, 4U, 0U, 1U})
        if (!inward[side] && !closed[side])
            return side;
    return 5;
}

Walls find_walls(const SurfaceCloud& cloud)
{
    Walls walls;
    const glm::dvec3 size = cloud.bounds.max - cloud.bounds.min;
    for (size_t side = 0; side < 6 && !cloud.points.empty(); ++side) {
        const int axis = static_cast<int>(side / 2);
        const double sign = side % 2 == 0 ? -1.0 : 1.0;
        std::array<Outermost, grid * grid> cells{};
        for (const SurfacePoint& point : cloud.points) {
            const glm::dvec3 part = (glm::dvec3(point.position) + cloud.origin - cloud.bounds.min) / size;
            const auto cell = grid_cell(part, axis);
            const double height = sign > 0.0 ? part[axis] : 1.0 - part[axis];
            if (!cell)
                continue;
            Outermost& outermost = cells[*cell];
            const bool is_inward = sign * static_cast<double>(point.normal[axis]) < -0.3;
            double& facing_alike = is_inward ? outermost.inward_height : outermost.outward_height;
            facing_alike = std::max(facing_alike, height);
            if (height > outermost.height) {
                outermost.height = height;
                outermost.two_sided = point.two_sided;
            }
        }
        const auto most = [&](auto property) {
            return std::count_if(cells.begin(), cells.end(), property) > grid * grid / 2;
        };
        walls.inward[side] = most([](const Outermost& cell) { return cell.is_wall_of_room(); });
        walls.closed[side] = most([](const Outermost& cell) { return cell.height > Outermost::at_the_side; });
        walls.two_sided[side] = most([](const Outermost& cell) { return cell.two_sided; });
    }
    return walls;
}

namespace {

/// Height of the lamp above the floor, as a share of the room's height.
constexpr double lamp_height = 0.84;

/// Returns the bounds of the points, without the outermost hundredth of the points on each side.
Bounds trimmed_bounds(const std::vector<SurfacePoint>& points, const glm::dvec3& origin)
{
    Bounds bounds;
    if (points.empty())
        return bounds;
    std::vector<float> values(points.size());
    const size_t trim = points.size() / 100;
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(points.begin(), points.end(), values.begin(),
                       [axis](const SurfacePoint& point) { return point.position[axis]; });
        std::sort(values.begin(), values.end());
        bounds.min[axis] = origin[axis] + static_cast<double>(values[trim]);
        bounds.max[axis] = origin[axis] + static_cast<double>(values[values.size() - 1 - trim]);
    }
    return bounds;
}

/// Returns the position of a lamp: below glowing surfaces in the upper half of the room, else below the
/// middle of the ceiling.
glm::dvec3 lamp_place(const Shelter& shelter)
{
    const Bounds room = trimmed_bounds(shelter.seen, shelter.origin);
    glm::dvec3 place = room.center();
    place.y = glm::mix(room.min.y, room.max.y, lamp_height);
    glm::dvec3 sum{0.0};
    double count = 0.0;
    for (const SurfacePoint& point : shelter.seen) {
        const glm::dvec3 position = glm::dvec3(point.position) + shelter.origin;
        if (point.glows && position.y > room.center().y) {
            sum += position;
            count += 1.0;
        }
    }
    if (count > 0.0) {
        place = sum / count;
        place.y -= (1.0 - lamp_height) * (room.max.y - room.min.y);
    }
    return place;
}

SurfacePoint turned_to(const SurfacePoint& point, const glm::vec3& way)
{
    SurfacePoint turned = point;
    if (glm::dot(point.normal, way) > 0.0F)
        turned.normal = -turned.normal;
    return turned;
}

Shelter shelter_of(const SurfaceCloud& cloud, const std::vector<uint32_t>& points, const ViewAxes& axes)
{
    Shelter shelter;
    shelter.origin = cloud.origin;
    for (const uint32_t point : points)
        shelter.seen.push_back(turned_to(cloud.points[point], glm::vec3(axes.forward)));
    shelter.lamp = lamp_place(shelter);
    return shelter;
}

/// The nearest surface point in each of 16 x 8 directions of equal solid angle around an eye.
class Surroundings {
public:
    static constexpr int around = 16;
    static constexpr int levels = 8;

    Surroundings(const SurfaceCloud& cloud, const glm::dvec3& eye)
    {
        const glm::vec3 from(eye - cloud.origin);
        for (size_t i = 0; i < cloud.points.size(); ++i) {
            const glm::vec3 way = cloud.points[i].position - from;
            const float distance_m = glm::length(way);
            if (!(distance_m > 0.0F))
                continue;
            const float turn = 0.5F + std::atan2(way.x, way.z) / static_cast<float>(2.0 * std::numbers::pi);
            const int column = std::clamp(static_cast<int>(turn * around), 0, around - 1);
            const int row =
                std::clamp(static_cast<int>((0.5F + 0.5F * way.y / distance_m) * levels), 0, levels - 1);
            Nearest& cell = cells_[static_cast<size_t>(row) * around + static_cast<size_t>(column)];
            if (distance_m < cell.distance_m)
                cell = {static_cast<uint32_t>(i), distance_m};
        }
    }

    /// Returns the share of the directions above the horizon in which there is a surface.
    [[nodiscard]] double closed_above() const
    {
        const auto first = cells_.begin() + around * levels / 2;
        return static_cast<double>(std::count_if(first, cells_.end(), is_closed)) / (0.5 * around * levels);
    }

    [[nodiscard]] double open_share() const
    {
        const auto closed = std::count_if(cells_.begin(), cells_.end(), is_closed);
        return 1.0 - static_cast<double>(closed) / static_cast<double>(cells_.size());
    }

    /// Returns a distance such that in one eighth of all directions the nearest surface is farther away.
    [[nodiscard]] double free_sight_m() const
    {
        std::vector<float> distances;
        for (const Nearest& cell : cells_)
            distances.push_back(cell.distance_m);
        const auto freest = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 7 / 8);
        std::nth_element(distances.begin(), freest, distances.end());
        return static_cast<double>(*freest);
    }

    [[nodiscard]] std::vector<uint32_t> nearest() const
    {
        std::vector<uint32_t> points;
        for (const Nearest& cell : cells_)
            if (is_closed(cell))
                points.push_back(cell.point);
        return points;
    }

private:
    struct Nearest {
        uint32_t point = SeenGrid::nothing;
        float distance_m = 1e30F;
    };

    static bool is_closed(const Nearest& cell) { return cell.point != SeenGrid::nothing; }

    std::array<Nearest, size_t{around} * levels> cells_{};
};

double area_of(const std::vector<SurfacePoint>& points)
{
    return std::accumulate(points.begin(), points.end(), 0.0, [](double sum, const SurfacePoint& point) {
        return sum + static_cast<double>(point.area_m2);
    });
}

/// Returns the points that are hidden from outside. A point is hidden if none of six views, from all around,
/// above and below, shows it.
std::vector<SurfacePoint> hidden_points(const SurfaceCloud& cloud)
{
    constexpr std::array<glm::dvec2, 6> views{
        {{0.25, 0.31}, {0.75, 0.31}, {1.25, 0.31}, {1.75, 0.31}, {0.1, 1.4}, {0.1, -1.4}}};
    std::vector<bool> shown(cloud.points.size(), false);
    for (const glm::dvec2& view : views)
        mark_shown(cloud, look_from(view.x * std::numbers::pi, view.y), shown);
    std::vector<SurfacePoint> hidden;
    for (size_t i = 0; i < shown.size(); ++i)
        if (!shown[i])
            hidden.push_back(cloud.points[i]);
    return hidden;
}

/// Returns the share of the hidden surface that belongs to free-standing objects. A point counts if, as seen
/// from the middle, another hidden point behind it is clearly further away.
double furnished_share(const std::vector<SurfacePoint>& hidden, const glm::vec3& middle)
{
    constexpr int around = 64;
    constexpr int levels = 32;
    constexpr float clearly_nearer = 0.7F;
    std::vector<float> furthest_m(size_t{around} * levels, 0.0F);
    const auto cell_of = [](const glm::vec3& way, float distance_m) {
        const float turn = 0.5F + std::atan2(way.x, way.z) / static_cast<float>(2.0 * std::numbers::pi);
        const int column = std::clamp(static_cast<int>(turn * around), 0, around - 1);
        const int row =
            std::clamp(static_cast<int>((0.5F + 0.5F * way.y / distance_m) * levels), 0, levels - 1);
        return static_cast<size_t>(row) * around + static_cast<size_t>(column);
    };
    const auto visit = [&](auto&& see) {
        for (const SurfacePoint& point : hidden) {
            const glm::vec3 way = point.position - middle;
            const float distance_m = glm::length(way);
            if (distance_m > 0.0F)
                see(point, distance_m, furthest_m[cell_of(way, distance_m)]);
        }
    };
    visit([](const SurfacePoint&, float distance_m, float& furthest) {
        furthest = std::max(furthest, distance_m);
    });
    double free_m2 = 0.0;
    visit([&free_m2](const SurfacePoint& point, float distance_m, const float& furthest) {
        free_m2 += distance_m < clearly_nearer * furthest ? static_cast<double>(point.area_m2) : 0.0;
    });
    return free_m2 / std::max(area_of(hidden), 1e-30);
}

/// Returns whether the space that the hidden surface encloses is large enough for a standing person, and not
/// too high for a room.
bool could_stand_within(const Bounds& space)
{
    constexpr double least_m = 1.6;
    // Greatest height of a room; if it is higher, the unit is not metres or it is not a room.
    constexpr double most_headroom_m = 25.0;
    const glm::dvec3 size = space.max - space.min;
    return std::min({size.x, size.y, size.z}) >= least_m && size.y <= most_headroom_m;
}

/// Returns whether the inside of a room contains objects, windows or doors.
bool is_worth_seeing(const SurfaceCloud& cloud, const std::vector<SurfacePoint>& hidden, const Bounds& space)
{
    constexpr double some_furniture = 0.005;
    constexpr double some_window = 0.02;
    return furnished_share(hidden, glm::vec3(space.center() - cloud.origin)) > some_furniture ||
           Surroundings(cloud, space.center()).open_share() > some_window;
}

} // namespace

bool could_stand_inside(const SurfaceCloud& cloud)
{
    const std::vector<SurfacePoint> hidden = hidden_points(cloud);
    return !hidden.empty() && could_stand_within(trimmed_bounds(hidden, cloud.origin));
}

Shelter room_behind(const SurfaceCloud& cloud, double azimuth_rad, bool walled)
{
    const ViewAxes axes = look_from(azimuth_rad, 0.0);
    SurfaceCloud behind = cloud;
    if (walled) {
        const double nearest = glm::dot(cloud.bounds.center() - cloud.origin, axes.forward) -
                               0.5 * std::abs(glm::dot(cloud.bounds.max - cloud.bounds.min, axes.forward));
        const double depth_m = std::abs(glm::dot(cloud.bounds.max - cloud.bounds.min, axes.forward));
        std::erase_if(behind.points, [&](const SurfacePoint& point) {
            return glm::dot(glm::dvec3(point.position), axes.forward) < nearest + 0.02 * depth_m;
        });
    }
    Shelter shelter = shelter_of(behind, seen_points(see_from_afar(behind, axes, cloud.bounds)), axes);
    if (!walled)
        shelter.towards_light = bearing(azimuth_rad - 0.38, 0.36);
    return shelter;
}

std::optional<Shelter> shade_below(const SurfaceCloud& cloud, const Bounds& subject, const ViewAxes& axes,
                                   const glm::dvec3& towards_sun)
{
    constexpr double hardly = 0.1;
    const std::vector<uint32_t> points = seen_points(see_from_afar(cloud, axes, subject));
    if (points.size() < 64 || lit_share(cloud, points, axes, towards_sun) > hardly)
        return std::nullopt;
    return shelter_of(cloud, points, axes);
}

std::optional<Shelter> shelter_around(const SurfaceCloud& cloud, const glm::dvec3& eye)
{
    const Surroundings surroundings(cloud, eye);
    if (surroundings.closed_above() < 0.9)
        return std::nullopt;
    Shelter shelter;
    shelter.origin = cloud.origin;
    for (const uint32_t point : surroundings.nearest()) {
        const SurfacePoint& surface = cloud.points[point];
        shelter.seen.push_back(turned_to(surface, surface.position - glm::vec3(eye - cloud.origin)));
    }
    shelter.lamp = lamp_place(shelter);
    return shelter;
}

std::optional<CornerView> corner_view(const SurfaceCloud& cloud)
{
    // Share of the surface that must be hidden in a room; in a furnished model a fifth is hidden.
    constexpr double much = 0.28;
    // Shortest free sight from the eye, as a share of the room's diagonal.
    constexpr double least_sight = 0.25;
    const std::vector<SurfacePoint> hidden = hidden_points(cloud);
    if (hidden.empty() || area_of(hidden) < much * area_of(cloud.points))
        return std::nullopt;
    const Bounds room = trimmed_bounds(hidden, cloud.origin);
    if (!could_stand_within(room) || !is_worth_seeing(cloud, hidden, room))
        return std::nullopt;
    const glm::dvec3 half = 0.5 * (room.max - room.min);
    std::optional<CornerView> best;
    double best_sight_m = least_sight * 2.0 * room.radius();
    for (const glm::dvec2 corner :
         {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)}) {
        const glm::dvec3 offset = half * glm::dvec3(0.78 * corner.x, 0.24, 0.78 * corner.y);
        const Surroundings surroundings(cloud, room.center() + offset);
        const double sight_m = surroundings.free_sight_m();
        if (surroundings.closed_above() < 0.9 || sight_m < best_sight_m)
            continue;
        best_sight_m = 1.1 * sight_m; // a later corner is only chosen if the view from it is clearly freer
        best =
            CornerView{.eye = room.center() + offset,
                       .azimuth_rad = std::atan2(offset.x, offset.z),
                       .elevation_rad = std::atan2(offset.y + 0.2 * half.y, std::hypot(offset.x, offset.z)),
                       .room = room};
    }
    return best;
}

} // namespace estampe
