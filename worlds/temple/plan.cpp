// SPDX-License-Identifier: MIT
#include "plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "kit.hpp"

namespace temple {
namespace {

constexpr float left_x_m = -0.5F * module_m * modules_x;

glm::vec2 corner_m(glm::ivec2 module)
{
    return {left_x_m + module_m * static_cast<float>(module.x),
            front_z_m - module_m * static_cast<float>(module.y)};
}

/// Divides the prison's ground into rooms: covers free squares of the floor plan with rectangles.
class Divider {
public:
    explicit Divider(Dice& dice) : dice_(dice) { taken_.fill(false); }

    void take(RoomKind kind, glm::ivec2 first, glm::ivec2 size)
    {
        rooms_.push_back({.kind = kind, .first = first, .last = first + size});
        for (int z = first.y; z < first.y + size.y; ++z) {
            for (int x = first.x; x < first.x + size.x; ++x) {
                taken_[index({x, z})] = true;
            }
        }
    }

    void fill()
    {
        constexpr std::array<glm::ivec2, 10> sizes{
            {{1, 1}, {1, 1}, {1, 1}, {1, 3}, {3, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 2}, {2, 3}}};
        for (int z = 0; z < modules_z; ++z) {
            for (int x = 0; x < modules_x; ++x) {
                if (taken_[index({x, z})]) {
                    continue;
                }
                glm::ivec2 size = sizes[static_cast<size_t>(dice_.below(static_cast<int>(sizes.size())))];
                while (!is_free({x, z}, size)) {
                    (size.x > size.y ? size.x : size.y) -= 1;
                }
                take(kind_of(size), {x, z}, size);
            }
        }
    }

    [[nodiscard]] std::vector<Room> rooms() const { return rooms_; }

private:
    [[nodiscard]] static size_t index(glm::ivec2 module)
    {
        return static_cast<size_t>(module.y * modules_x + module.x);
    }

    [[nodiscard]] bool is_free(glm::ivec2 first, glm::ivec2 size) const
    {
        for (int z = first.y; z < first.y + size.y; ++z) {
            for (int x = first.x; x < first.x + size.x; ++x) {
                if (x >= modules_x || z >= modules_z || taken_[index({x, z})]) {
                    return false;
                }
            }
        }
        return true;
    }

    [[nodiscard]] RoomKind kind_of(glm::ivec2 size)
    {
        if (size == glm::ivec2(1)) {
            return RoomKind::cell;
        }
        if (size.x == 1 || size.y == 1) {
            return RoomKind::corridor;
        }
        return dice_.chance(0.3F) ? RoomKind::fallen : RoomKind::hall;
    }

