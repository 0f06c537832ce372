// SPDX-License-Identifier: MIT
#include "tour.hpp"

#include <algorithm>
#include <cmath>

namespace temple {

Tour::Tour(const Visit& visit, uint64_t seed)
    : visit_(visit), chart_(visit.walker().place(), visit.walker().body(), visit.walker().feet_m(),
                            {.low_m = {-42.0, -66.0}, .high_m = {36.0, 108.0}})
{
    const Plan plan = make_plan(seed);
    std::vector<glm::dvec2> stations{{-1.2, 80.0}, {18.0, 98.0}, {-20.0, 90.0}, {0.0, 30.0},
                                     {-24.0, 2.0}, {13.0, 6.0},  {0.0, -19.0}};
    // Rooms by their way from the portal, the last one at the end.
    std::vector<size_t> rooms;
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        if (static_cast<int>(i) != plan.last_room && find_open(plan.rooms[i])) {
            rooms.push_back(i);
        }
    }
    const glm::dvec2 portal_m(plan.doors.front().place_m);
    std::ranges::sort(rooms, {}, [&](size_t i) {
        return chart_.way(portal_m - glm::dvec2(0.0, 2.0), *find_open(plan.rooms[i])).size();
    });
    rooms.push_back(static_cast<size_t>(plan.last_room));
    for (const size_t i : rooms) {
        if (const std::optional<glm::dvec2> open = find_open(plan.rooms[i])) {
            stations.push_back(*open);
            halls_ += plan.rooms[i].kind == RoomKind::cell ? 0 : 1;
        }
    }
    stations.push_back(portal_m + glm::dvec2(0.0, 3.0));
    stations.push_back(stations.front());
    glm::dvec2 from_m = stations.front();
    for (const glm::dvec2& station : stations) {
        const std::vector<glm::dvec3> leg = chart_.way(from_m, station);
        if (!leg.empty()) {
            way_.insert(way_.end(), leg.begin(), leg.end());
            from_m = station;
        }
    }
}

walk::Intent Tour::intent()
{
    const glm::dvec3& feet_m = visit_.walker().feet_m();
    constexpr double ahead_m = 0.7;
    while (glm::distance(glm::dvec2(feet_m.x, feet_m.z), target_m()) < ahead_m) {
        if (++next_ == way_.size()) {
            next_ = 0;
            ++rounds_;
        }
    }
    const glm::dvec2 way = target_m() - glm::dvec2(feet_m.x, feet_m.z);
    return {.way = way / glm::length(way), .runs = feet_m.z > -14.0};
}

std::optional<glm::dvec2> Tour::find_open(const Room& room) const
{
    const glm::dvec2 middle_m(room.middle_m());
    for (double far_m = 0.0; far_m < 2.0; far_m += 0.3) {
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.7854 * k;
            const glm::dvec2 at = middle_m + far_m * glm::dvec2(std::cos(angle), std::sin(angle));
            if (chart_.reaches(at)) {
                return at;
            }
        }
    }
    return std::nullopt;
}

} // namespace temple
