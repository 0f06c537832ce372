// SPDX-License-Identifier: MIT
#pragma once

// What can be drawn: how far, how large and how much.

#include <cstdint>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// How far anything may be from the origin, so that the device can square and multiply lengths as floats.
inline constexpr double farthest_m = 1e12;
/// The radius of the smallest scene, for the same reason; a scene of one place has none.
inline constexpr double least_radius_m = 1e-9;

/// Throws Error naming `scene` unless what `bounds` holds can be drawn: finite, near enough, and neither too
/// large nor too small. Nothing at all can be.
void check_extent(const Bounds& bounds, const std::string& scene);

/// Throws Error naming a node unless everything drawn has a place in `pose` that floats can hold.
void check_places(const Scene& scene, const ScenePose& pose);

/// Throws Error unless the camera's numbers are finite and near enough, and it looks somewhere with something
/// above it.
void check_camera(const Camera& camera);

/// What a scene comes to when every mesh is put everywhere it is shown.
struct DrawnSize {
    uint64_t vertices = 0;
    uint64_t triangles = 0; ///< lines and points count as many as they are drawn with
};

[[nodiscard]] DrawnSize drawn_size(const Scene& scene);

/// Throws Error when drawing the scene takes more memory than there is, or more vertices than 31 bits number:
/// a small file can show one mesh any number of times. `where` stands in the message, else the scene's name.
/// Cost: linear in nodes and primitives.
void check_drawn_size(const Scene& scene, const std::string& where = {});

} // namespace estampe
