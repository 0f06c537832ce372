// SPDX-License-Identifier: MIT
#pragma once

// Limits of what can be drawn: distance, size and count.

#include <cstdint>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Largest distance from the origin at which the GPU can square and multiply lengths as floats.
inline constexpr double farthest_m = 1e12;
/// Radius of the smallest scene, for the same reason. A scene that is a single point is allowed.
inline constexpr double least_radius_m = 1e-9;

/// Throws Error naming `scene` unless `bounds` are finite, near enough, and neither too large nor too small.
/// Empty bounds are allowed.
void check_extent(const Bounds& bounds, const std::string& scene);

/// Throws Error naming a node unless floats can hold the position in `pose` of everything drawn.
void check_places(const Scene& scene, const ScenePose& pose);

/// Throws Error unless the camera's numbers are finite and near enough, and its directions of view and up are
/// defined.
void check_camera(const Camera& camera);

/// Number of vertices and triangles when every mesh is counted once for each place where it is shown.
struct DrawnSize {
    uint64_t vertices = 0;
    uint64_t triangles = 0; ///< lines and points count as the triangles that draw them
};

[[nodiscard]] DrawnSize drawn_size(const Scene& scene);

/// Throws Error when drawing the scene takes more memory than available, or more vertices than fit in 31
/// bits; a small file can show one mesh any number of times. Messages name `where`, or the scene's name if it
/// is empty. Cost: linear in nodes and primitives.
void check_drawn_size(const Scene& scene, const std::string& where = {});

} // namespace estampe
