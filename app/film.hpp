// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace estampe::app {

/// Draws the frames that `command.film` asks for, and the film of them. Throws Error when a signal stopped
/// it, once the frame in hand is drawn and all that was drawn is whole.
void draw_film(const RenderCommand& command);

} // namespace estampe::app
