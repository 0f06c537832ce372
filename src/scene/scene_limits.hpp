// SPDX-License-Identifier: MIT
#pragma once

// Checks of the scenes that can be drawn: distance from the origin, size, number of vertices, and the
// structure of scenes that did not come from a reader of this library.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Largest distance from the origin in metres. At larger distances, squares and products of lengths exceed
/// the range of floats on the GPU.
inline constexpr double farthest_m = 1e12;
/// Radius of the smallest scene, in metres; smaller lengths underflow as floats on the GPU. A scene that is a
/// single point is allowed.
inline constexpr double least_radius_m = 1e-9;

/// Largest lens shift of a camera, as a share of the picture.
inline constexpr double farthest_shift = 100.0;

/// Throws Error naming `scene` unless `bounds` are finite, near enough to the origin, and neither too large
/// nor too small. Empty bounds are allowed.
void check_extent(const Bounds& bounds, const std::string& scene);

/// Throws Error naming a node unless all drawn positions in `pose` fit into floats.
void check_places(const Scene& scene, const ScenePose& pose);

/// Throws Error unless the numbers of the camera are finite and within the limits, and its view direction and
/// up vector are well defined.
void check_camera(const Camera& camera);

/// Returns those of the faults(scene) that would make code which draws the scene read outside of an array or
/// run forever: indices out of range, arrays whose lengths disagree, and nodes that form no forest. Cost:
/// linear in indices and nodes.
[[nodiscard]] std::vector<std::string> structural_faults(const Scene& scene);

/// Throws Error that names the first of the faults(scene), if there is one. `where` is the place of the
/// Error.
void check_faults(const Scene& scene, const std::string& where);

/// Number of vertices and triangles to draw. A mesh counts once for each node or instance that shows it.
struct DrawnSize {
    uint64_t vertices = 0;
    /// Number of triangles; lines and points count as the triangles with which they are drawn.
    uint64_t triangles = 0;
};

[[nodiscard]] DrawnSize drawn_size(const Scene& scene);

/// Throws Error when drawing the scene needs more memory than is available, or more vertices than can be
/// numbered with 31 bits. Even a small file can need so much, because it can show one mesh any number of
/// times. Messages name `where`, or the name of the scene if `where` is empty. Cost: linear in nodes and
/// primitives.
void check_drawn_size(const Scene& scene, const std::string& where = {});

} // namespace estampe
