// SPDX-License-Identifier: MIT
#include "scene/view_analysis/walls.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace estampe {
namespace {

constexpr int grid = 8;

/// The cell of the inner part of a side that a point lies in, seen along the side's axis.
std::optional<size_t> cell_of(const glm::dvec3& part, int axis)
{
    constexpr double rim = 0.1;
    const double u = (part[(axis + 1) % 3] - rim) / (1.0 - 2.0 * rim);
    const double v = (part[(axis + 2) % 3] - rim) / (1.0 - 2.0 * rim);
    if (!(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0))
        return std::nullopt;
    return static_cast<size_t>(u * grid) * grid + static_cast<size_t>(v * grid);
}

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// What of a cell lies furthest out, from 0 at the opposite side of the box to 1 at the side itself.
struct Outermost {
    double height = nothing;
    double inward_height = nothing;  ///< of what faces the middle
    double outward_height = nothing; ///< of what faces away from it
    bool two_sided = false;

    /// A wall of a room stands at the side of the box, and nothing that is seen from outside stands before
    /// it: neither the outside of a thick wall, nor the second face of a doubled one.
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
            const auto cell = cell_of(part, axis);
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

} // namespace estampe
