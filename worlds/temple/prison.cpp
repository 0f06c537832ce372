// SPDX-License-Identifier: MIT
#include "prison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>

#include "wall.hpp"

namespace temple {
namespace {

/// Returns a function that gives the height of a ruined wall without a roof, by the position along the wall.
std::function<float(float)> ruined_top(float height_m, float deep, Dice& dice)
{
    const float phase = 6.0F * dice.share();
    return [=](float x_m) {
        const float wave = std::sin(0.55F * x_m + phase) + 0.5F * std::sin(1.31F * x_m + 2.0F * phase);
        return height_m * (1.0F - deep * std::max(0.0F, 0.35F + 0.65F * wave));
    };
}

bool stands_open(const Plan& plan, const WallRun& wall)
{
    const auto is_open = [&](int room) {
        return room == outside || !plan.rooms[static_cast<size_t>(room)].is_roofed();
    };
    return is_open(wall.a) && is_open(wall.b);
}

/// Place where the stones of a wall begin, at the edge of a pier.
glm::vec2 beginning_of(const WallRun& run)
{
    return run.from_m + 0.8F * post_half_m * glm::normalize(run.to_m - run.from_m);
}

Wall wall_of(const Plan& plan, const WallRun& run, Dice& dice)
{
    Wall wall{.length_m = glm::distance(run.from_m, run.to_m) - 1.6F * post_half_m,
              .height_m = run.height_m,
              .thickness_m = run.thickness_m,
              .foot_m = -5.0F};
    if (run.door) {
        const Door& door = plan.doors[*run.door];
        wall.arches.push_back({.x_m = 0.5F * wall.length_m,
                               .half_m = door.half_m,
                               .springing_m = door.springing_m,
                               .ring_m = door.is_arched ? 0.3F + 0.16F * door.half_m : 0.0F});
    }
    if (stands_open(plan, run)) {
        wall.top_m = ruined_top(run.height_m, dice.between(0.25F, 0.5F), dice);
        // Of an outer wall, only the parapet (its top edge) is damaged.
    } else if (run.a == outside || run.b == outside) {
        wall.top_m = ruined_top(run.height_m, 1.3F / run.height_m, dice);
    }
    return wall;
}

Kit build_run(const Plan& plan, const WallRun& run, Dice dice)
{
    const Wall wall = wall_of(plan, run, dice);
    // Walls are built along +x; a wall along z begins at its end with the greater z.
    const glm::vec2 from = beginning_of(run);
    Kit kit;
    kit.add(build_wall(wall, lay(wall, dice), dice),
            at({from.x, floor_m, from.y}, run.is_along_x ? 0.0F : 90.0F));
    return kit;
}

void add_post(Kit& kit, const Post& post, Dice& dice)
{
    const Wall pier{.length_m = 2.0F * post_half_m,
                    .height_m = post.height_m,
                    .thickness_m = 2.0F * post_half_m,
                    .foot_m = -5.0F,
                    .course_m = 0.7F,
                    .stone_m = 2.0F};
    kit.add(build_wall(pier, lay(pier, dice), dice),
            at({post.place_m.x - post_half_m, floor_m, post.place_m.y}));
}

/// Adds the floor of a room: flagstones in rows. Only a few of their joints are drawn.
void add_floor(Kit& kit, const Room& room, Dice& dice)
{
    const glm::vec2 low = room.low_m();
    const glm::vec2 high = room.high_m();
    constexpr float row_m = 1.5F;
    for (float z = low.y; z < high.y - 0.01F; z += row_m) {
        float x = low.x;
        while (x < high.x - 0.01F) {
            const float to = high.x - x < 2.2F ? high.x : std::min(high.x, x + dice.between(1.2F, 2.1F));
            const std::array<glm::vec3, 4> flag{
                {{x, floor_m, z + row_m}, {to, floor_m, z + row_m}, {to, floor_m, z}, {x, floor_m, z}}};
            const glm::vec3 normal =
                glm::normalize(glm::vec3(dice.between(-0.03F, 0.03F), 1.0F, dice.between(-0.03F, 0.03F)));
            const uint32_t drawn = (dice.chance(0.3F) ? 1U : 0U) | (dice.chance(0.3F) ? 2U : 0U);
            kit.add_face(Stuff::paving, flag, normal,
                         {{1, 0, 0}, {0, 0, -1}, {dice.between(0.0F, 8.0F), 0.0F}}, drawn);
            x = to;
        }
    }
}

/// Adds the roof of a room: flat stone slabs, with a hole for light if `shaft` is set.
void add_roof(Kit& kit, const Room& room, std::optional<glm::vec2> shaft)
{
    constexpr float thick_m = 0.5F;
    const glm::vec2 low = room.low_m();
    const glm::vec2 high = room.high_m();
    const float y = floor_m + room.height_m;
    const auto slab = [&](float x0, float z0, float x1, float z1) {
        add_block(kit, Stuff::stone, {x0, y, z0}, {x1, y + thick_m, z1});
    };
    if (!shaft) {
        slab(low.x, low.y, high.x, high.y);
        return;
    }
    const glm::vec2 from = *shaft - shaft_half_m;
    const glm::vec2 to = *shaft + shaft_half_m;
    slab(low.x, low.y, high.x, from.y);
    slab(low.x, to.y, high.x, high.y);
    slab(low.x, from.y, from.x, to.y);
    slab(to.x, from.y, high.x, to.y);
}

/// Adds the beams of a room, which lie on its columns and reach from wall to wall.
void add_beams(Kit& kit, const Plan& plan, int index)
{
    const Room& room = plan.rooms[static_cast<size_t>(index)];
    const glm::vec2 size = room.high_m() - room.low_m();
    const bool is_along_x = size.x >= size.y;
    std::vector<float> lines;
    for (const PlacedColumn& placed : plan.columns) {
        const float line = is_along_x ? placed.place_m.y : placed.place_m.x;
        if (placed.room == index &&
            std::ranges::none_of(lines, [&](float other) { return std::abs(other - line) < 0.5F; })) {
            lines.push_back(line);
        }
    }
    const float top = floor_m + room.height_m;
    constexpr float half_m = 0.42F;
    for (const float line : lines) {
        const glm::vec3 low = is_along_x ? glm::vec3(room.low_m().x, top - 0.56F, line - half_m)
                                         : glm::vec3(line - half_m, top - 0.56F, room.low_m().y);
        const glm::vec3 high = is_along_x ? glm::vec3(room.high_m().x, top, line + half_m)
                                          : glm::vec3(line + half_m, top, room.high_m().y);
        add_block(kit, Stuff::stone, low, high);
    }
}

/// Adds a barrel vault below the roof of a corridor, along its length.
void add_vault(Kit& kit, const Room& room, Dice& dice)
{
    const glm::vec2 size = room.high_m() - room.low_m();
    const bool is_along_x = size.x > size.y;
    const float length_m = is_along_x ? size.x : size.y;
    const float half_m = 0.5F * module_m - 0.4F;
    const float springing_m = floor_m + room.height_m - half_m * 0.78F;
    const glm::vec2 middle = room.middle_m();
    constexpr int stones = 11;
    const int rows = static_cast<int>(std::lround(length_m / 1.5F));
    for (int row = 0; row < rows; ++row) {
        const float from = length_m * (static_cast<float>(row) / static_cast<float>(rows) - 0.5F);
        const float to = length_m * (static_cast<float>(row + 1) / static_cast<float>(rows) - 0.5F);
        for (int k = 0; k < stones; ++k) {
            const auto spot = [&](int step, float along) {
                const float angle = std::numbers::pi_v<float> * static_cast<float>(step) / stones;
                const float across = half_m * std::cos(angle);
                const float y = springing_m + 0.76F * half_m * std::sin(angle);
                return is_along_x ? glm::vec3(middle.x + along, y, middle.y - across)
                                  : glm::vec3(middle.x + across, y, middle.y + along);
            };
            const std::array<glm::vec3, 4> face{
                {spot(k, from), spot(k, to), spot(k + 1, to), spot(k + 1, from)}};
            const glm::vec3 normal = glm::normalize(glm::cross(face[1] - face[0], face[3] - face[0]));
            const glm::vec3 along = glm::normalize(face[1] - face[0]);
            kit.add_face(Stuff::stone, face, normal,
                         {along, glm::normalize(face[3] - face[0]), {dice.between(0.0F, 8.0F), 0.0F}},
                         (dice.chance(0.3F) ? 2U : 0U) | (dice.chance(0.35F) ? 4U : 0U));
        }
    }
}

void add_bars(Kit& kit, const Plan& plan, const Door& door)
{
    const auto wall = std::ranges::find_if(
        plan.walls, [&](const WallRun& run) { return run.door && &plan.doors[*run.door] == &door; });
    const glm::vec2 along = wall->is_along_x ? glm::vec2(1, 0) : glm::vec2(0, 1);
    const float top_m = floor_m + door.springing_m;
    constexpr int bars = 6;
    for (int i = 0; i < bars; ++i) {
        const float share = (static_cast<float>(i) + 0.5F) / bars * 2.0F - 1.0F;
        const glm::vec2 foot = door.place_m + share * door.half_m * along;
        kit.add(Stuff::iron, rod({foot.x, floor_m, foot.y}, {foot.x, top_m, foot.y}, 0.035F, 0.035F, 6, 3));
    }
    for (const float height_m : {0.35F, 0.62F}) {
        const glm::vec2 from = door.place_m - door.half_m * along;
        const glm::vec2 to = door.place_m + door.half_m * along;
        const float y = glm::mix(floor_m, top_m, height_m);
        kit.add(Stuff::iron, rod({from.x, y, from.y}, {to.x, y, to.y}, 0.04F, 0.04F, 6, 3));
    }
}

} // namespace

std::optional<glm::vec2> shaft_of(const Plan& plan, int room)
{
    const Room& asked = plan.rooms[static_cast<size_t>(room)];
    if (asked.kind != RoomKind::last && asked.kind != RoomKind::hall) {
        return std::nullopt;
    }
    return asked.middle_m();
}

std::vector<Thing> build_prison(const Plan& plan, uint64_t seed)
{
    std::vector<Thing> things;
    Thing& walls = things.emplace_back(Thing{.name = "walls"});
    for (size_t i = 0; i < plan.walls.size(); ++i) {
        walls.kit.add(build_run(plan, plan.walls[i], Dice(seed, 1000 + i)));
    }
    Dice dice(seed, 2);
    Kit posts;
    for (const Post& post : plan.posts) {
        add_post(posts, post, dice);
    }
    things.push_back({.name = "piers", .kit = std::move(posts)});
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        const Room& room = plan.rooms[i];
        Kit kit;
        add_floor(kit, room, dice);
        if (room.is_roofed()) {
            add_roof(kit, room, shaft_of(plan, static_cast<int>(i)));
            add_beams(kit, plan, static_cast<int>(i));
        }
        if (room.kind == RoomKind::corridor) {
            add_vault(kit, room, dice);
        }
        for (const PlacedColumn& placed : plan.columns) {
            if (placed.room == static_cast<int>(i)) {
                kit.add(build_column(placed.column), at({placed.place_m.x, floor_m, placed.place_m.y}));
            }
        }
        things.push_back({.name = "room " + std::to_string(i), .kit = std::move(kit)});
    }
    Kit bars;
    for (const Door& door : plan.doors) {
        if (door.is_barred) {
            add_bars(bars, plan, door);
        }
    }
    things.push_back({.name = "bars", .kit = std::move(bars)});
    return things;
}

