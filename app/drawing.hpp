// SPDX-License-Identifier: MIT
#pragma once

// Functions for the first steps of every command that draws. They load the scene, choose animation and
// camera, and check that something is in view.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "options.hpp"

namespace estampe::app {

/// Loads the scene that `draw` names, and puts the scene on a terrain if `draw` names one. A terrain file
/// alone becomes a scene with only a terrain. Throws Error as load_scene() and load_terrain() do.
[[nodiscard]] Scene load_scene_of(const DrawOptions& draw);

/// Returns the files from which the pictures of `draw` are made: those of its scene, its terrain and its
/// lightmap, and those that its style names.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const DrawOptions& draw, const Scene& scene);

/// Returns the scope in which input_files() may be read; without a limit if `draw` is not confined.
[[nodiscard]] ReadScope input_scope(const DrawOptions& draw);

/// Returns whether load_scene_of() returns equal scenes for `a` and `b`.
[[nodiscard]] bool load_the_same(const DrawOptions& a, const DrawOptions& b);

/// Appends an animation named "all" that plays all animations of the scene together. The animation "all" is
/// as long as the longest animation; shorter animations hold their last key. If several animations change one
/// property of one node, the first is used and a warning says so. Returns true if no two animations change
/// one property of one node. Does nothing for a scene with fewer than two animations, or with an animation
/// named "all".
bool add_all_animations(Scene& scene);

/// Returns the animation that `draw` selects. If no animation has the given name, throws an Error that lists
/// the file's animations.
[[nodiscard]] Index choose_animation(const DrawOptions& draw, const Scene& scene);

/// Returns a line of text that names the animation that is played, and the other animations. Empty unless the
/// scene has several and `draw` chose none.
[[nodiscard]] std::string note_of_animations(const DrawOptions& draw, const Scene& scene);

/// Returns the camera that `draw` selects, at the time of `draw`. If no camera has the given name, throws an
/// Error that lists the file's cameras.
[[nodiscard]] Camera choose_camera(const DrawOptions& draw, const Scene& scene, Index animation);

/// Returns whether `draw` selects one of the scene's own cameras, which may move.
[[nodiscard]] bool has_camera_of_file(const DrawOptions& draw, const Scene& scene);

/// Returns the render settings of a picture: size, samples and time.
[[nodiscard]] RenderSettings settings_of(const DrawOptions& draw, Index animation);

/// Sets the renderer's scene and its lightmaps: the lightmap that `draw` names, or otherwise the lightmaps
/// that the scene's file names. Throws Error when a lightmap cannot be read or belongs to another scene.
void set_scene(Renderer& renderer, const Scene& scene, const DrawOptions& draw);

/// Warns when `camera` sees nothing of the scene: nothing is in view, or only backs of one-sided surfaces are
/// in view, as from inside a solid. Does nothing when the program placed the camera itself.
void warn_of_empty_view(const DrawOptions& draw, const Scene& scene, Index animation, const Camera& camera);

/// Warns when nothing of the scene is in view at any of the given times of a film.
void warn_of_empty_film(const DrawOptions& draw, const Scene& scene, Index animation,
                        std::span<const Moment> moments);

} // namespace estampe::app
