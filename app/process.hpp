// SPDX-License-Identifier: MIT
#pragma once

// What is set for the whole process before its threads begin: the signals that it heeds, and how Mesa
// compiles.

#include "options.hpp"

namespace estampe::app {

/// From now on SIGINT, SIGTERM and SIGHUP still end the program, unless they were ignored before, but not
/// before it has removed what it was writing. A file beyond the limit of sizes is a failed write, and ends
/// nothing. To be called before any thread begins.
void watch_signals();

/// The next of those signals is told by was_told_to_stop() and ends nothing; one more ends the program.
void tell_of_signals();

/// Whether one has come since tell_of_signals().
[[nodiscard]] bool was_told_to_stop();

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