namespace {

/// A slit between a ruined wall and the roof beside it, from end to end of the missing stones.
struct Slit {
    float first_m, last_m; ///< places along the wall
    float lowest_m;        ///< top of the lowest stone, above the floor
};

std::optional<Slit> slit_below(float roof_m, const Wall& wall, const Laid& laid)
{
    constexpr float step_m = 0.1F;
    std::optional<Slit> slit;
    for (float x_m = 0.0F; x_m < wall.length_m; x_m += step_m) {
        float top_m = 0.0F;
        for (const std::vector<Stone>& course : laid.courses) {
            for (const Stone& stone : course) {
                top_m = x_m >= stone.left_m && x_m <= stone.right_m ? std::max(top_m, stone.high_m) : top_m;
            }
        }
        if (top_m < roof_m) {
            slit = slit ? Slit{slit->first_m, x_m + step_m, std::min(slit->lowest_m, top_m)}
                        : Slit{x_m - step_m, x_m + step_m, top_m};
        }
    }
    return slit;
}

} // namespace

void add_cells(const Plan& plan, uint64_t seed, estampe::Scene& scene)
{
    // The walls' feet and the ground below the floor lie in the cells, the slabs of the roofs above them.
    constexpr float foot_m = floor_m - 6.0F;
    constexpr float wider_m = 0.1F; // the stones beside an opening are not quite flush
    std::vector<estampe::Index> cell_of_room;
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        const Room& room = plan.rooms[i];
        cell_of_room.push_back(room.is_roofed() ? static_cast<estampe::Index>(scene.cells.size())
                                                : estampe::no_index);
        if (room.is_roofed()) {
            const glm::vec2 low = room.low_m();
            const glm::vec2 high = room.high_m();
            scene.cells.push_back({.name = "room " + std::to_string(i),
                                   .low_m = {low.x, foot_m, low.y},
                                   .high_m = {high.x, floor_m + room.height_m, high.y}});
        }
    }
    const auto cell_of = [&](int room) {
        return room == outside ? estampe::no_index : cell_of_room[static_cast<size_t>(room)];
    };
    const auto add = [&](estampe::Index from, estampe::Index to, const glm::vec3& corner,
                         const glm::vec3& along, const glm::vec3& up) {
        if (from != to) {
            scene.portals.push_back({.corners_m = {corner, corner + along, corner + along + up, corner + up},
                                     .from = from,
                                     .to = to});
        }
    };
    for (size_t i = 0; i < plan.walls.size(); ++i) {
        const WallRun& wall = plan.walls[i];
        const int room = std::max(wall.a, wall.b);
        if (std::min(wall.a, wall.b) == outside && plan.rooms[static_cast<size_t>(room)].is_roofed()) {
            const float roof_m = plan.rooms[static_cast<size_t>(room)].height_m;
            Dice dice(seed, 1000 + i);
            const Wall built = wall_of(plan, wall, dice);
            if (const auto slit = slit_below(roof_m, built, lay(built, dice))) {
                const glm::vec2 way = glm::normalize(wall.to_m - wall.from_m);
                const glm::vec2 from = beginning_of(wall) + slit->first_m * way;
                const float low_m = slit->lowest_m - wider_m;
                const glm::vec2 along = (slit->last_m - slit->first_m) * way;
                add(cell_of(room), estampe::no_index, {from.x, floor_m + low_m, from.y},
                    {along.x, 0.0F, along.y}, {0.0F, roof_m - low_m, 0.0F});
            }
        }
        if (wall.door) {
            const Door& door = plan.doors[*wall.door];
            const glm::vec3 along = wall.is_along_x ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
            const float half_m = door.half_m + wider_m;
            const float crown_m =
                floor_m + door.springing_m + (door.is_arched ? door.half_m : 0.0F) + wider_m;
            add(cell_of(door.a), cell_of(door.b),
                glm::vec3(door.place_m.x, foot_m, door.place_m.y) - half_m * along, 2.0F * half_m * along,
                {0.0F, crown_m - foot_m, 0.0F});
        }
    }
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        if (const auto shaft = shaft_of(plan, static_cast<int>(i))) {
            const float half_m = shaft_half_m + wider_m;
            add(cell_of_room[i], estampe::no_index,
                {shaft->x - half_m, floor_m + plan.rooms[i].height_m, shaft->y - half_m},
                {2.0F * half_m, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F * half_m});
        }
    }
}

namespace {

/// In visibility tests, a door is wider than it is by this length on either side.
constexpr float wider_m = 0.8F;
constexpr float within_m = 1.2F; ///< An eye within this distance of a door counts as being in both rooms
constexpr float above_m = 5.0F;  ///< An eye at this height above the floor sees the roofs from above
/// Distance within which an eye above the roofs looks through the holes in them.
constexpr float around_m = 60.0F;

float cross(const glm::vec2& a, const glm::vec2& b)
{
    return a.x * b.y - a.y * b.x;
}

/// A doorway of a room, as the line between the two sides of the opening.
struct Portal {
    int to = outside;
    glm::vec2 from_m{0.0F}, to_m{0.0F};
};

/// The range of directions from `first` counter-clockwise to `last`, less than half a turn.
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

    /// Finds everything that is visible from inside a room, or from outdoors.
    void look_around(int room) { look(room, std::nullopt); }

    [[nodiscard]] const std::vector<bool>& seen() const { return seen_; }

private:
    /// Returns the room in which an eye counts as standing. The result is `outside` for a room without a
    /// roof.
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
                return; // A straight line of sight enters a room only once
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
    std::vector<bool> is_passed_; ///< Rooms through which the current line of sight has passed
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
