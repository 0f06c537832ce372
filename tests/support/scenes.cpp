// SPDX-License-Identifier: MIT
#include "support/scenes.hpp"

#include <cmath>
#include <utility>

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

Camera front_camera(double distance_m, double vertical_fov_rad)
{
    return {.eye = {0.0, 0.0, distance_m}, .vertical_fov_rad = vertical_fov_rad, .near_m = 0.01};
}

} // namespace estampe::test