    Dice& dice_;
    std::array<bool, static_cast<size_t>(modules_x) * modules_z> taken_{};
    std::vector<Room> rooms_;
};

float height_of(const Room& room, Dice& dice)
{
    switch (room.kind) {
    case RoomKind::entrance:
        return 7.0F;
    case RoomKind::last:
        return 9.5F;
    case RoomKind::hall:
        return dice.between(5.2F, 6.8F);
    case RoomKind::fallen:
        return dice.between(4.2F, 5.6F);
    case RoomKind::corridor:
        return 6.3F;
    case RoomKind::cell:
        return 3.6F;
    }
    return 4.0F;
}

/// Finds all straight pieces of wall, each between the same two rooms.
std::vector<WallRun> find_walls(const Plan& plan)
{
    std::vector<WallRun> walls;
    // The loop's first pass takes the lines of the floor plan's grid along x, the second pass takes the lines
    // along z.
    for (const bool is_along_x : {true, false}) {
        const int lines = is_along_x ? modules_z : modules_x;
        const int steps = is_along_x ? modules_x : modules_z;
        for (int line = 0; line <= lines; ++line) {
            for (int step = 0; step < steps;) {
                const auto sides = [&](int s) {
                    const glm::ivec2 after = is_along_x ? glm::ivec2(s, line) : glm::ivec2(line, s);
                    const glm::ivec2 before = after - (is_along_x ? glm::ivec2(0, 1) : glm::ivec2(1, 0));
                    return std::pair(plan.room_at(before), plan.room_at(after));
                };
                const auto pair = sides(step);
                int end = step + 1;
                while (end < steps && sides(end) == pair) {
                    ++end;
                }
                if (pair.first != pair.second) {
                    WallRun run{.a = pair.first, .b = pair.second, .is_along_x = is_along_x};
                    run.from_m = corner_m(is_along_x ? glm::ivec2(step, line) : glm::ivec2(line, step));
                    run.to_m = corner_m(is_along_x ? glm::ivec2(end, line) : glm::ivec2(line, end));
                    const bool is_outer = run.a == outside || run.b == outside;
                    for (const int room : {run.a, run.b}) {
                        if (room != outside) {
                            run.height_m =
                                std::max(run.height_m, plan.rooms[static_cast<size_t>(room)].height_m);
                        }
                    }
                    run.height_m += is_outer ? 1.3F : 0.5F;
                    run.thickness_m = is_outer ? 1.2F : 0.9F;
                    walls.push_back(run);
                }
                step = end;
            }
        }
    }
    return walls;
}

bool is_cell(const Plan& plan, int room)
{
    return plan.rooms[static_cast<size_t>(room)].kind == RoomKind::cell;
}

Door door_in(const Plan& plan, const WallRun& wall)
{
    Door door{.a = wall.a, .b = wall.b, .place_m = 0.5F * (wall.from_m + wall.to_m)};
    if (wall.a == outside || wall.b == outside) { // The only door in an outer wall is the portal
        door.half_m = 1.9F;
        door.springing_m = 3.4F;
    } else if (is_cell(plan, wall.a) || is_cell(plan, wall.b)) {
        door.half_m = 0.75F;
        door.is_arched = false;
    } else {
        const float lower_m = std::min(plan.rooms[static_cast<size_t>(wall.a)].height_m,
                                       plan.rooms[static_cast<size_t>(wall.b)].height_m);
        door.half_m = lower_m > 5.0F ? 1.5F : 1.15F;
        door.springing_m = lower_m > 5.0F ? 2.5F : 2.1F;
    }
    return door;
}

/// Opens doors in walls. Some doors join all rooms into a random spanning tree (Kruskal), so that each room
/// can be reached. A few more doors close loops.
void open_doors(Plan& plan, Dice& dice)
{
    struct Choice {
        float weight;
        size_t wall;
    };

    std::vector<Choice> choices;
    for (size_t i = 0; i < plan.walls.size(); ++i) {
        const WallRun& wall = plan.walls[i];
        if (wall.a == outside || wall.b == outside) {
            const bool is_portal =
                wall.is_along_x && std::max(wall.a, wall.b) == 0 && wall.from_m.y > front_z_m - 0.1F;
            if (is_portal) {
                plan.walls[i].door = plan.doors.size();
                plan.doors.push_back(door_in(plan, wall));
            }
            continue;
        }
        // Cells have no doors to other cells, and the last hall has few doors.
        const bool is_last = wall.a == plan.last_room || wall.b == plan.last_room;
        const int cells = (is_cell(plan, wall.a) ? 1 : 0) + (is_cell(plan, wall.b) ? 1 : 0);
        choices.push_back({dice.share() + 2.0F * static_cast<float>(cells) + (is_last ? 1.0F : 0.0F), i});
    }
    std::ranges::sort(choices, {}, &Choice::weight);
    std::vector<int> group(plan.rooms.size());
    std::iota(group.begin(), group.end(), 0);
    for (const Choice& choice : choices) {
        WallRun& wall = plan.walls[choice.wall];
        const int a = group[static_cast<size_t>(wall.a)];
        const int b = group[static_cast<size_t>(wall.b)];
        const bool is_ring = a == b;
        if (is_ring && (choice.weight > 0.3F || dice.chance(0.5F))) {
            continue;
        }
        wall.door = plan.doors.size();
        plan.doors.push_back(door_in(plan, wall));
        std::ranges::replace(group, b, a);
    }
    // A cell may be shut if no other room is reached through it.
    std::map<int, int> ways;
    for (const Door& door : plan.doors) {
        ++ways[door.a];
        ++ways[door.b];
    }
    for (Door& door : plan.doors) {
        for (const int room : {door.a, door.b}) {
            if (room != outside && is_cell(plan, room) && ways[room] == 1) {
                door.is_barred = dice.chance(0.7F);
            }
        }
    }
}

/// Finds the piers. A pier stands at each end of a wall, and is as high as the highest wall that ends there.
std::vector<Post> find_posts(const std::vector<WallRun>& walls)
{
    std::map<std::pair<float, float>, float> heights;
    for (const WallRun& wall : walls) {
        for (const glm::vec2& end : {wall.from_m, wall.to_m}) {
            float& height = heights[{end.x, end.y}];
            height = std::max(height, wall.height_m + 0.15F);
        }
    }
    std::vector<Post> posts;
    posts.reserve(heights.size());
    for (const auto& [place, height] : heights) {
        posts.push_back({{place.first, place.second}, height});
    }
    return posts;
}

void stand_columns(Plan& plan, Dice& dice)
{
    constexpr float apart_m = 5.5F;
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        const Room& room = plan.rooms[i];
        const glm::vec2 size = room.high_m() - room.low_m();
        if (std::min(size.x, size.y) < 1.5F * module_m) {
            continue;
        }
        const int count_x = std::max(2, static_cast<int>(std::lround(size.x / apart_m)));
        const int count_z = std::max(2, static_cast<int>(std::lround(size.y / apart_m)));
        const float ruin = room.kind == RoomKind::fallen ? 0.9F : 0.12F;
        for (int z = 0; z < count_z; ++z) {
            for (int x = 0; x < count_x; ++x) {
                const glm::vec2 share((static_cast<float>(x) + 0.5F) / static_cast<float>(count_x),
                                      (static_cast<float>(z) + 0.5F) / static_cast<float>(count_z));
                PlacedColumn placed{.place_m = room.low_m() + share * size, .room = static_cast<int>(i)};
                placed.column =
                    throw_column(dice, 0.46F + 0.02F * room.height_m, room.height_m - 0.55F, ruin);
                placed.column.lean_deg *= room.is_roofed() ? 0.0F : 1.0F;
                plan.columns.push_back(placed);
            }
        }
    }
}

} // namespace

