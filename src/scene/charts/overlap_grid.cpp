// SPDX-License-Identifier: MIT
#include "scene/charts/overlap_grid.hpp"

#include <algorithm>
#include <cmath>

namespace estampe::charts {
namespace {

/// How far two triangles reach into each other along `axis`, as a share of the shorter reach.
bool separates(const glm::vec2& axis, const FlatTriangle& a, const FlatTriangle& b)
{
    constexpr float tolerance = 1e-4F;
    const auto [a_low, a_high] =
        std::minmax({glm::dot(axis, a[0]), glm::dot(axis, a[1]), glm::dot(axis, a[2])});
    const auto [b_low, b_high] =
        std::minmax({glm::dot(axis, b[0]), glm::dot(axis, b[1]), glm::dot(axis, b[2])});
    const float shared = std::min(a_high, b_high) - std::max(a_low, b_low);
    return shared <= tolerance * std::min(a_high - a_low, b_high - b_low);
}

uint64_t key_of(int32_t x, int32_t y)
{
    return static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32U | static_cast<uint32_t>(x);
}

} // namespace

bool overlap(const FlatTriangle& a, const FlatTriangle& b)
{
    for (const FlatTriangle* triangle : {&a, &b}) {
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec2 edge = (*triangle)[(k + 1) % 3] - (*triangle)[k];
            if (separates({-edge.y, edge.x}, a, b)) {
                return false;
            }
        }
    }
    return true;
}

OverlapGrid::Cells OverlapGrid::cells_of(const FlatTriangle& triangle) const
{
    constexpr float farthest = 1e9F;
    const glm::vec2 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::vec2 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    const auto cell = [&](const glm::vec2& place) {
        return glm::ivec2(glm::clamp(glm::floor(place / cell_m_), -farthest, farthest));
    };
    return {cell(low), cell(high)};
}

bool OverlapGrid::is_free(const FlatTriangle& triangle, std::span<const uint32_t> others) const
{
    return std::ranges::none_of(others, [&](uint32_t other) { return overlap(triangle, triangles_[other]); });
}

bool OverlapGrid::add(const FlatTriangle& triangle)
{
    constexpr double most_cells = 4096.0;
    const Cells cells = cells_of(triangle);
    const glm::dvec2 count = glm::dvec2(cells.last) - glm::dvec2(cells.first) + 1.0;
    const auto number = static_cast<uint32_t>(triangles_.size());
    if (!is_free(triangle, wide_)) {
        return false;
    }
    if (count.x * count.y > most_cells) {
        if (std::ranges::any_of(triangles_, [&](const auto& other) { return overlap(triangle, other); })) {
            return false;
        }
        wide_.push_back(number);
        triangles_.push_back(triangle);
        return true;
    }
    for (int32_t y = cells.first.y; y <= cells.last.y; ++y) {
        for (int32_t x = cells.first.x; x <= cells.last.x; ++x) {
            const auto found = cells_.find(key_of(x, y));
            if (found != cells_.end() && !is_free(triangle, found->second)) {
                return false;
            }
        }
    }
    for (int32_t y = cells.first.y; y <= cells.last.y; ++y) {
        for (int32_t x = cells.first.x; x <= cells.last.x; ++x) {
            cells_[key_of(x, y)].push_back(number);
        }
    }
    triangles_.push_back(triangle);
    return true;
}

} // namespace estampe::charts
