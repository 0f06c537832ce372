// SPDX-License-Identifier: MIT
#include "support/scenes.hpp"

#include <cmath>
#include <utility>

#include <estampe/shapes.hpp>

namespace estampe::test {

Index add_object(Scene& scene, Primitive primitive, const glm::vec3& color, const glm::dvec3& place)
{
    primitive.material = static_cast<Index>(scene.materials.size());
    scene.materials.push_back({.base_color = glm::vec4(color, 1.0F), .double_sided = true});
    scene.meshes.push_back({.primitives = {std::move(primitive)}});
    const auto node = static_cast<Index>(scene.nodes.size());
    scene.nodes.push_back(
        {.transform = {.translation = place}, .mesh = static_cast<Index>(scene.meshes.size() - 1)});
    scene.roots.push_back(node);
    return node;
}

Scene scene_of(Primitive primitive)
{
    Scene scene;
    add_object(scene, std::move(primitive), glm::vec3(1.0F));
    return scene;
}

void add_sun(Scene& scene, const glm::dvec3& towards_light, float intensity)
{
    // A light shines along its node's -z, so the node's +z points to the light.
    const glm::dvec3 z = glm::normalize(towards_light);
    const glm::dvec3 helper = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(helper, z));
    scene.lights.push_back({.type = LightType::directional, .intensity = intensity});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back({.transform = {.rotation = glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z))},
                           .light = static_cast<Index>(scene.lights.size() - 1)});
}

Scene long_square()
{
    Scene scene = scene_of(shapes::plane(500.0F, 200.0F));
    for (int i = -40; i <= 40; ++i) {
        add_object(scene, shapes::box({0.6F, 4.0F, 0.6F}), glm::vec3(1.0F), {5.0 * i, 0.0, -6.0});
        add_object(scene, shapes::box({0.9F, 5.0F, 0.9F}), glm::vec3(1.0F), {6.1 * i, 0.0, 16.0});
    }
    add_object(scene, shapes::box({400.6F, 0.8F, 1.2F}), glm::vec3(1.0F), {0.0, 4.0, -6.0});
    add_object(scene, shapes::box({6.0F, 20.0F, 6.0F}), glm::vec3(1.0F), {45.0, 0.0, 30.0});
    add_object(scene, shapes::torus(1.5F, 0.4F), glm::vec3(1.0F), {12.0, 1.0, 3.0});
    return scene;
}

Camera front_camera(double distance_m, double vertical_fov_rad)
{
    return {.eye = {0.0, 0.0, distance_m}, .vertical_fov_rad = vertical_fov_rad, .near_m = 0.01};
}

} // namespace estampe::test
