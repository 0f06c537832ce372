// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/constants.hpp>

#include "lab/series.hpp"
#include "scene/shapes.hpp"

namespace estampe::lab {
namespace {

Index add_mesh(Scene& scene, Primitive primitive)
{
    scene.meshes.push_back({.primitives = {std::move(primitive)}});
    return static_cast<Index>(scene.meshes.size() - 1);
}

} // namespace

void add_root(Scene& scene, Node node)
{
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
}

Scene field_of_balls(double triangles)
{
    constexpr int balls_a_side = 8;
    constexpr int balls = balls_a_side * balls_a_side;
    // A ball of 2 n by n faces has 4 n^2 triangles.
    const auto rings = static_cast<uint32_t>(std::lround(std::max(std::sqrt(triangles / balls / 4.0), 3.0)));
    Scene scene;
    scene.materials.push_back({.name = "chalk"});
    const Index floor =
        add_mesh(scene, shapes::plane(static_cast<float>(field_m), static_cast<float>(field_m), 32));
    const Index ball = add_mesh(scene, shapes::sphere(1.2F, 2 * rings, rings));
    add_root(scene, {.name = "floor", .mesh = floor});
    for (int i = 0; i < balls; ++i) {
        const int row = i / balls_a_side;
        const int column = i % balls_a_side;
        const double x = (column - 3.5) * field_m / balls_a_side;
        const double z = (row - 3.5) * field_m / balls_a_side;
        add_root(scene, {.name = "ball", .transform = {.translation = {x, 1.2, z}}, .mesh = ball});
    }
    scene.lights.push_back({.type = LightType::ambient, .intensity = 0.1F});
    add_root(scene, {.light = 0});
    return scene;
}

Camera view_of_field()
{
    return {.eye = {0.0, 22.0, 34.0}, .target = {0.0, 0.0, 2.0}, .vertical_fov_rad = 0.8};
}

void add_lights(Scene& scene, uint32_t count, uint32_t shadowed)
{
    std::mt19937 random(11);
    const auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double reach_m =
        std::clamp(std::sqrt(3.0 * field_m * field_m / (glm::pi<double>() * count)), 1.5, 12.0);
    for (uint32_t i = 0; i < count; ++i) {
        const bool casts = i < shadowed;
        const bool is_spot = casts ? i % 2 == 0 : i % 3 == 0;
        Light light{.type = is_spot ? LightType::spot : LightType::point,
                    .color = glm::vec3(between(0.5, 1.0), between(0.5, 1.0), between(0.5, 1.0)),
                    .intensity = static_cast<float>(0.4 * reach_m * reach_m),
                    .range_m = static_cast<float>(reach_m),
                    .inner_cone_rad = 0.3F,
                    .outer_cone_rad = 0.7F};
        light.casters = casts ? all_groups : Groups{0};
        const glm::dvec3 place(between(-0.5, 0.5) * field_m, between(0.2, 0.6) * reach_m + 1.0,
                               between(-0.5, 0.5) * field_m);
        const glm::dquat down = glm::angleAxis(-glm::half_pi<double>(), glm::dvec3(1.0, 0.0, 0.0));
        add_root(scene, {.transform = {.translation = place, .rotation = down},
                         .light = static_cast<Index>(scene.lights.size())});
        scene.lights.push_back(light);
    }
}

void animate_shadowed(Scene& scene, uint32_t shadowed)
{
    Animation circle{.name = "circle", .duration_s = 1.0F};
    const size_t first = scene.nodes.size() - (scene.lights.size() - 1);
    for (uint32_t i = 0; i < shadowed; ++i) {
        const auto node = static_cast<Index>(first + i);
        const glm::vec3 middle(scene.nodes[node].transform.translation);
        AnimationChannel channel{.node = node, .path = AnimatedPath::translation};
        for (int k = 0; k <= 8; ++k) {
            const float angle = glm::two_pi<float>() * static_cast<float>(k) / 8.0F;
            channel.times_s.push_back(static_cast<float>(k) / 8.0F);
            channel.values.insert(channel.values.end(), {middle.x + 0.3F * std::cos(angle), middle.y,
                                                         middle.z + 0.3F * std::sin(angle)});
        }
        circle.channels.push_back(std::move(channel));
    }
    scene.animations.push_back(std::move(circle));
}

} // namespace estampe::lab
