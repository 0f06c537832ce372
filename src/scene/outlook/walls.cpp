// SPDX-License-Identifier: MIT
#include "scene/outlook/walls.hpp"

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

struct Outermost {
    double height = -std::numeric_limits<double>::infinity();
    bool inward = false;
    bool two_sided = false;
};

} // namespace

bool Walls::room() const
{
    return std::count(inward.begin(), inward.end(), true) >= 4;
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
            if (!cell || !(height > cells[*cell].height))
                continue;
            cells[*cell] = {height, sign * static_cast<double>(point.normal[axis]) < -0.3, point.two_sided};
        }
        const auto most = [&](auto property) {
            return std::count_if(cells.begin(), cells.end(), property) > grid * grid / 2;
        };
        walls.inward[side] = most([](const Outermost& cell) { return cell.inward; });
        walls.closed[side] = most([](const Outermost& cell) { return cell.height > 0.85; });
        walls.two_sided[side] = most([](const Outermost& cell) { return cell.two_sided; });
    }
    return walls;
}

} // namespace estampe
