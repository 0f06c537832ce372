// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace estampe::app {

/// The manual page of the whole program, estampe(1), for man: every command with its options, as --help has
/// them.
[[nodiscard]] std::string manual_page(const CLI::App& app);

} // namespace estampe::app
