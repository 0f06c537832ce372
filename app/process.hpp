// SPDX-License-Identifier: MIT
#pragma once

// Settings of the whole process, made before threads start: signal handling, and how Mesa compiles shaders.

#include "options.hpp"

namespace estampe::app {

/// Makes SIGINT, SIGTERM and SIGHUP remove unfinished output files before they end the program; signals that
/// were ignored before stay ignored. A file beyond the size limit becomes a failed write instead of ending
/// the program. Call this function before any thread starts.
void watch_signals();

/// Changes the effect of signals for a film: the next SIGINT, SIGTERM or SIGHUP only makes was_told_to_stop()
/// true; a second signal ends the program.
void tell_of_signals();

/// Returns whether a signal has arrived since tell_of_signals().
[[nodiscard]] bool was_told_to_stop();

/// Makes Mesa's CPU drivers compile shaders without optimisation. With an empty cache the first picture takes
/// half to two thirds of the time; frames are a fifth to a half slower, with identical bytes. Sets
/// GALLIVM_PERF unless the user has set it; other drivers ignore it. Call this before a device is opened and
/// before threads start. Returns whether the variable was set.
bool compile_quickly();

/// Undoes compile_quickly() in a child process that inherited it. Call this before a device is opened.
void compile_well();

/// Calls compile_quickly() if the command draws one picture of at most four megapixels, counting samples.
void compile_quickly_if_soon_drawn(const RenderCommand& command);

} // namespace estampe::app
