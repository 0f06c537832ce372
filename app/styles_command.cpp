// SPDX-License-Identifier: MIT
#include <cstdio>

#include <fmt/format.h>

#include "commands.hpp"

namespace estampe::app {

void run(const StylesCommand& command)
{
    if (command.schema) {
        fmt::print("{}", Style::json_schema());
        return;
    }
    if (!command.style.empty()) {
        fmt::print("{}", Style::load(command.style).to_toml());
        return;
    }
    for (const std::string& name : Style::presets()) {
        fmt::print("{:<13} {}\n", name, Style::about(name));
    }
}

void run(const StyleManualCommand&)
{
    fmt::print("{}", Style::help());
}

} // namespace estampe::app
