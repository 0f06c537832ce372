// SPDX-License-Identifier: MIT
#pragma once

// What every command that draws begins with: the scene, its animation and its camera, and whether anything is
// in view.

#include <span>
#include <string>

#include <estampe/renderer.hpp>

#include "options.hpp"

namespace estampe::app {

/// The scene that `draw` names, on its terrain where it names one; a terrain's own file is a scene of nothing
/// else. Throws Error as load_scene() and load_terrain() do.
[[nodiscard]] Scene load_scene_of(const DrawOptions& draw);

/// Whether load_scene_of() gives the same scene for both.
[[nodiscard]] bool load_the_same(const DrawOptions& a, const DrawOptions& b);

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

/// The camera that `draw` asks for at its moment. Throws Error listing the file's cameras when it has none of
/// that name.
[[nodiscard]] Camera choose_camera(const DrawOptions& draw, const Scene& scene, Index animation);

/// Whether that is one of the scene's own, which may move.
[[nodiscard]] bool has_camera_of_file(const DrawOptions& draw, const Scene& scene);

/// Size, samples and moment of a picture.
[[nodiscard]] RenderSettings settings_of(const DrawOptions& draw, Index animation);

/// Gives the renderer the scene, with the lightmap that `draw` names, else with those that the scene's file
/// names. Throws Error when one cannot be read or is another scene's.
void set_scene(Renderer& renderer, const Scene& scene, const DrawOptions& draw);

/// Warns when nothing of the scene can be in the picture that `camera` takes of it: nothing is in view, or
/// only backs of one-sided surfaces are, as from inside a solid. Does nothing when the program placed the
/// camera.
void warn_of_empty_view(const DrawOptions& draw, const Scene& scene, Index animation, const Camera& camera);

/// Warns when nothing of the scene can be in the picture at any of these moments of a film.
void warn_of_empty_film(const DrawOptions& draw, const Scene& scene, Index animation,
                        std::span<const Moment> moments);

} // namespace estampe::app
