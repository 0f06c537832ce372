// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "options.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The options of `estampe normalmap` as the user typed them.
class NormalMapOptions {
public:
    /// Adds the command `normalmap` to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// Checks the typed options and returns them as a command. Throws UsageError for invalid options.
    [[nodiscard]] NormalMapCommand read() const;

private:
    std::string picture_;
    std::string output_;
    double relief_ = NormalMapSettings().relief;
    std::string edges_ = "wrap";
    std::string green_ = "up";
};

} // namespace estampe::app
