// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "options.hpp"

namespace estampe::app {

/// What --animation takes in place of a name, to play all animations together.
inline constexpr const char* all_animations = "all";

/// Appends an animation named "all" that plays all animations of the scene together, as long as the longest:
/// the others stay at their last key when they have ended. Where several animate the same property of the
/// same node the first of them counts, and a warning says so. Returns whether there was no such conflict.
/// Does nothing for a scene with fewer than two animations, or with one named "all".
bool add_all_animations(Scene& scene);

/// The animation that `draw` asks for. Throws Error listing the file's animations when it has none of that
/// name.
[[nodiscard]] Index choose_animation(const DrawOptions& draw, const Scene& scene);

/// One line that says which animation is played, and the names of the others; empty unless the scene has
/// several, and none was asked for.
[[nodiscard]] std::string note_of_animations(const DrawOptions& draw, const Scene& scene);

} // namespace estampe::app
