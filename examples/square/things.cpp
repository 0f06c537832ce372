// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

#include "square.hpp"

namespace square {
namespace {

namespace shapes = estampe::shapes;

glm::mat4 lying(const glm::vec3& place)
{
    return glm::rotate(glm::translate(glm::mat4(1.0F), place), glm::radians(-90.0F), {0.0F, 0.0F, 1.0F});
}

void add_engine_wheels(Kit& kit)
{
    const auto wheel = [&kit](float x, float radius) {
        for (const float side : {-0.85F, 0.7F})
            kit.add(Stuff::red, shapes::cylinder(radius, 0.15F, 20),
                    glm::rotate(glm::translate(glm::mat4(1.0F), {x, radius, side}), glm::radians(90.0F),
                                {1.0F, 0.0F, 0.0F}));
    };
    for (const float x : {-2.6F, -1.7F})
        wheel(x, 0.4F);
    for (const float x : {-0.6F, 0.8F, 2.2F})
        wheel(x, 0.65F);
    for (const float x : {4.2F, 5.4F, 6.6F})
        wheel(x, 0.45F);
}

void add_steam(Kit& kit, const glm::vec3& chimney)
{
    constexpr std::array<glm::vec4, 9> puffs{{{0.1F, 0.4F, 0.0F, 0.4F},
                                              {0.5F, 1.1F, 0.1F, 0.62F},
                                              {1.2F, 1.9F, 0.0F, 0.9F},
                                              {1.9F, 1.5F, 0.3F, 0.7F},
                                              {2.7F, 2.5F, 0.0F, 1.15F},
                                              {3.9F, 2.2F, -0.2F, 0.8F},
                                              {4.8F, 2.9F, 0.0F, 1.0F},
                                              {6.0F, 2.8F, 0.1F, 0.6F},
                                              {7.4F, 3.2F, 0.0F, 0.4F}}};
    for (const glm::vec4& puff : puffs)
        kit.add(Stuff::steam, shapes::sphere(puff.w, 18, 10), at(chimney + glm::vec3(puff)));
}

} // namespace

Kit build_column()
{
    constexpr float block = 0.5F;
    constexpr float shaft = 6.2F;
    Kit kit;
    kit.add(Stuff::marble, shapes::box({1.9F, block, 1.9F}));
    const std::array<glm::vec2, 8> foot{{{0.0F, 0.0F},
                                         {0.78F, 0.0F},
                                         {0.84F, 0.07F},
                                         {0.84F, 0.13F},
                                         {0.78F, 0.2F},
                                         {0.7F, 0.24F},
                                         {0.68F, 0.32F},
                                         {0.0F, 0.32F}}};
    kit.add(Stuff::marble, shapes::lathe(foot, 48, 0.9F), at({0.0F, block, 0.0F}));
    kit.add(Stuff::marble,
            shapes::fluted_column({.radius_bottom = 0.66F,
                                   .radius_top = 0.54F,
                                   .height = shaft,
                                   .flutes = 18,
                                   .flute_segments = 8,
                                   .rings = 10,
                                   .flute_depth = 0.075F}),
            at({0.0F, block + 0.32F, 0.0F}));
    const std::array<glm::vec2, 7> head{{{0.0F, 0.0F},
                                         {0.53F, 0.0F},
                                         {0.54F, 0.14F},
                                         {0.66F, 0.24F},
                                         {0.8F, 0.4F},
                                         {0.84F, 0.46F},
                                         {0.0F, 0.46F}}};
    const float top = block + 0.32F + shaft;
    kit.add(Stuff::marble, shapes::lathe(head, 48, 0.9F), at({0.0F, top, 0.0F}));
    kit.add(Stuff::marble, shapes::box({1.8F, 0.34F, 1.8F}), at({0.0F, top + 0.46F, 0.0F}));
    return kit;
}

Kit build_drum()
{
    Kit kit;
    kit.add(Stuff::marble,
            shapes::fluted_column({.radius_bottom = 0.62F,
                                   .radius_top = 0.6F,
                                   .height = 2.3F,
                                   .flutes = 18,
                                   .flute_segments = 8,
                                   .rings = 6,
                                   .flute_depth = 0.075F,
                                   .break_height = 0.7F}),
            lying({-1.1F, 0.6F, 0.0F}));
    return kit;
}

Kit build_statue()
{
    Kit kit;
    kit.add(Stuff::stone, shapes::box({4.4F, 0.3F, 2.2F}));
    kit.add(Stuff::marble, shapes::box({3.8F, 1.2F, 1.7F}), at({0.0F, 0.3F, 0.0F}));
    kit.add(Stuff::stone, shapes::box({4.2F, 0.22F, 2.0F}), at({0.0F, 1.5F, 0.0F}));
    const auto limb = [&kit](const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b) {
        constexpr glm::vec3 top{0.0F, 1.72F, 0.0F};
        kit.add(Stuff::marble, rod(a + top, b + top, radius_a, radius_b, 20));
    };
    // She lies on her side, resting on an elbow, the other arm over her head, one knee drawn up.
    limb({0.25F, 0.3F, 0.0F}, {-0.55F, 0.62F, 0.02F}, 0.33F, 0.27F);
    limb({-0.55F, 0.62F, 0.02F}, {-0.85F, 0.92F, 0.02F}, 0.3F, 0.2F);
    limb({-0.92F, 1.02F, 0.03F}, {-1.0F, 1.12F, 0.03F}, 0.11F, 0.11F);
    limb({-1.06F, 1.27F, 0.05F}, {-1.12F, 1.36F, 0.06F}, 0.19F, 0.17F);
    limb({-0.85F, 0.92F, 0.25F}, {-1.28F, 0.4F, 0.4F}, 0.13F, 0.1F);
    limb({-1.28F, 0.4F, 0.4F}, {-0.95F, 0.12F, 0.55F}, 0.1F, 0.08F);
    limb({-0.8F, 0.95F, -0.2F}, {-0.72F, 1.5F, -0.1F}, 0.13F, 0.1F);
    limb({-0.72F, 1.5F, -0.1F}, {-1.12F, 1.62F, 0.05F}, 0.1F, 0.07F);
    limb({0.2F, 0.32F, 0.14F}, {1.0F, 0.3F, 0.28F}, 0.3F, 0.2F);
    limb({1.0F, 0.3F, 0.28F}, {1.75F, 0.16F, 0.3F}, 0.2F, 0.12F);
    limb({0.22F, 0.36F, -0.14F}, {0.9F, 0.86F, -0.14F}, 0.29F, 0.19F);
    limb({0.9F, 0.86F, -0.14F}, {1.32F, 0.18F, -0.1F}, 0.19F, 0.11F);
    limb({0.1F, 0.1F, 0.3F}, {1.2F, 0.06F, 0.55F}, 0.16F, 0.1F);
    limb({-0.4F, 0.12F, -0.3F}, {1.5F, 0.08F, -0.35F}, 0.14F, 0.1F);
    return kit;
}

Kit build_person(bool cloak)
{
    Kit kit;
    const Stuff cloth = cloak ? Stuff::red : Stuff::iron;
    const std::array<glm::vec2, 9> robe{{{0.0F, 0.0F},
                                         {0.3F, 0.0F},
                                         {0.27F, 0.35F},
                                         {0.2F, 0.85F},
                                         {0.19F, 1.0F},
                                         {0.25F, 1.25F},
                                         {0.22F, 1.42F},
                                         {0.09F, 1.5F},
                                         {0.0F, 1.52F}}};
    kit.add(cloth, shapes::lathe(robe, 20, 1.2F));
    kit.add(Stuff::stone, shapes::sphere(0.125F, 14, 10), at({0.0F, 1.63F, 0.0F}));
    kit.add(cloth, rod({0.24F, 1.36F, 0.0F}, {0.34F, 0.85F, 0.06F}, 0.075F, 0.06F, 10));
    kit.add(cloth, rod({-0.24F, 1.36F, 0.0F}, {-0.42F, 1.05F, 0.12F}, 0.075F, 0.06F, 10));
    return kit;
}

Kit build_train()
{
    Kit kit;
    kit.add(Stuff::iron, shapes::box({6.2F, 0.35F, 1.5F}), at({0.0F, 0.75F, 0.0F}));
    kit.add(Stuff::iron, shapes::cylinder(0.78F, 4.6F, 28), lying({-3.0F, 1.85F, 0.0F}));
    kit.add(Stuff::iron, shapes::box({1.6F, 2.4F, 1.9F}), at({2.3F, 1.0F, 0.0F}));
    kit.add(Stuff::iron, shapes::box({2.1F, 0.16F, 2.3F}), at({2.4F, 3.4F, 0.0F}));
    const std::array<glm::vec2, 6> chimney{
        {{0.0F, 0.0F}, {0.2F, 0.0F}, {0.2F, 0.9F}, {0.42F, 1.35F}, {0.36F, 1.5F}, {0.0F, 1.5F}}};
    kit.add(Stuff::iron, shapes::lathe(chimney, 20), at({-2.4F, 2.55F, 0.0F}));
    kit.add(Stuff::iron, shapes::sphere(0.36F, 16, 8), at({-0.9F, 2.62F, 0.0F}));
    kit.add(Stuff::iron, shapes::box({3.6F, 1.5F, 1.8F}), at({5.4F, 0.8F, 0.0F}));
    add_engine_wheels(kit);
    add_steam(kit, {-2.4F, 4.1F, 0.0F});
    return kit;
}

} // namespace square
