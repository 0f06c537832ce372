// SPDX-License-Identifier: MIT
#pragma once

// The layout of the help pages: --help and --help-all.

#include <CLI/CLI.hpp>

namespace estampe::app {

/// Prints the options of a command in groups. --help prints one line per option: the first sentence of its
/// description, with the default in brackets if the line has room for it. --help-all prints whole
/// descriptions, and everything below the options: examples, keys, file formats.
class HelpPage : public CLI::Formatter {
public:
    HelpPage();

    [[nodiscard]] std::string make_help(const CLI::App* app, std::string name,
                                        CLI::AppFormatMode mode) const override;

    [[nodiscard]] std::string make_usage(const CLI::App* app, std::string name) const override;

    [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
};

} // namespace estampe::app
