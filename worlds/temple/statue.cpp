// SPDX-License-Identifier: MIT
#include "statue.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

namespace temple {
namespace {

namespace shapes = estampe::shapes;

void add_egg(Kit& kit, const glm::mat4& placed, const glm::vec3& half_m)
{
    kit.add(Stuff::marble, shapes::sphere(1.0F, 36, 22), glm::scale(placed, half_m));
}

void limb(Kit& kit, const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b)
{
    kit.add(Stuff::marble, rod(a, b, radius_a, radius_b, 24));
}

} // namespace

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
    // What is left of the trunk, and one forearm on its rest.
    limb(kit, {0.0F, 5.6F, -1.9F}, {0.0F, 8.0F, -2.1F}, 1.7F, 1.5F);
    limb(kit, {0.0F, 8.3F, -2.1F}, {0.5F, 9.4F, -2.2F}, 1.55F, 0.9F);
    limb(kit, {3.0F, 6.75F, -1.2F}, {3.0F, 6.7F, 1.4F}, 0.5F, 0.4F);
    limb(kit, {3.0F, 6.7F, 1.6F}, {3.0F, 6.6F, 2.2F}, 0.42F, 0.2F);
    return kit;
}

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
    // Its folds fall straight, deeper towards the hem.
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

} // namespace temple
