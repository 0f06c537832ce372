// SPDX-License-Identifier: MIT
#include "sight.hpp"

#include <algorithm>
#include <optional>

namespace temple {
namespace {

constexpr float wider_m = 0.8F;   ///< than it is a door counts
constexpr float within_m = 1.2F;  ///< of a door one is in both rooms
constexpr float above_m = 5.0F;   ///< the floor one may look down on roofs
constexpr float around_m = 60.0F; ///< from which one sees holes in them

float cross(const glm::vec2& a, const glm::vec2& b)
{
    return a.x * b.y - a.y * b.x;
}

/// A way out of a room, from side to side.
struct Portal {
    int to = outside;
    glm::vec2 from_m{0.0F}, to_m{0.0F};
};

/// What lies between two directions, counter-clockwise from the first, less than half a turn.
struct Wedge {
    glm::vec2 first{0.0F}, last{0.0F};
};

float away_m(const Portal& portal, const glm::vec2& eye)
{
    const glm::vec2 along = portal.to_m - portal.from_m;
    const float share = glm::clamp(glm::dot(eye - portal.from_m, along) / glm::dot(along, along), 0.0F, 1.0F);
    return glm::distance(eye, portal.from_m + share * along);
}

class Looker {
public:
    Looker(const Plan& plan, const glm::vec2& eye)
        : plan_(plan), eye_(eye), seen_(plan.rooms.size(), false), is_passed_(plan.rooms.size(), false)
    {
    }

    /// All that is seen from within a room, or from the open.
    void look_around(int room) { look(room, std::nullopt); }

    [[nodiscard]] const std::vector<bool>& seen() const { return seen_; }

private:
    /// Rooms without a roof are parts of the open.
    [[nodiscard]] int place_of(int room) const
    {
        return room == outside || plan_.rooms[static_cast<size_t>(room)].is_roofed() ? room : outside;
    }

    [[nodiscard]] std::vector<Portal> portals_of(int room) const
    {
        std::vector<Portal> portals;
        for (const WallRun& wall : plan_.walls) {
            if (!wall.door) {
                continue;
            }
            const Door& door = plan_.doors[*wall.door];
            const int a = place_of(door.a);
            const int b = place_of(door.b);
            if (a == b || (a != room && b != room)) {
                continue;
            }
            const glm::vec2 half =
                (door.half_m + wider_m) * (wall.is_along_x ? glm::vec2(1.0F, 0.0F) : glm::vec2(0.0F, 1.0F));
            portals.push_back({a == room ? b : a, door.place_m - half, door.place_m + half});
        }
        return portals;
    }

    void look(int room, const std::optional<Wedge>& wedge)
    {
        if (room != outside) {
            const auto index = static_cast<size_t>(room);
            if (is_passed_[index]) {
                return; // no straight way comes twice into a room
            }
            seen_[index] = true;
            is_passed_[index] = true;
        } else if (is_outside_passed_) {
            return;
        } else {
            is_outside_passed_ = true;
        }
        for (const Portal& portal : portals_of(room)) {
            if (away_m(portal, eye_) < within_m) {
                look(portal.to, wedge);
                continue;
            }
            Wedge seen{portal.from_m - eye_, portal.to_m - eye_};
            if (cross(seen.first, seen.last) < 0.0F) {
                std::swap(seen.first, seen.last);
            }
            if (wedge) {
                seen.first = cross(seen.first, wedge->first) > 0.0F ? wedge->first : seen.first;
                seen.last = cross(seen.last, wedge->last) < 0.0F ? wedge->last : seen.last;
                if (glm::dot(seen.first, wedge->first + wedge->last) <= 0.0F ||
                    cross(seen.first, seen.last) <= 0.0F) {
                    continue;
                }
            }
            look(portal.to, seen);
        }
        if (room != outside) {
            is_passed_[static_cast<size_t>(room)] = false;
        } else {
            is_outside_passed_ = false;
        }
    }

    const Plan& plan_;
    glm::vec2 eye_;
    std::vector<bool> seen_;
    std::vector<bool> is_passed_; ///< on the way that is being followed
    bool is_outside_passed_ = false;
};

} // namespace

std::vector<bool> rooms_in_sight(const Plan& plan, const glm::vec3& eye_m)
{
    const glm::vec2 eye(eye_m.x, eye_m.z);
    const auto own = std::ranges::find_if(plan.rooms, [&](const Room& room) {
        return room.is_roofed() && eye_m.y < floor_m + room.height_m &&
               glm::all(glm::greaterThanEqual(eye, room.low_m())) &&
               glm::all(glm::lessThanEqual(eye, room.high_m()));
    });
    Looker looker(plan, eye);
    looker.look_around(own == plan.rooms.end() ? outside : static_cast<int>(own - plan.rooms.begin()));
    std::vector<bool> seen = looker.seen();
    const bool looks_down = own == plan.rooms.end() && eye_m.y > floor_m + above_m;
    for (size_t i = 0; i < seen.size(); ++i) {
        const Room& room = plan.rooms[i];
        const glm::vec2 off = glm::max(glm::max(room.low_m() - eye, eye - room.high_m()), glm::vec2(0.0F));
        seen[i] = seen[i] || !room.is_roofed() || (looks_down && glm::length(off) < around_m);
    }
    return seen;
}

} // namespace temple
