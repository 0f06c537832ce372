// SPDX-License-Identifier: MIT
#include "site.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

#include "wall.hpp"

namespace temple {
namespace {

namespace shapes = estampe::shapes;

void add_egg(Kit& kit, const glm::mat4& placed, const glm::vec3& half_m)
{
    kit.add(Stuff::marble, shapes::sphere(1.0F, 36, 22), glm::scale(placed, half_m));
}

void limb(Kit& kit, const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b)
{
    kit.add(Stuff::marble, rod(a, b, radius_a, radius_b, 24, 3));
}

/// Builds a statue: a giant on a throne, broken off at the chest; the rest is about 9 m high.
Kit build_seated(Dice dice)
{
    Kit kit;
    add_block(kit, Stuff::stone, {-3.4F, -4.0F, -4.2F}, {3.4F, 0.9F, 4.6F});
    add_block(kit, Stuff::marble, {-2.7F, 0.9F, -3.8F}, {2.7F, 4.6F, 0.9F});
    add_block(kit, Stuff::marble, {-2.7F, 4.6F, -3.8F}, {2.7F, 8.2F + dice.between(-0.6F, 0.6F), -2.9F});
    for (const float side : {-1.0F, 1.0F}) {
        const float x = 1.25F * side;
        limb(kit, {x, 5.3F, -1.6F}, {x, 5.1F, 2.3F}, 1.05F, 0.85F);
        limb(kit, {x, 4.9F, 2.45F}, {x, 1.5F, 2.6F}, 0.85F, 0.5F);
        limb(kit, {x, 1.35F, 2.5F}, {x, 1.2F, 4.0F}, 0.42F, 0.32F);
        add_block(kit, Stuff::marble, {side > 0 ? 2.7F : -3.3F, 0.9F, -3.8F},
                  {side > 0 ? 3.3F : -2.7F, 6.3F, 1.6F});
    }
    // The lower part of the statue's trunk, and one forearm on its armrest.
    limb(kit, {0.0F, 5.6F, -1.9F}, {0.0F, 8.0F, -2.1F}, 1.7F, 1.5F);
    limb(kit, {0.0F, 8.3F, -2.1F}, {0.5F, 9.4F, -2.2F}, 1.55F, 0.9F);
    limb(kit, {3.0F, 6.75F, -1.2F}, {3.0F, 6.7F, 1.4F}, 0.5F, 0.4F);
    limb(kit, {3.0F, 6.7F, 1.6F}, {3.0F, 6.6F, 2.2F}, 0.42F, 0.2F);
    return kit;
}

/// Builds the giant's head, an egg with a brow and a nose, and no other features; its centre is on y = 0.
Kit build_head(float radius_m)
{
    Kit kit;
    const float r = radius_m;
    add_egg(kit, glm::mat4(1.0F), {0.8F * r, 1.05F * r, 0.88F * r});
    limb(kit, {0.0F, -0.5F * r, -0.2F * r}, {0.0F, -1.5F * r, -0.25F * r}, 0.44F * r, 0.52F * r);
    limb(kit, {0.0F, 0.12F * r, 0.83F * r}, {0.0F, -0.26F * r, 0.94F * r}, 0.07F * r, 0.13F * r);
    for (const float side : {-1.0F, 1.0F}) {
        limb(kit, {side * 0.1F * r, 0.17F * r, 0.83F * r}, {side * 0.5F * r, 0.12F * r, 0.6F * r}, 0.07F * r,
             0.06F * r);
        limb(kit, {side * 0.78F * r, 0.12F * r, -0.05F * r}, {side * 0.77F * r, -0.2F * r, 0.0F}, 0.11F * r,
             0.08F * r);
    }
    limb(kit, {-0.16F * r, -0.5F * r, 0.75F * r}, {0.16F * r, -0.5F * r, 0.75F * r}, 0.055F * r, 0.055F * r);
    return kit;
}

/// Builds a giant's hand that reaches up out of the ground; it begins at the wrist.
Kit build_hand(float length_m)
{
    Kit kit;
    const float s = length_m;
    limb(kit, {0.0F, -0.9F * s, 0.0F}, {0.0F, 0.05F * s, 0.0F}, 0.2F * s, 0.15F * s);
    glm::mat4 palm = glm::translate(glm::mat4(1.0F), {0.0F, 0.27F * s, 0.0F});
    add_egg(kit, palm, {0.21F * s, 0.29F * s, 0.1F * s});
    const std::array<float, 4> lengths{0.36F, 0.44F, 0.41F, 0.3F};
    for (size_t i = 0; i < lengths.size(); ++i) {
        const float x = (static_cast<float>(i) - 1.5F) * 0.105F * s;
        const float fan = (static_cast<float>(i) - 1.5F) * 0.1F;
        glm::vec3 from{x, 0.46F * s, 0.0F};
        const std::array<float, 3> bends{0.12F, 0.5F, 0.95F};
        for (size_t joint = 0; joint < bends.size(); ++joint) {
            const bool is_lost = i == 3 && joint == 2;
            if (is_lost) {
                continue;
            }
            const float part = lengths[i] * s * (joint == 0 ? 0.45F : joint == 1 ? 0.32F : 0.23F);
            const glm::vec3 to =
                from + part * glm::normalize(glm::vec3(fan, std::cos(bends[joint]), std::sin(bends[joint])));
            const float thick = s * (0.058F - 0.008F * static_cast<float>(joint));
            limb(kit, from, to, thick, thick * 0.92F);
            from = to;
        }
    }
    limb(kit, {0.14F * s, 0.1F * s, 0.02F * s}, {0.3F * s, 0.34F * s, 0.08F * s}, 0.08F * s, 0.062F * s);
    limb(kit, {0.3F * s, 0.34F * s, 0.08F * s}, {0.31F * s, 0.52F * s, 0.16F * s}, 0.06F * s, 0.05F * s);
    return kit;
}

/// Builds a statue: a draped figure on a block, without arms, and perhaps without a head.
Kit build_figure(Dice dice)
{
    Kit kit;
    add_block(kit, Stuff::stone, {-1.1F, -2.0F, -1.1F}, {1.1F, 0.3F, 1.1F});
    add_block(kit, Stuff::stone, {-0.85F, 0.3F, -0.85F}, {0.85F, 1.7F, 0.85F});
    add_block(kit, Stuff::stone, {-1.0F, 1.7F, -1.0F}, {1.0F, 1.95F, 1.0F});
    const std::vector<glm::vec2> robe{{0.0F, 0.0F},  {0.5F, 0.0F},   {0.46F, 0.4F},  {0.38F, 1.1F},
                                      {0.31F, 1.6F}, {0.34F, 1.95F}, {0.39F, 2.25F}, {0.33F, 2.45F},
                                      {0.14F, 2.6F}, {0.0F, 2.62F}};
    estampe::Primitive folds = shapes::lathe(robe, 56, 2.5F);
    // The folds of the figure's robe fall straight, deeper towards the hem.
    for (size_t i = 0; i < folds.positions.size(); ++i) {
        glm::vec3& place = folds.positions[i];
        const float angle = std::atan2(place.x, place.z);
        const float depth = 0.16F * (1.0F - glm::smoothstep(0.2F, 2.0F, place.y));
        const float fold = 1.0F + depth * std::sin(9.0F * angle + 0.6F * place.y);
        place = {place.x * fold * 1.12F, place.y, place.z * fold * 0.86F};
        const float lean = 9.0F * depth * std::cos(9.0F * angle + 0.6F * place.y);
        const glm::vec3 around(std::cos(angle), 0.0F, -std::sin(angle));
        folds.normals[i] = glm::normalize(folds.normals[i] - 0.55F * lean * around);
    }
    const glm::mat4 on_block = at({0.0F, 1.95F, 0.0F}, dice.between(-25.0F, 25.0F));
    kit.add(Stuff::marble, folds, on_block);
    Kit upper;
    limb(upper, {-0.36F, 2.26F, 0.0F}, {-0.42F, 1.95F, 0.02F}, 0.13F, 0.1F);
    limb(upper, {0.36F, 2.26F, 0.0F}, {0.44F, 1.8F, 0.08F}, 0.13F, 0.09F);
    limb(upper, {0.44F, 1.8F, 0.08F}, {0.3F, 1.62F, 0.34F}, 0.09F, 0.07F);
    limb(upper, {0.0F, 2.55F, 0.0F}, {0.0F, 2.72F, 0.02F}, 0.1F, 0.1F);
    if (dice.chance(0.6F)) {
        add_egg(upper, glm::translate(glm::mat4(1.0F), {0.0F, 2.98F, 0.04F}), {0.19F, 0.26F, 0.21F});
    }
    kit.add(upper, on_block);
    return kit;
}

/// Adds the four walls of a tower around the y axis.
void add_shell(Kit& kit, const Wall& side, float half_m, Dice dice)
{
    for (int i = 0; i < 4; ++i) {
        Wall wall = side;
        if (side.top_m) {
            wall.top_m = [top = side.top_m, i](float x_m) {
                return top(x_m + 17.0F * static_cast<float>(i));
            };
        }
        Kit standing = build_wall(wall, lay(wall, dice), dice);
        const float turn = 90.0F * static_cast<float>(i);
        kit.add(standing, at({}, turn) * at({-0.5F * side.length_m, 0.0F, half_m}));
    }
}

void add_ring(Kit& kit, float radius_m, float foot_m, float height_m, int count)
{
    const std::array<glm::vec2, 8> profile{{{0.0F, 0.0F},
                                            {0.46F, 0.0F},
                                            {0.46F, 0.25F},
                                            {0.32F, 0.36F},
                                            {0.26F, height_m - 0.45F},
                                            {0.46F, height_m - 0.2F},
                                            {0.46F, height_m},
                                            {0.0F, height_m}}};
    const estampe::Primitive column = shapes::lathe(profile, 12, 0.5F);
    for (int i = 0; i < count; ++i) {
        const float angle =
            2.0F * std::numbers::pi_v<float> * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        kit.add(Stuff::marble, column, at({radius_m * std::sin(angle), foot_m, radius_m * std::cos(angle)}));
    }
}

/// Builds a pylon: a square block of masonry beside the gate, with walls that lean inwards; if `is_ruin`, its
/// top has collapsed.
Kit build_pylon(float height_m, bool is_ruin, Dice dice)
{
    constexpr float half_m = 3.2F;
    Wall side{.length_m = 2.0F * half_m,
              .height_m = height_m,
              .thickness_m = 1.0F,
              .course_m = 0.85F,
              .stone_m = 1.6F,
              .joints = 0.3F};
    if (is_ruin) {
        const float phase = 6.0F * dice.share();
        side.top_m = [=](float x_m) {
            return height_m * (0.62F + 0.3F * std::sin(0.5F * x_m + phase) + 0.1F * std::sin(1.9F * x_m));
        };
    }
    Kit kit;
    add_shell(kit, side, half_m - 0.5F, dice);
    if (!is_ruin) {
        const float out = half_m + 0.35F;
        add_block(kit, Stuff::stone, {-out, height_m, -out}, {out, height_m + 0.5F, out});
        for (int i = 0; i < 4; ++i) {
            for (const float along : {-2.6F, 0.0F, 2.6F}) {
                Kit merlon;
                add_block(merlon, Stuff::stone, {along - 0.65F, height_m + 0.5F, half_m - 0.35F},
                          {along + 0.65F, height_m + 1.5F, half_m + 0.3F});
                kit.add(merlon, at({}, 90.0F * static_cast<float>(i)));
            }
        }
    }
    return kit;
}

/// Builds a square tower, 34 m high, with a ring of columns on top.
Kit build_tower(Dice dice)
{
    Kit kit;
    const Wall side{.length_m = 11.0F,
                    .height_m = 19.0F,
                    .thickness_m = 1.0F,
                    .foot_m = -6.0F,
                    .course_m = 1.0F,
                    .stone_m = 2.2F,
                    .arches = {{.x_m = 5.5F, .half_m = 0.8F, .springing_m = 12.0F, .ring_m = 0.5F}},
                    .joints = 0.14F};
    add_shell(kit, side, 5.0F, dice);
    add_block(kit, Stuff::dark, {-4.4F, 2.0F, -4.4F}, {4.4F, 18.5F, 4.4F});
    add_block(kit, Stuff::stone, {-5.9F, 19.0F, -5.9F}, {5.9F, 19.5F, 5.9F});
    add_block(kit, Stuff::stone, {-6.4F, 19.5F, -6.4F}, {6.4F, 20.1F, 6.4F});
    kit.add(Stuff::stone, shapes::cylinder(3.1F, 7.6F, 40), at({0.0F, 20.1F, 0.0F}));
    add_ring(kit, 4.4F, 20.1F, 6.6F, 14);
    kit.add(Stuff::stone, shapes::cylinder(5.2F, 0.5F, 48), at({0.0F, 26.7F, 0.0F}));
    kit.add(Stuff::stone, shapes::cylinder(5.6F, 0.4F, 48), at({0.0F, 27.2F, 0.0F}));
    kit.add(Stuff::stone, shapes::cylinder(3.2F, 4.0F, 40), at({0.0F, 27.6F, 0.0F}));
    kit.add(Stuff::stone, shapes::cylinder(3.9F, 0.4F, 40), at({0.0F, 31.6F, 0.0F}));
    kit.add(Stuff::red, shapes::cone(3.7F, 2.8F, 40), at({0.0F, 32.0F, 0.0F}));
    return kit;
}

constexpr int portico_columns = 6;

constexpr float step_run_m = 0.44F;
constexpr float portico_pitch_m = 4.9F;

/// Returns a row of equal arches. The number of arches is the largest for which each pier between two arches
/// is wide enough.
std::vector<Arch> row_of_arches(float length_m, float half_m, float springing_m, float pier_m)
{
    const int count = static_cast<int>((length_m - pier_m) / (2.0F * half_m + pier_m));
    const float pitch_m = (length_m - pier_m) / static_cast<float>(count);
    std::vector<Arch> arches;
    arches.reserve(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
        arches.push_back({.x_m = 0.5F * pier_m + (static_cast<float>(i) + 0.5F) * pitch_m,
                          .half_m = half_m,
                          .springing_m = springing_m,
                          .ring_m = 0.62F});
    }
    return arches;
}

/// Adds projecting blocks (imposts) to the piers of an arcade: at the foot, and where the arches begin.
void add_imposts(Kit& kit, const Wall& wall)
{
    const float z = 0.5F * wall.thickness_m + 0.1F;
    float left = 0.0F;
    for (size_t i = 0; i <= wall.arches.size(); ++i) {
        const bool is_last = i == wall.arches.size();
        const float right = is_last ? wall.length_m : wall.arches[i].x_m - wall.arches[i].half_m;
        const float springing = wall.arches[std::min(i, wall.arches.size() - 1)].springing_m;
        const auto stands = [&](float height_m) {
            return !wall.top_m || std::min(wall.top_m(left), wall.top_m(right)) > height_m;
        };
        if (stands(0.9F)) {
            add_block(kit, Stuff::stone, {left - 0.1F, -0.8F, -z}, {right + 0.1F, 0.5F, z});
        }
        if (stands(springing + 0.6F)) {
            add_block(kit, Stuff::stone, {left - 0.1F, springing - 0.24F, -z}, {right + 0.1F, springing, z});
        }
        if (!is_last) {
            left = wall.arches[i].x_m + wall.arches[i].half_m;
        }
    }
}

/// Adds the long western arcade, whose front is in the sun, with a roofed walk behind it.
void add_west(Site& site, uint64_t seed)
{
    Kit kit;
    const Dice dice(seed, 10);
    Wall wall{.length_m = 51.0F,
              .height_m = 10.2F,
              .thickness_m = 1.1F,
              .arches = row_of_arches(51.0F, 1.95F, 4.3F, 1.5F),
              .joints = 0.3F,
              .cornice = true};
    const glm::mat4 placed = at({court_west_m, 0.0F, 24.0F}, 90.0F);
    Kit front = build_wall(wall, lay(wall, dice), dice);
    add_imposts(front, wall);
    kit.add(front, placed);
    const Wall back{.length_m = 51.0F, .height_m = 7.6F, .thickness_m = 0.8F, .joints = 0.3F};
    kit.add(build_wall(back, lay(back, dice), dice), at({court_west_m - 6.0F, 0.0F, 24.0F}, 90.0F));
    add_block(kit, Stuff::stone, {court_west_m - 6.4F, 7.6F, -27.0F}, {court_west_m - 0.4F, 8.0F, 24.0F});
    site.things.push_back({.name = "arcade", .kit = std::move(kit)});
}

/// Adds the eastern arcade, which stands free and is collapsing, so that the sun shines through it.
void add_east(Site& site, uint64_t seed)
{
    Dice dice(seed, 11);
    Wall wall{.length_m = 47.0F,
              .height_m = 8.2F,
              .thickness_m = 1.2F,
              .arches = row_of_arches(47.0F, 1.9F, 3.5F, 1.6F),
              .joints = 0.4F};
    const float gap_m = dice.between(22.0F, 32.0F);
    const float phase = 6.0F * dice.share();
    wall.top_m = [=](float x_m) {
        const float off_m = std::abs(x_m - gap_m);
        const float wave = 0.5F * std::sin(0.9F * x_m + phase) + 0.5F * std::sin(0.37F * x_m);
        return std::min(8.2F + 0.9F * std::min(wave, 0.0F), 1.6F + 0.9F * off_m + wave);
    };
    Kit kit;
    Kit standing = build_wall(wall, lay(wall, dice), dice);
    add_imposts(standing, wall);
    kit.add(standing, at({court_east_m, 0.0F, -23.0F}, -90.0F));
    site.things.push_back({.name = "eastern arcade", .kit = std::move(kit)});
}

void add_gate(Site& site, uint64_t seed)
{
    Dice dice(seed, 12);
    Wall wall{.length_m = 46.0F,
              .height_m = 7.4F,
              .thickness_m = 1.6F,
              .arches = {{.x_m = 23.0F, .half_m = gate_half_m, .springing_m = 5.0F, .ring_m = 0.9F}},
              .joints = 0.35F};
    wall.height_m = 11.0F;
    const float phase = 6.0F * dice.share();
    wall.top_m = [=](float x_m) {
        const float off_m = std::abs(x_m - 23.0F);
        const float wave = std::sin(0.5F * x_m + phase) + 0.5F * std::sin(1.1F * x_m);
        const float low = x_m < 23.0F ? 7.0F + 0.5F * wave : 3.2F + 1.4F * wave;
        return off_m < 5.4F ? 11.0F : std::max(low, 11.0F - 2.4F * (off_m - 5.4F));
    };
    Kit kit;
    kit.add(build_wall(wall, lay(wall, dice), dice), at({-23.0F, 0.0F, court_south_m}));
    add_block(kit, Stuff::stone, {-5.2F, 11.0F, court_south_m - 1.1F}, {5.2F, 11.4F, court_south_m + 1.1F});
    for (const float side : {-1.0F, 1.0F}) {
        const bool is_whole = side < 0.0F;
        kit.add(build_pylon(is_whole ? 15.5F : 8.5F, !is_whole, Dice(seed, is_whole ? 13 : 14)),
                at({side * 8.6F, 0.0F, court_south_m}));
    }
    site.things.push_back({.name = "gate", .kit = std::move(kit)});
}

/// Adds the stairs, the platform in front of the portal, and the beams on its great columns.
void add_portico(Site& site)
{
    Kit kit;
    constexpr int steps = 6;
    for (int i = 0; i < steps; ++i) {
        const float z = stairs_foot_m - step_run_m * static_cast<float>(i);
        const float low = i == 0 ? -3.0F : floor_m * static_cast<float>(i) / steps;
        add_block(kit, Stuff::paving, {-stairs_half_m, low, front_z_m},
                  {stairs_half_m, floor_m * static_cast<float>(i + 1) / steps, z});
    }
    for (const float side : {-1.0F, 1.0F}) {
        add_block(kit, Stuff::stone, {side * stairs_half_m - 0.6F, -3.0F, front_z_m},
                  {side * stairs_half_m + 0.6F, floor_m + 0.5F, stairs_foot_m + 0.8F});
    }
    // A beam lies where both columns that carry it still stand.
    const auto is_whole = [&](int i) {
        return i >= 0 && i < portico_columns && site.columns[static_cast<size_t>(i)].column.left >= 1.0F;
    };
    for (int i = 0; i + 1 < portico_columns; ++i) {
        if (!is_whole(i) || !is_whole(i + 1)) {
            continue;
        }
        constexpr float over_m = 0.85F;
        const StandingColumn& column = site.columns[static_cast<size_t>(i)];
        const float from = column.place_m.x - (is_whole(i - 1) ? 0.0F : over_m);
        const float to = column.place_m.x + portico_pitch_m + (is_whole(i + 2) ? 0.0F : over_m);
        const float y = floor_m + column.column.height_m;
        const float z = column.place_m.y;
        add_block(kit, Stuff::marble, {from, y, z - 0.9F}, {to, y + 0.95F, z + 0.9F});
        add_block(kit, Stuff::marble, {from - (is_whole(i - 1) ? 0.0F : 0.3F), y + 0.95F, z - 1.2F},
                  {to + (is_whole(i + 2) ? 0.0F : 0.3F), y + 1.3F, z + 1.2F});
    }
    site.things.push_back({.name = "portico", .kit = std::move(kit)});
}

void lay_drums(Site& site, uint64_t seed)
{
    Dice dice(seed, 21);
    site.drums.emplace_back(1.6F, 9.5F, dice.between(15.0F, 40.0F));
    site.drums.emplace_back(-12.0F, -9.0F, dice.between(0.0F, 180.0F));
    site.drums.emplace_back(12.2F, -11.5F, dice.between(60.0F, 120.0F));
    site.drums.emplace_back(-3.2F, 41.0F, dice.between(0.0F, 180.0F));
    site.drums.emplace_back(6.0F, 59.0F, dice.between(0.0F, 180.0F));
}

void add_statues(Site& site, uint64_t seed)
{
    Dice dice(seed, 17);
    Kit figure;
    figure.add(build_figure(dice), at({0.0F, 0.0F, 0.0F}, -30.0F));
    site.things.push_back({.name = "figure", .kit = std::move(figure), .place_m = {-5.4F, 0.0F, -4.0F}});
    site.colossus_m = {46.0F, 30.0F};
    const auto part = [&](const char* name, const Kit& kit, const glm::vec2& off, const glm::mat4& turned) {
        Thing thing{.name = name, .on_sand = true};
        thing.kit.add(kit, turned);
        const glm::vec2 place = site.colossus_m + off;
        thing.place_m = {place.x, 0.0F, place.y};
        site.things.push_back(std::move(thing));
    };
    constexpr glm::vec3 forward(1.0F, 0.0F, 0.0F);
    constexpr glm::vec3 along(0.0F, 0.0F, 1.0F);
    const glm::mat4 grown = glm::scale(glm::mat4(1.0F), glm::vec3(1.6F));
    part("colossus", build_seated(dice), {},
         glm::rotate(at({0.0F, -4.0F, 0.0F}, 25.0F), 0.07F, along) * grown);
    part("head", build_head(3.0F), {13.0F, 11.0F},
         glm::rotate(glm::rotate(at({0.0F, 0.9F, 0.0F}, -20.0F), 1.1F, along), -0.3F, forward));
    part("hand", build_hand(5.6F), {-8.5F, 15.0F}, glm::rotate(at({0.0F, 0.4F, 0.0F}, -30.0F), 0.22F, along));
}

/// Adds a flagpole with a ball on top; its foot is deep in the ground.
void add_pole(Site& site, Kit& kit, const glm::vec3& foot, float height_m, const glm::vec2& cloth_m)
{
    kit.add(Stuff::iron,
            rod(foot - glm::vec3(0, 2.5F, 0), foot + glm::vec3(0, height_m, 0), 0.08F, 0.055F, 8, 3));
    kit.add(Stuff::iron, shapes::sphere(0.17F, 10, 6), at(foot + glm::vec3(0, height_m + 0.12F, 0)));
    // The flag's cloth initially points in the direction of the wind.
    const glm::vec3 along = cloth_m.x * glm::normalize(glm::vec3(-0.94F, 0.0F, -0.34F));
    site.sheets.push_back(
        {foot + glm::vec3(0.0F, height_m - 0.15F, 0.0F) + 0.02F * along, along, {0.0F, -cloth_m.y, 0.0F}});
}

void add_flags(Site& site, uint64_t seed)
{
    Dice dice(seed, 18);
    Kit poles;
    for (const float z : {31.0F, 50.0F}) {
        for (const float side : {-1.0F, 1.0F}) {
            add_pole(site, poles, {side * 4.6F, 0.0F, z}, dice.between(6.5F, 8.5F), {3.2F, 1.7F});
        }
    }
    add_pole(site, poles, {-8.6F, 15.0F, court_south_m}, 6.0F, {3.6F, 1.9F});
    for (const float z : {-14.5F, -9.5F, -4.5F}) {
        add_pole(site, poles, {9.6F, 0.0F, z}, dice.between(7.0F, 9.0F), {3.0F, 1.6F});
    }
    // Banners hang between the arches of the western arcade.
    for (const float z : {-18.6F, -7.4F, 3.8F, 15.0F}) {
        const float x = court_west_m + 0.85F;
        poles.add(Stuff::iron,
                  rod({x - 0.4F, 7.62F, z + 0.9F}, {x - 0.4F, 7.62F, z - 0.9F}, 0.04F, 0.04F, 6, 3),
                  glm::translate(glm::mat4(1.0F), {0.42F, 0.0F, 0.0F}));
        site.sheets.push_back({{x + 0.06F, 7.6F, z + 0.75F}, {0.0F, 0.0F, -1.5F}, {0.0F, -3.3F, 0.0F}, true});
    }
    site.things.push_back({.name = "poles", .kit = std::move(poles)});
}

void add_towers(Site& site, uint64_t seed)
{
    site.tower_m = {33.0F, -82.0F};
    site.things.push_back({.name = "tower",
                           .kit = build_tower(Dice(seed, 19)),
                           .place_m = {site.tower_m.x, -1.0F, site.tower_m.y}});
    Kit far;
    far.add(build_tower(Dice(seed, 20)), glm::scale(glm::mat4(1.0F), glm::vec3(1.7F)));
    site.things.push_back({.name = "far tower", .kit = std::move(far), .place_m = {-120.0F, -6.0F, -330.0F}});
}

} // namespace

std::vector<StandingColumn> stand_columns(uint64_t seed)
{
    Dice dice(seed, 15);
    std::vector<StandingColumn> columns;
    const int first_broken = dice.chance(0.5F) ? 0 : portico_columns - 2;
    for (int i = 0; i < portico_columns; ++i) {
        const float x = portico_pitch_m * (static_cast<float>(i) - 0.5F * (portico_columns - 1));
        Column column = throw_column(dice, 0.92F, 10.5F, 0.0F);
        column.order = Order::doric;
        column.flutes = std::max(column.flutes, 18);
        column.wear = dice.between(0.2F, 0.8F);
        if (i == first_broken || i == first_broken + 1) {
            column.left = dice.between(0.25F, 0.75F);
        }
        columns.push_back({{x, stairs_foot_m - 5.0F * step_run_m - 1.8F}, floor_m, true, column});
    }
    for (const float z : {15.0F, 4.5F, -6.0F}) { // Columns along the eastern side of the court
        columns.push_back({{13.6F, z}, -0.1F, false, throw_column(dice, 0.78F, 8.2F, 0.2F)});
        columns.back().column.lean_deg *= 0.5F;
    }
    columns.back().column.left = 0.45F;
    for (int pair = 0; pair < 6; ++pair) { // Columns along the avenue that leads to the gate
        for (const float side : {-1.0F, 1.0F}) {
            const glm::vec2 place(side * 7.4F, 36.5F + 9.0F * static_cast<float>(pair));
            Column column = throw_column(dice, 0.8F, 8.6F, 0.5F);
            column.lean_deg *= 0.6F;
            if (!dice.chance(0.12F)) {
                columns.push_back({place, -dice.between(0.5F, 1.9F), false, column});
            }
        }
    }
    // One column stands alone, far from the temple, where visitors first see the temple.
    Column lone = throw_column(dice, 0.85F, 9.0F, 0.0F);
    lone.flutes = 20;
    lone.left = 0.8F;
    columns.push_back({{-54.5F, 84.5F}, -0.8F, false, lone});
    return columns;
}

Site make_site(uint64_t seed)
{
    Site site;
    site.columns = stand_columns(seed);
    add_west(site, seed);
    add_east(site, seed);
    add_gate(site, seed);
    add_portico(site);
    lay_drums(site, seed);
    add_statues(site, seed);
    add_flags(site, seed);
    add_towers(site, seed);
    return site;
}

} // namespace temple
