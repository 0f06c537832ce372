// SPDX-License-Identifier: MIT
#pragma once

// Scenes that tests build.

#include <estampe/scene.hpp>

namespace estampe::test {

/// A scene of one node that shows `primitive` in a white, two-sided material.
[[nodiscard]] Scene scene_of(Primitive primitive);

/// Adds a node with `primitive` in a new material of colour `color`. Returns the node.
Index add_object(Scene& scene, Primitive primitive, const glm::vec3& color,
                 const glm::dvec3& place = glm::dvec3(0.0));

/// Adds a directional light that comes from `towards_light`.
void add_sun(Scene& scene, const glm::dvec3& towards_light, float intensity = 1.0F);

/// A square 400 m long under open sky, with arcades along both sides, a tower and a ring. Its floor is at y =
/// 0.
[[nodiscard]] Scene long_square();

/// Looks down at a corner of an object at the origin.
inline const Camera corner_camera{.eye = {3.0, 3.0, 5.0}, .target = {0.0, 0.5, 0.0}};

/// A camera on the +z axis that looks back along it.
[[nodiscard]] Camera front_camera(double distance_m, double vertical_fov_rad);

} // namespace estampe::test
