// SPDX-License-Identifier: MIT
#include "tower.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <estampe/shapes.hpp>

#include "wall.hpp"

namespace temple {
namespace {

namespace shapes = estampe::shapes;

/// Four walls about the y axis.
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

} // namespace

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

} // namespace temple
