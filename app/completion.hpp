// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace estampe::app {

/// A script by which bash completes commands, options, presets, parameters of the style, and files by what
/// the option takes.
[[nodiscard]] std::string bash_completion(const CLI::App& app);

} // namespace estampe::app
