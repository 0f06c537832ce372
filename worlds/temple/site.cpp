// SPDX-License-Identifier: MIT
#include "site.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

#include "statue.hpp"
#include "tower.hpp"
#include "wall.hpp"

namespace temple {
namespace {

namespace shapes = estampe::shapes;

constexpr float step_run_m = 0.44F;
constexpr float portico_pitch_m = 4.9F;

/// A row of arches as wide as will fit between piers of at least that width.
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

/// Blocks at the foot of the piers, and under the springing of their arches.
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

/// The long arcade in the west, whose face the sun strikes, with a roofed walk behind it.
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

/// The arcade in the east stands alone and is falling: the sun comes through it.
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

/// The stairs and the platform before the portal, and what the great columns on it carry.
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
    // Beams lie where there is a column at either end.
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

/// A pole with a ball, whose foot is deep in the ground.
void add_pole(Site& site, Kit& kit, const glm::vec3& foot, float height_m, const glm::vec2& cloth_m)
{
    kit.add(Stuff::iron,
            rod(foot - glm::vec3(0, 2.5F, 0), foot + glm::vec3(0, height_m, 0), 0.08F, 0.055F, 8));
    kit.add(Stuff::iron, shapes::sphere(0.17F, 10, 6), at(foot + glm::vec3(0, height_m + 0.12F, 0)));
    // It begins as the wind would have it.
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
        poles.add(Stuff::iron, rod({x - 0.4F, 7.62F, z + 0.9F}, {x - 0.4F, 7.62F, z - 0.9F}, 0.04F, 0.04F, 6),
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
    for (const float z : {15.0F, 4.5F, -6.0F}) { // along the court's east
        columns.push_back({{13.6F, z}, -0.1F, false, throw_column(dice, 0.78F, 8.2F, 0.2F)});
        columns.back().column.lean_deg *= 0.5F;
    }
    columns.back().column.left = 0.45F;
    for (int pair = 0; pair < 6; ++pair) { // the avenue that leads to the gate
        for (const float side : {-1.0F, 1.0F}) {
            const glm::vec2 place(side * 7.4F, 36.5F + 9.0F * static_cast<float>(pair));
            Column column = throw_column(dice, 0.8F, 8.6F, 0.5F);
            column.lean_deg *= 0.6F;
            if (!dice.chance(0.12F)) {
                columns.push_back({place, -dice.between(0.5F, 1.9F), false, column});
            }
        }
    }
    // One stands alone, far out, where those who come first see the temple.
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
