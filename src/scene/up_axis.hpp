// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/scene.hpp>

namespace estampe {

/// Rotates a scene so that its axis `up` becomes +y. All root nodes become children of a new root node, so
/// that cameras, lights, skins and animations rotate with the meshes. The front of the scene becomes +z. If z
/// is up, -y is the old front, as in Blender's glTF export. Changes nothing if y is up already.
void turn_up(Scene& scene, UpAxis up);

/// Guesses which coordinate axis of the scene points up, from its shape in the rest pose. An object rests on
/// a flat base or stands on the plane through the origin, and terrain faces the sky. Intended for file
/// formats that do not specify their up axis (.obj, .ply, .stl).
///
/// Returns `UpAxis::y` or `UpAxis::z` when the evidence for one axis is clearly stronger. Returns nothing if
/// the evidence is weak, as for a cube centred at the origin or a head without a base. Cost: linear in
/// vertices and triangles.
[[nodiscard]] std::optional<UpAxis> guess_up_axis(const Scene& scene);

} // namespace estampe
