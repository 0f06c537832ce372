// SPDX-License-Identifier: MIT
#pragma once

// The floor plan of the prison: which rooms are adjacent, where doors lead, where columns stand. The floor
// plan contains only numbers, no meshes.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "column.hpp"

namespace temple {

/// Side of the floor plan's squares; length and width of rooms are whole multiples of this side.
inline constexpr float module_m = 6.0F;
inline constexpr int modules_x = 8;
inline constexpr int modules_z = 6;
inline constexpr float floor_m = 1.2F; ///< Height of all floors of the prison above the court
/// Z coordinate of the prison's front wall. The rooms of the prison have smaller z coordinates.
inline constexpr float front_z_m = -27.0F;
inline constexpr float post_half_m = 0.7F; ///< Half the width of the piers where walls meet

enum class RoomKind : uint8_t {
    entrance,
    hall,
    corridor,
    cell,
    fallen, ///< A room whose roof has collapsed, with sand in it
    last,   ///< The last hall, which is the visitor's destination
};

/// A room of the prison: a rectangle of modules (squares of the floor plan); `last` is the first square
/// beyond the room.
struct Room {
    RoomKind kind = RoomKind::hall;
    glm::ivec2 first{0}, last{0};
    float height_m = 4.0F;

    [[nodiscard]] glm::vec2 low_m() const;  ///< Corner of the room with the smallest x and z
    [[nodiscard]] glm::vec2 high_m() const; ///< Corner of the room with the largest x and z

    [[nodiscard]] glm::vec2 middle_m() const { return 0.5F * (low_m() + high_m()); }

    [[nodiscard]] bool is_roofed() const { return kind != RoomKind::fallen; }
};

inline constexpr int outside = -1;

/// A doorway through a wall.
struct Door {
    int a = outside, b = outside; ///< The two rooms that the door joins
    glm::vec2 place_m{0.0F};
    float half_m = 1.0F;
    float springing_m = 2.2F;
    bool is_arched = true;
    bool is_barred = false; ///< A grating still closes the door of this cell
};

/// A wall between two rooms or around the prison, along x or z.
struct WallRun {
    int a = outside, b = outside;
    glm::vec2 from_m{0.0F}, to_m{0.0F}; ///< Both ends of the wall, from pier to pier
    bool is_along_x = true;
    float height_m = 4.0F;
    float thickness_m = 0.9F;
    std::optional<size_t> door;
};

/// A pier at the corner of rooms.
struct Post {
    glm::vec2 place_m{0.0F};
    float height_m = 4.0F;
};

struct PlacedColumn {
    glm::vec2 place_m{0.0F};
    int room = 0;
    Column column;
};

struct Plan {
    std::vector<Room> rooms; ///< Rooms of the prison; the first is the entrance
    std::vector<Door> doors; ///< Doors of the prison; the first is the portal
    std::vector<WallRun> walls;
    std::vector<Post> posts;
    std::vector<PlacedColumn> columns;
    int last_room = 0;

    /// Returns the index of the room that contains a square of the floor plan.
    [[nodiscard]] int room_at(glm::ivec2 module) const;
};

[[nodiscard]] Plan make_plan(uint64_t seed);

/// Finds a path for a walker of radius `radius_m` from the portal to the middle of the last hall, on a grid
/// of a quarter of a metre; empty if there is no path.
[[nodiscard]] std::vector<glm::vec2> find_way(const Plan& plan, float radius_m = 0.35F);

} // namespace temple
