// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace estampe::app {

/// Has Mesa's processor drivers compile without optimisation for one picture of at most four megapixels,
/// samples counted: a third less time from an empty cache to the picture, frames a fifth to a half slower,
/// the same bytes. Sets GALLIVM_PERF if the user has not; other drivers do not know it. To be called before a
/// device is opened and before threads start.
void compile_quickly_if_soon_drawn(const RenderCommand& command);

} // namespace estampe::app
