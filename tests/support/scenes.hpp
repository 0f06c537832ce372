// SPDX-License-Identifier: MIT
#pragma once

// Scenes that tests make for themselves.

#include <estampe/scene.hpp>

namespace estampe::test {

/// A scene of one node that shows `primitive` in a white, two-sided material.
[[nodiscard]] Scene scene_of(Primitive primitive);

/// Adds a node with `primitive` in a new material of that colour; returns the node.
Index add_object(Scene& scene, Primitive primitive, const glm::vec3& color,
                 const glm::dvec3& place = glm::dvec3(0.0));

/// Adds a directional light that comes from `towards_light`.
void add_sun(Scene& scene, const glm::dvec3& towards_light, float intensity = 1.0F);

/// A square 400 m long under open sky: arcades along both sides, a tower, a ring. Its floor is at y = 0.
[[nodiscard]] Scene long_square();

/// A camera on the +z axis that looks back along it.
[[nodiscard]] Camera front_camera(double distance_m, double vertical_fov_rad);

} // namespace estampe::test
