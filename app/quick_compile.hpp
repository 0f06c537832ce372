// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace estampe::app {

/// Has Mesa's processor drivers compile without optimisation: half to two thirds of the time from an empty
/// cache to a picture, frames a fifth to a half slower, the same bytes. Sets GALLIVM_PERF if the user has
/// not; other drivers do not know it. To be called before a device is opened and before threads start.
/// Returns whether it did.
bool compile_quickly();

/// Takes it back for a process that was started by one of which that holds, before it opens a device.
void compile_well();

/// Does it for one picture of at most four megapixels, samples counted.
void compile_quickly_if_soon_drawn(const RenderCommand& command);

} // namespace estampe::app
