// SPDX-License-Identifier: MIT
#include "chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace walk {
namespace {

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
constexpr float most_room_m = 2.0F;

constexpr std::array<glm::ivec2, 8> around{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// Returns whether a body can stand on this ground without sliding.
bool holds(const Footing& footing, const Body& body)
{
    constexpr double reserve_deg = 3.0;
    const auto limit_deg = static_cast<double>(footing.is_sand ? body.repose_deg : body.steepest_deg);
    return footing.normal.y > std::cos(glm::radians(limit_deg - reserve_deg));
}

/// A square of the grid that waits in the search queue, with its cost.
struct Open {
    double cost = 0.0;
    glm::ivec2 square{0};

    // In the search queue, the lowest cost comes first.
    bool operator<(const Open& other) const { return cost > other.cost; }
};

} // namespace

Chart::Chart(const Place& place, const Body& body, const glm::dvec3& from_m, const ChartLimits& limits)
    : limits_(limits), size_(glm::ceil((limits.high_m - limits.low_m) / limits.square_m))
{
    const size_t count = static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y);
    height_m_.assign(count, nowhere);
    room_m_.assign(count, 0.0F);
    flood(place, body, from_m);
    measure_room();
}

glm::ivec2 Chart::square_of(const glm::dvec2& place_m) const
{
    return glm::floor((place_m - limits_.low_m) / limits_.square_m);
}

bool Chart::is_in(const glm::ivec2& square) const
{
    return glm::all(glm::greaterThanEqual(square, glm::ivec2(0))) && glm::all(glm::lessThan(square, size_));
}

size_t Chart::index(const glm::ivec2& square) const
{
    return static_cast<size_t>(square.y) * static_cast<size_t>(size_.x) + static_cast<size_t>(square.x);
}

glm::dvec2 Chart::middle_m(const glm::ivec2& square) const
{
    return limits_.low_m + limits_.square_m * (glm::dvec2(square) + 0.5);
}

void Chart::flood(const Place& place, const Body& body, const glm::dvec3& from_m)
{
    Body wider = body;
    wider.radius_m += 0.06F;
    const auto drop_m = static_cast<double>(body.step_m);
    std::vector<bool> is_known(height_m_.size(), false);
    std::queue<glm::ivec2> next;
    const auto enter = [&](const glm::ivec2& square, double height_m) {
        const glm::dvec2 at = middle_m(square);
        const std::optional<Footing> footing = place.footing({at.x, height_m, at.y}, body, drop_m);
        // A square that differs too much in height from the present neighbour may be reachable from another
        // neighbour.
        if (!footing || std::abs(footing->height_m - height_m) > drop_m || !holds(*footing, body)) {
            return;
        }
        is_known[index(square)] = true;
        const glm::dvec3 feet_m(at.x, footing->height_m, at.y);
        const std::optional<glm::dvec3> there = place.pushed_out(feet_m, wider);
        if (there && glm::distance(*there, feet_m) < 1e-6) {
            height_m_[index(square)] = static_cast<float>(footing->height_m);
            next.push(square);
        }
    };
    if (const glm::ivec2 start = square_of({from_m.x, from_m.z}); is_in(start)) {
        enter(start, from_m.y);
    }
    while (!next.empty()) {
        const glm::ivec2 here = next.front();
        next.pop();
        for (size_t k = 0; k < 4; ++k) {
            const glm::ivec2 there = here + around.at(k);
            if (is_in(there) && !is_known[index(there)]) {
                enter(there, static_cast<double>(height_m_[index(here)]));
            }
        }
    }
}

void Chart::measure_room()
{
    // The distance to obstacles increases by 1 from a square to the next, and by the square root of 2 to a
    // diagonal one.
    const auto square_m = static_cast<float>(limits_.square_m);
    std::priority_queue<Open> next;
    for (int z = 0; z < size_.y; ++z) {
        for (int x = 0; x < size_.x; ++x) {
            const bool is_free = !std::isnan(height_m_[index({x, z})]);
            room_m_[index({x, z})] = is_free ? most_room_m : 0.0F;
            if (!is_free) {
                next.push({0.0, {x, z}});
            }
        }
    }
    while (!next.empty()) {
        const Open here = next.top();
        next.pop();
        if (here.cost > static_cast<double>(room_m_[index(here.square)])) {
            continue;
        }
        for (const glm::ivec2& way : around) {
            const glm::ivec2 there = here.square + way;
            const float far_m = static_cast<float>(here.cost) + square_m * glm::length(glm::vec2(way));
            if (is_in(there) && far_m < room_m_[index(there)]) {
                room_m_[index(there)] = far_m;
                next.push({static_cast<double>(far_m), there});
            }
        }
    }
}

bool Chart::reaches(const glm::dvec2& place_m) const
{
    const glm::ivec2 square = square_of(place_m);
    return is_in(square) && !std::isnan(height_m_[index(square)]);
}

double Chart::room_m(const glm::dvec2& place_m) const
{
    const glm::ivec2 square = square_of(place_m);
    return is_in(square) ? static_cast<double>(room_m_[index(square)]) : 0.0;
}

std::vector<glm::dvec3> Chart::way(const glm::dvec2& from_m, const glm::dvec2& to_m) const
{
    if (!reaches(from_m) || !reaches(to_m)) {
        return {};
    }
    // The search A* runs from the end of the path to its beginning, so that the squares found are in the
    // order from beginning to end.
    const glm::ivec2 start = square_of(to_m);
    const glm::ivec2 goal = square_of(from_m);
    std::vector<double> cost(height_m_.size(), std::numeric_limits<double>::infinity());
    std::vector<uint8_t> came_by(height_m_.size(), 0);
    std::priority_queue<Open> next;
    const auto left = [&](const glm::ivec2& square) { return glm::length(glm::dvec2(square - goal)); };
    cost[index(start)] = 0.0;
    next.push({left(start), start});
    while (!next.empty() && next.top().square != goal) {
        const Open here = next.top();
        next.pop();
        const double so_far = cost[index(here.square)];
        if (here.cost > so_far + left(here.square) + 1e-9) {
            continue;
        }
        for (size_t k = 0; k < around.size(); ++k) {
            const glm::ivec2 there = here.square + around.at(k);
            const auto is_free = [&](const glm::ivec2& square) {
                return is_in(square) && !std::isnan(height_m_[index(square)]);
            };
            // The path does not cut corners, and does not step between squares whose heights differ too much.
            if (!is_free(there) || !is_free({here.square.x, there.y}) || !is_free({there.x, here.square.y}) ||
                std::abs(height_m_[index(there)] - height_m_[index(here.square)]) > 0.42F) {
                continue;
            }
            const double narrow = 1.0 - static_cast<double>(room_m_[index(there)] / most_room_m);
            const double then =
                so_far + glm::length(glm::dvec2(around.at(k))) * (1.0 + 4.0 * narrow * narrow);
            if (then < cost[index(there)]) {
                cost[index(there)] = then;
                came_by[index(there)] = static_cast<uint8_t>(k);
                next.push({then + left(there), there});
            }
        }
    }
    std::vector<glm::dvec3> way;
    if (next.empty()) {
        return way;
    }
    for (glm::ivec2 here = goal;; here -= around.at(came_by[index(here)])) {
        const glm::dvec2 at = middle_m(here);
        way.emplace_back(at.x, static_cast<double>(height_m_[index(here)]), at.y);
        if (here == start) {
            return way;
        }
    }
}

} // namespace walk
