// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

#include "square.hpp"

namespace square {
namespace {

namespace shapes = estampe::shapes;

constexpr float pi = std::numbers::pi_v<float>;

/// The stones of an arch. They stand out from the wall, so that each stone is drawn; the keystone is the
/// longest.
void add_arch_stones(Kit& kit, float radius, float springing, const glm::mat4& placed)
{
    constexpr int stones = 11;
    constexpr float joint_rad = 0.012F;
    for (int stone = 0; stone < stones; ++stone) {
        const float from = pi * static_cast<float>(stone) / stones + joint_rad;
        const float to = pi * static_cast<float>(stone + 1) / stones - joint_rad;
        const float outer = radius + (stone == stones / 2 ? 0.85F : stone % 2 == 0 ? 0.62F : 0.5F);
        const auto spot = [springing](float r, float angle) {
            return glm::vec2(r * std::cos(angle), springing + r * std::sin(angle));
        };
        const std::array<glm::vec2, 4> outline{spot(radius, from), spot(outer, from), spot(outer, to),
                                               spot(radius, to)};
        kit.add(Stuff::stone, shapes::extrude(outline, 0.14F), placed);
    }
}

/// Mouldings along the whole length: a string course above the arches and a cornice in two steps.
void add_courses(Kit& kit, const Arcade& arcade, float string_height)
{
    const float length = length_of(arcade);
    const float body = std::max(arcade.depth, arcade.thickness);
    const auto course = [&](float height, float rise, float out) {
        kit.add(Stuff::stone, shapes::box({length + 2.0F * out, rise, body + 2.0F * out}),
                at({0.0F, height, -0.5F * body}));
    };
    if (arcade.depth > 0.0F)
        kit.add(Stuff::stone, shapes::box({length + 0.2F, 0.22F, 0.3F}), at({0.0F, string_height, 0.0F}));
    else
        kit.add(Stuff::stone, shapes::box({length + 0.2F, 0.22F, body + 0.24F}),
                at({0.0F, string_height, -0.5F * body}));
    course(arcade.height, 0.25F, 0.22F);
    course(arcade.height + 0.25F, 0.3F, 0.55F);
}

void add_bay(Kit& kit, const Arcade& arcade, float x, bool door)
{
    const float radius = 0.5F * arcade.opening;
    add_arch_stones(kit, radius, arcade.springing, at({x, 0.0F, 0.0F}));
    if (arcade.windows && arcade.height > 7.0F) {
        const float sill = arcade.height - 2.1F;
        kit.add(Stuff::shutter, shapes::box({1.0F, 1.5F, 0.12F}), at({x, sill, 0.0F}));
        kit.add(Stuff::stone, shapes::box({1.4F, 0.16F, 0.4F}), at({x, sill - 0.16F, 0.0F}));
        kit.add(Stuff::stone, shapes::box({1.3F, 0.2F, 0.3F}), at({x, sill + 1.5F, 0.0F}));
    }
    if (arcade.depth > 0.0F && door)
        kit.add(Stuff::shutter, shapes::box({1.7F, 3.1F, 0.1F}), at({x, 0.0F, 0.42F - arcade.depth}));
}

/// The walk behind the arches: back wall, ceiling and two ends. No two faces are in one plane.
void add_walk(Kit& kit, const Arcade& arcade, float ceiling)
{
    constexpr float back = 0.4F;
    const float length = length_of(arcade);
    const float inner = arcade.depth - arcade.thickness - back;
    const float middle = -arcade.thickness - 0.5F * inner;
    kit.add(Stuff::plaster, shapes::box({length, arcade.height, back}),
            at({0.0F, 0.0F, 0.5F * back - arcade.depth}));
    kit.add(Stuff::plaster, shapes::box({length - 0.9F, 0.3F, inner}), at({0.0F, ceiling, middle}));
    for (const float end : {-1.0F, 1.0F})
        kit.add(Stuff::plaster, shapes::box({0.5F, arcade.height, inner}),
                at({end * (0.5F * length - 0.25F), 0.0F, middle}));
}

Kit build_flag(float pole, float width, float height, float phase)
{
    estampe::Primitive cloth = shapes::plane(width, height, 12);
    for (size_t i = 0; i < cloth.positions.size(); ++i) {
        const float across = cloth.positions[i].x + 0.5F * width;
        const float wave = 2.4F * across / width * pi + phase;
        const float amplitude = 0.16F * height * std::sqrt(across / width);
        const float droop = 0.12F * across * across / width;
        const float slope = amplitude * 2.4F * pi / width * std::cos(wave);
        cloth.positions[i] = {across, pole - 0.5F * height - cloth.positions[i].z - droop,
                              amplitude * std::sin(wave)};
        cloth.normals[i] = glm::normalize(glm::vec3(-slope, 0.0F, 1.0F));
    }
    Kit kit;
    kit.add(Stuff::red, cloth);
    kit.add(Stuff::iron, rod({0.0F, 0.0F, 0.0F}, {0.0F, pole, 0.0F}, 0.13F, 0.1F, 8));
    kit.add(Stuff::iron, shapes::sphere(0.24F, 10, 6), at({0.0F, pole + 0.1F, 0.0F}));
    return kit;
}

void add_ring_of_columns(Kit& kit, float radius, float height, int count, float foot)
{
    const std::array<glm::vec2, 10> profile{{{0.0F, 0.0F},
                                             {0.42F, 0.0F},
                                             {0.42F, 0.2F},
                                             {0.3F, 0.32F},
                                             {0.25F, height - 0.4F},
                                             {0.3F, height - 0.34F},
                                             {0.42F, height - 0.16F},
                                             {0.44F, height - 0.16F},
                                             {0.44F, height},
                                             {0.0F, height}}};
    const estampe::Primitive column = shapes::lathe(profile, 12, 0.5F);
    for (int i = 0; i < count; ++i) {
        const float angle = 2.0F * pi * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        kit.add(Stuff::marble, column, at({radius * std::sin(angle), foot, radius * std::cos(angle)}));
    }
}

} // namespace

float length_of(const Arcade& arcade)
{
    return shapes::arch_wall_length(
        {.arches = arcade.arches, .opening = arcade.opening, .pier = arcade.pier});
}

Kit build_arcade(const Arcade& arcade)
{
    const float radius = 0.5F * arcade.opening;
    const float string_height = arcade.springing + radius + 0.95F;
    Kit kit;
    kit.add(Stuff::plaster,
            shapes::arch_wall({.height = arcade.height,
                               .thickness = arcade.thickness,
                               .arches = arcade.arches,
                               .opening = arcade.opening,
                               .pier = arcade.pier,
                               .springing = arcade.springing,
                               .arch_segments = 24}),
            at({0.0F, 0.0F, -0.5F * arcade.thickness}));
    const float pitch = arcade.opening + arcade.pier;
    for (uint32_t i = 0; i < arcade.arches; ++i)
        add_bay(kit, arcade, (static_cast<float>(i) - 0.5F * static_cast<float>(arcade.arches - 1)) * pitch,
                i % 2 == 1);
    for (uint32_t i = 0; i <= arcade.arches; ++i) {
        const glm::vec3 pier{(static_cast<float>(i) - 0.5F * static_cast<float>(arcade.arches)) * pitch, 0.0F,
                             -0.5F * arcade.thickness};
        kit.add(Stuff::stone, shapes::box({arcade.pier + 0.2F, 0.5F, arcade.thickness + 0.2F}), at(pier));
        kit.add(Stuff::stone, shapes::box({arcade.pier + 0.16F, 0.22F, arcade.thickness + 0.2F}),
                at(pier + glm::vec3(0.0F, arcade.springing - 0.22F, 0.0F)));
    }
    add_courses(kit, arcade, string_height);
    if (arcade.depth > 0.0F)
        add_walk(kit, arcade, string_height);
    return kit;
}

Kit build_tower()
{
    Kit kit;
    kit.add(Stuff::stone, shapes::box({11.0F, 1.6F, 11.0F}));
    kit.add(Stuff::plaster, shapes::box({9.4F, 15.0F, 9.4F}), at({0.0F, 1.6F, 0.0F}));
    kit.add(Stuff::stone, shapes::box({10.2F, 0.5F, 10.2F}), at({0.0F, 16.6F, 0.0F}));
    kit.add(Stuff::stone, shapes::box({11.2F, 0.5F, 11.2F}), at({0.0F, 17.1F, 0.0F}));
    for (const float y : {4.0F, 9.5F})
        for (const float side : {0.0F, 90.0F})
            kit.add(Stuff::shutter, shapes::box({1.5F, 3.0F, 9.5F}), at({0.0F, y, 0.0F}, side));
    kit.add(Stuff::plaster, shapes::cylinder(2.6F, 7.0F, 40), at({0.0F, 17.6F, 0.0F}));
    add_ring_of_columns(kit, 3.9F, 6.0F, 14, 17.6F);
    kit.add(Stuff::stone, shapes::cylinder(4.7F, 0.5F, 48), at({0.0F, 23.6F, 0.0F}));
    kit.add(Stuff::stone, shapes::cylinder(5.1F, 0.4F, 48), at({0.0F, 24.1F, 0.0F}));
    kit.add(Stuff::plaster, shapes::cylinder(3.3F, 4.0F, 40), at({0.0F, 24.5F, 0.0F}));
    add_ring_of_columns(kit, 3.4F, 4.0F, 12, 24.5F);
    kit.add(Stuff::stone, shapes::cylinder(4.2F, 0.5F, 48), at({0.0F, 28.5F, 0.0F}));
    kit.add(Stuff::red, shapes::cone(3.9F, 2.6F, 40), at({0.0F, 29.0F, 0.0F}));
    kit.add(build_flag(5.4F, 4.4F, 2.2F, 0.4F), at({0.0F, 31.2F, 0.0F}, 70.0F));
    kit.add(build_flag(5.0F, 3.2F, 1.7F, 2.0F), at({-5.0F, 17.6F, 5.0F}, 70.0F));
    kit.add(build_flag(5.0F, 3.2F, 1.7F, 3.4F), at({5.0F, 17.6F, 5.0F}, 70.0F));
    return kit;
}

} // namespace square
