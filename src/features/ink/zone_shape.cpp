// SPDX-License-Identifier: MIT
#include "features/ink/zone_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "techniques/ink/ink.glsl.h"

namespace estampe::features {
namespace {

constexpr auto side = static_cast<int>(shared::ink_shape_side);
constexpr int border = 2; ///< number of grid points outside of the area on each side of the field

using Nodes = std::vector<bool>;

float cross(glm::vec2 a, glm::vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/// Marks the grid points within a triangle, whose corners are in units of the grid's spacing.
void cover(Nodes& nodes, const PageTriangle& triangle)
{
    const glm::vec2 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
    const glm::vec2 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
    const glm::ivec2 from = glm::max(glm::ivec2(glm::ceil(low)), 0);
    const glm::ivec2 to = glm::min(glm::ivec2(glm::floor(high)), side - 1);
    const float area = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    for (int y = from.y; y <= to.y; ++y) {
        for (int x = from.x; x <= to.x; ++x) {
            const glm::vec2 node(x, y);
            bool is_within = area != 0.0F;
            for (size_t corner = 0; corner < 3; ++corner) {
                const glm::vec2 edge = triangle.at((corner + 1) % 3) - triangle.at(corner);
                is_within = is_within && cross(edge, node - triangle.at(corner)) * area >= 0.0F;
            }
            if (is_within) {
                nodes[static_cast<size_t>(y * side + x)] = true;
            }
        }
    }
}

/// Returns for each grid point the distance to the nearest grid point outside of the area, in units of the
/// grid's spacing.
std::vector<float> depths(const Nodes& nodes)
{
    constexpr auto far = static_cast<float>(2 * side);
    std::vector<float> along_row(nodes.size(), far);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (int other = 0; other < side; ++other) {
                if (!nodes[static_cast<size_t>(y * side + other)]) {
                    float& nearest = along_row[static_cast<size_t>(y * side + x)];
                    nearest = std::min(nearest, static_cast<float>(std::abs(other - x)));
                }
            }
        }
    }
    std::vector<float> result(nodes.size(), far);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (int other = 0; other < side; ++other) {
                const float across = along_row[static_cast<size_t>(other * side + x)];
                float& nearest = result[static_cast<size_t>(y * side + x)];
                nearest = std::min(nearest, std::hypot(across, static_cast<float>(other - y)));
            }
        }
    }
    return result;
}

} // namespace

std::optional<ZoneShape> zone_shape(std::span<const PageTriangle> triangles)
{
    // Size limit, because a mesh close to the eye may cover an area of any size.
    constexpr float widest_mm = 1e5F;
    glm::vec2 low(std::numeric_limits<float>::max());
    glm::vec2 high(std::numeric_limits<float>::lowest());
    for (const PageTriangle& triangle : triangles) {
        for (const glm::vec2& corner : triangle) {
            low = glm::min(low, glm::clamp(corner, -widest_mm, widest_mm));
            high = glm::max(high, glm::clamp(corner, -widest_mm, widest_mm));
        }
    }
    const glm::vec2 extent_mm = high - low;
    if (triangles.empty() || !(std::max(extent_mm.x, extent_mm.y) > 0.0F)) {
        return std::nullopt;
    }
    // Grid points have the same spacing along x and y, so that distances on the grid are proportional to
    // distances on the page.
    const float node_mm = std::max(extent_mm.x, extent_mm.y) / static_cast<float>(side - 1 - 2 * border);
    ZoneShape shape{.size_mm = glm::vec2(node_mm * static_cast<float>(side - 1))};
    shape.min_mm = 0.5F * (low + high) - 0.5F * shape.size_mm;
    Nodes nodes(static_cast<size_t>(side) * side);
    for (PageTriangle triangle : triangles) {
        for (glm::vec2& corner : triangle) {
            corner = (glm::clamp(corner, -widest_mm, widest_mm) - shape.min_mm) / node_mm;
        }
        cover(nodes, triangle);
    }
    glm::vec2 sum(0.0F);
    float count = 0.0F;
    for (int i = 0; i < side * side; ++i) {
        if (nodes[static_cast<size_t>(i)]) {
            sum += glm::vec2(i % side, i / side);
            count += 1.0F;
        }
    }
    if (count == 0.0F) {
        return std::nullopt;
    }
    shape.middle_mm = shape.min_mm + node_mm * sum / count;
    shape.radius_mm = node_mm * std::sqrt(count / std::numbers::pi_v<float>);
    shape.field = depths(nodes);
    // The edge of the area lies half-way between a grid point within the area and a grid point outside of it.
    const float deepest = std::max(*std::ranges::max_element(shape.field) - 0.5F, 0.5F);
    for (float& value : shape.field) {
        value = std::clamp(1.0F - (value - 0.5F) / deepest, 0.0F, 1.0F);
    }
    return shape;
}

} // namespace estampe::features
