// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>

#include "plan.hpp"

namespace temple {
namespace {

constexpr float cell_m = 0.25F;
constexpr float margin_m = 4.0F; ///< of free ground around the prison

/// The ground of the prison in small squares, free or not.
class Floor {
public:
    explicit Floor(float radius_m)
        : low_m_(-0.5F * module_m * modules_x - margin_m, front_z_m - module_m * modules_z - margin_m),
          size_(glm::ivec2(
              glm::round((glm::vec2(modules_x, modules_z) * module_m + 2.0F * margin_m) / cell_m))),
          radius_m_(radius_m), state_(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y), free)
    {
    }

    /// Nobody's middle comes nearer to the rectangle than the walker's radius.
    void fill(const glm::vec2& low_m, const glm::vec2& high_m)
    {
        const glm::vec2 grow(radius_m_);
        const glm::ivec2 first = glm::max(glm::ivec2(glm::floor((low_m - grow - low_m_) / cell_m)), 0);
        const glm::ivec2 last = glm::min(glm::ivec2(glm::ceil((high_m + grow - low_m_) / cell_m)), size_);
        for (int z = first.y; z < last.y; ++z) {
            for (int x = first.x; x < last.x; ++x) {
                state_[index({x, z})] = blocked;
            }
        }
    }

    [[nodiscard]] std::vector<glm::vec2> way(const glm::vec2& from_m, const glm::vec2& to_m)
    {
        const glm::ivec2 start((to_m - low_m_) / cell_m);
        const glm::ivec2 goal((from_m - low_m_) / cell_m);
        std::queue<glm::ivec2> next;
        const auto reach = [&](const glm::ivec2& cell, int from) {
            if (glm::all(glm::greaterThanEqual(cell, glm::ivec2(0))) &&
                glm::all(glm::lessThan(cell, size_)) && state_[index(cell)] == free) {
                state_[index(cell)] = from;
                next.push(cell);
            }
        };
        constexpr glm::ivec2 steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        reach(start, 4);
        while (!next.empty() && next.front() != goal) {
            const glm::ivec2 here = next.front();
            next.pop();
            for (int k = 0; k < 4; ++k) {
                reach(here + steps[k], k);
            }
        }
        std::vector<glm::vec2> way;
        if (next.empty()) {
            return way;
        }
        // Every cell knows by which step it was come upon, from the goal's side.
        for (glm::ivec2 here = goal;; here -= steps[state_[index(here)]]) {
            way.push_back(low_m_ + cell_m * (glm::vec2(here) + 0.5F));
            if (here == start) {
                return way;
            }
        }
    }

private:
    static constexpr int free = -1;
    static constexpr int blocked = -2;

    [[nodiscard]] size_t index(const glm::ivec2& cell) const
    {
        return static_cast<size_t>(cell.y) * static_cast<size_t>(size_.x) + static_cast<size_t>(cell.x);
    }

    glm::vec2 low_m_;
    glm::ivec2 size_;
    float radius_m_;
    std::vector<int> state_;
};

} // namespace

std::vector<glm::vec2> find_way(const Plan& plan, float radius_m)
{
    Floor floor(radius_m);
    for (const WallRun& wall : plan.walls) {
        const glm::vec2 half(0.5F * wall.thickness_m);
        const glm::vec2 low = glm::min(wall.from_m, wall.to_m) - half;
        const glm::vec2 high = glm::max(wall.from_m, wall.to_m) + half;
        if (!wall.door || plan.doors[*wall.door].is_barred) {
            floor.fill(low, high);
            continue;
        }
        const Door& door = plan.doors[*wall.door];
        const glm::vec2 along = wall.is_along_x ? glm::vec2(1.0F, 0.0F) : glm::vec2(0.0F, 1.0F);
        const glm::vec2 across(along.y, along.x);
        floor.fill(low, door.place_m - door.half_m * along + half * across);
        floor.fill(door.place_m + door.half_m * along - half * across, high);
    }
    for (const Post& post : plan.posts) {
        floor.fill(post.place_m - post_half_m, post.place_m + post_half_m);
    }
    for (const PlacedColumn& column : plan.columns) {
        const float half_m = foot_half_m(column.column);
        floor.fill(column.place_m - half_m, column.place_m + half_m);
    }
    const Door& portal = plan.doors.front();
    return floor.way(portal.place_m + glm::vec2(0.0F, 2.0F),
                     plan.rooms[static_cast<size_t>(plan.last_room)].middle_m());
}

} // namespace temple
