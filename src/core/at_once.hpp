// SPDX-License-Identifier: MIT
#pragma once

#include <future>

namespace estampe {

/// How std::async is to run what has time: in a thread of its own at once, or, where no thread can be
/// started, when its result is asked for.
inline constexpr std::launch at_once = std::launch::async | std::launch::deferred;

} // namespace estampe