glm::vec2 Room::low_m() const
{
    return {corner_m(first).x, corner_m(last).y};
}

glm::vec2 Room::high_m() const
{
    return {corner_m(last).x, corner_m(first).y};
}

int Plan::room_at(glm::ivec2 module) const
{
    for (size_t i = 0; i < rooms.size(); ++i) {
        if (glm::all(glm::greaterThanEqual(module, rooms[i].first)) &&
            glm::all(glm::lessThan(module, rooms[i].last))) {
            return static_cast<int>(i);
        }
    }
    return outside;
}

Plan make_plan(uint64_t seed)
{
    Dice dice(seed, 1);
    Plan plan;
    Divider divider(dice);
    divider.take(RoomKind::entrance, {3, 0}, {2, 2});
    divider.take(RoomKind::last, {dice.below(modules_x - 3), modules_z - 2}, {4, 2});
    plan.last_room = 1;
    divider.fill();
    plan.rooms = divider.rooms();
    for (Room& room : plan.rooms) {
        room.height_m = height_of(room, dice);
    }
    plan.walls = find_walls(plan);
    open_doors(plan, dice);
    plan.posts = find_posts(plan.walls);
    stand_columns(plan, dice);
    return plan;
}

namespace {

constexpr float cell_m = 0.25F;
constexpr float margin_m = 4.0F; ///< Width of the free ground around the prison

/// The floors of the prison as a grid of free and blocked squares, for finding a path.
class Floor {
public:
    explicit Floor(float radius_m)
        : low_m_(-0.5F * module_m * modules_x - margin_m, front_z_m - module_m * modules_z - margin_m),
          size_(glm::ivec2(
              glm::round((glm::vec2(modules_x, modules_z) * module_m + 2.0F * margin_m) / cell_m))),
          radius_m_(radius_m), state_(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y), free)
    {
    }

    /// Blocks the squares in a rectangle and in a margin of the walker's radius around it.
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
        // Follows the path backwards: for each square, `state_` says by which step the search reached the
        // square from the goal.
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
