// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/scene.hpp>

namespace estampe {

/// Rotates a scene so that its axis `up` becomes +y: all roots become children of one new root node, so that
/// cameras, lights, skins and animations rotate with the meshes. The front becomes +z; with z up, the front
/// was -y, as in Blender's glTF export. Changes nothing if y is up already.
void turn_up(Scene& scene, UpAxis up);

/// Guesses which axis of the scene's coordinates points up, from its shape in the rest pose: a body rests on
/// a flat base or stands on the plane through the origin, and terrain faces the sky. Meant for file formats
/// that do not name their axis (.obj, .ply, .stl).
///
/// Returns `UpAxis::y` or `UpAxis::z` when the evidence for one clearly outweighs that for the other, and
/// nothing otherwise (a cube about the origin, a head without a base). Cost: linear in vertices and
/// triangles.
[[nodiscard]] std::optional<UpAxis> guess_up_axis(const Scene& scene);

} // namespace estampe
