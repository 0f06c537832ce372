// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace estampe::app {

/// The options of `estampe normalmap` as the user typed them.
class NormalMapOptions {
public:
    /// Adds the command `normalmap` to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// Checks the typed options and returns them as a command: a NormalMapCommand, or with --from a
    /// NormalBakeCommand. Throws UsageError for invalid options.
    [[nodiscard]] Command read() const;

private:
    /// Adds the options of --from, and returns them.
    [[nodiscard]] std::vector<CLI::Option*> add_baking(CLI::App& command);
    [[nodiscard]] NormalBakeCommand read_baking() const;

    bool is_confined_ = false;
    std::string source_;
    std::string output_;
    double relief_ = NormalMapSettings().relief;
    std::string edges_ = "wrap";
    std::string green_ = "up";
    std::string from_;
    std::string frame_ = "triangles";
    double distance_m_ = 0.0;
    CLI::Option* distance_ = nullptr;
    NormalBakeSettings baking_;
};

} // namespace estampe::app
