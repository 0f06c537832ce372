// SPDX-License-Identifier: MIT
#include "support/scenes.hpp"

#include <cmath>
#include <numbers>

namespace estampe::test {

Index add_object(Scene& scene, Primitive primitive, const glm::vec3& color, const glm::dvec3& place)
{
    primitive.material = static_cast<Index>(scene.materials.size());
    scene.materials.push_back({.base_color = glm::vec4(color, 1.0F), .double_sided = true});
    scene.meshes.push_back({.primitives = {std::move(primitive)}});
    const auto node = static_cast<Index>(scene.nodes.size());
    scene.nodes.push_back({.transform = {.translation = place}, .mesh = static_cast<Index>(scene.meshes.size() - 1)});
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

Primitive wall(float side_m)
{
    const float h = 0.5F * side_m;
    Primitive primitive;
    primitive.positions = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

Primitive sphere(uint32_t rings)
{
    Primitive primitive;
    const uint32_t sectors = 2 * rings;
    for (uint32_t ring = 0; ring <= rings; ++ring) {
        for (uint32_t sector = 0; sector <= sectors; ++sector) {
            const float theta = std::numbers::pi_v<float> * static_cast<float>(ring) / static_cast<float>(rings);
            const float phi = 2.0F * std::numbers::pi_v<float> * static_cast<float>(sector % sectors) /
                              static_cast<float>(sectors);
            primitive.positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                             std::sin(theta) * std::cos(phi));
        }
    }
    primitive.normals = primitive.positions;
    for (uint32_t ring = 0; ring < rings; ++ring) {
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const uint32_t a = ring * (sectors + 1) + sector;
            const uint32_t b = a + sectors + 1;
            if (ring > 0) {
                primitive.indices.insert(primitive.indices.end(), {a, b, a + 1});
            }
            if (ring + 1 < rings) {
                primitive.indices.insert(primitive.indices.end(), {a + 1, b, b + 1});
            }
        }
    }
    return primitive;
}

Camera front_camera(double distance_m, double vertical_fov_rad)
{
    return {.eye = {0.0, 0.0, distance_m}, .vertical_fov_rad = vertical_fov_rad, .near_m = 0.01};
}

} // namespace estampe::test
