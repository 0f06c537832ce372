// SPDX-License-Identifier: MIT
#include <cstdio>

#include <fmt/format.h>

#include "commands.hpp"

namespace estampe::app {

void run(const StylesCommand& command)
{
    if (!command.style.empty()) {
        fmt::print("{}", Style::load(command.style).to_toml());
        return;
    }
    for (const std::string& name : Style::presets()) {
        fmt::print("{}\n", name);
    }
}

void run(const StyleManualCommand&)
{
    fmt::print("{}", Style::help());
}

} // namespace estampe::app
