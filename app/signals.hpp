// SPDX-License-Identifier: MIT
#pragma once

namespace estampe::app {

/// From now on SIGINT, SIGTERM and SIGHUP still end the program, unless they were ignored before, but not
/// before it has removed what it was writing. A file beyond the limit of sizes is a failed write, and ends
/// nothing. To be called before any thread begins.
void watch_signals();

/// The next of those signals is told by was_told_to_stop() and ends nothing; one more ends the program.
void tell_of_signals();

/// Whether one has come since tell_of_signals().
[[nodiscard]] bool was_told_to_stop();

} // namespace estampe::app
