// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/scene.hpp>

namespace estampe {

/// Turns a scene whose coordinates have `up` pointing up so that this axis becomes +y: all roots become
/// children of one new root node, so that cameras, lights, skins and animations turn with the meshes. What
/// was in front comes to +z: of z up it is -y, as Blender exports glTF. Changes nothing if y is up already.
void turn_up(Scene& scene, UpAxis up);

/// Guesses which axis of the scene's coordinates points up, from its shape in the rest pose: a body rests on
/// a flat base, stands on the plane through the origin, and terrain faces the sky. Meant for file formats
/// that do not name their axis (.obj, .ply, .stl).
///
/// Returns `UpAxis::y` or `UpAxis::z` when the evidence for one clearly outweighs that for the other, and
/// nothing otherwise (a cube about the origin, a head without a base). Cost: linear in vertices and
/// triangles.
[[nodiscard]] std::optional<UpAxis> guess_up_axis(const Scene& scene);

} // namespace estampe
