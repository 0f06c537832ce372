// SPDX-License-Identifier: MIT
#pragma once

#include "animations.hpp"
#include "options.hpp"

namespace estampe::app {

/// The scene that `draw` names, on its terrain where it names one; a terrain's own file is a scene of nothing
/// else. Throws Error as load_scene() and load_terrain() do.
[[nodiscard]] Scene load_scene_of(const DrawOptions& draw);

/// Whether load_scene_of() gives the same scene for both.
[[nodiscard]] bool load_the_same(const DrawOptions& a, const DrawOptions& b);

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

} // namespace estampe::app
