// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace estampe::app {

/// Draws what `command` asks for, which is no film, of a scene that the renderer has, and writes its files.
/// Throws Error when it cannot.
void draw_and_write(Renderer& renderer, const Scene& scene, const RenderCommand& command);

} // namespace estampe::app
