// SPDX-License-Identifier: MIT
#pragma once

// Messages for failures that the standard library reports: memory that runs out, threads that cannot be
// started, files that cannot be reached.

#include <string>
#include <system_error>

#include <estampe/error.hpp>

namespace estampe {

/// Message of a program that has run out of memory. A constant, because no memory is left to compose it.
inline constexpr const char* out_of_memory =
    "out of memory; try a smaller --size or a lighter scene, or end other programs";

/// Returns the message of the exception that is being handled, as one line with a remedy. The messages of the
/// standard library's own exceptions are replaced, because they name a function and not a cause. Call this
/// function inside a catch block. Throws std::bad_alloc if the message does not fit into memory.
[[nodiscard]] std::string message_of_caught();

/// Returns the Error for a thread that could not be started. `what` says what failed. The error's remedy
/// depends on the cause: no memory for the stack of a thread, or a limit of the number of threads.
[[nodiscard]] Error no_thread(const std::string& what, const std::system_error& problem);

} // namespace estampe
