// SPDX-License-Identifier: MIT
#pragma once

// Settings of the whole process, made before threads start: signal handling, and how Mesa compiles shaders.

#include "options.hpp"

namespace estampe::app {

/// Makes SIGINT, SIGTERM and SIGHUP remove unfinished output files before they end the program; signals that
/// were ignored before stay ignored. If a file exceeds the system's size limit, the write fails, but the
/// program does not end. Call this function before any thread starts.
void watch_signals();

/// Makes the program end with its usual message and without temporary files if memory runs out where no
/// exception can pass: libraries allocate in destructors (nlohmann/json) and in noexcept functions (CLI11,
/// toml++).
void end_well_without_memory();

/// Changes the effect of signals for a film: the next SIGINT, SIGTERM or SIGHUP only makes was_told_to_stop()
/// true; a second signal ends the program.
void tell_of_signals();

/// Returns whether a signal has arrived since tell_of_signals().
[[nodiscard]] bool was_told_to_stop();

/// Makes Mesa's CPU drivers compile shaders without optimisation. If no compiled shader is cached, the first
/// picture then takes half to two thirds of the time. Shaders without optimisation draw each frame a fifth to
/// a half more slowly, with identical bytes. Sets GALLIVM_PERF unless the user has set it; other drivers
/// ignore it. Call this before a device is opened and before threads start. Returns whether the variable was
/// set.
bool compile_quickly();

/// Undoes compile_quickly() in a child process, which inherits the environment variable GALLIVM_PERF. Call
/// this before a device is opened.
void compile_well();

/// Calls compile_quickly() if the command draws a single picture of at most four megapixels. Each sample of a
/// pixel counts as a pixel.
void compile_quickly_if_soon_drawn(const RenderCommand& command);

} // namespace estampe::app
