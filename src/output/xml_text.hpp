// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace estampe::output {

/// Text between quotes: what XML would take for its own is written out, what it cannot hold becomes a space
/// or a question mark.
[[nodiscard]] std::string escaped(const std::string& text);

} // namespace estampe::output
