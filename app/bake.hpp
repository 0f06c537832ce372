// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "option_values.hpp"
#include "options.hpp"
#include "worlds.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The options of `estampe bake` as the user typed them.
class BakeOptions {
public:
    /// Adds the command `bake` to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// Checks the typed options and returns them as a command. Throws UsageError for invalid options, Error
    /// for a style that cannot be read.
    [[nodiscard]] BakeCommand read() const;

private:
    std::string scene_;
    SceneOptions input_;
    LimitOptions limits_;
    WorldOptions world_;
    std::string output_;
    std::string style_;
    std::vector<std::string> assignments_;
    BakeSettings settings_;
    std::vector<std::string> direct_;
    bool rough_ = false;
    bool anew_ = false;
};

} // namespace estampe::app
