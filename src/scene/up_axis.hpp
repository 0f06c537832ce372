// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/scene.hpp>

namespace estampe {

/// Guesses which axis of the scene's coordinates points up, from its shape in the rest pose: a body rests on
/// a flat base, stands on the plane through the origin, and terrain faces the sky. Meant for file formats
/// that do not name their axis (.obj, .ply, .stl).
///
/// Returns `UpAxis::y` or `UpAxis::z` when the evidence for one clearly outweighs that for the other, and
/// nothing otherwise (a cube about the origin, a head without a base). Cost: linear in vertices and
/// triangles.
[[nodiscard]] std::optional<UpAxis> guess_up_axis(const Scene& scene);

} // namespace estampe
