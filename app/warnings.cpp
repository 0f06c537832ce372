// SPDX-License-Identifier: MIT
#include "warnings.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace estampe::app {

void print_warnings(const std::vector<std::string>& warnings)
{
    for (const std::string& warning : warnings) {
        say(fmt::format("estampe: warning: {}\n", shortened(one_line(warning))));
    }
}

void print_notes(const std::vector<std::string>& notes)
{
    for (const std::string& note : notes) {
        say(fmt::format("estampe: note: {}\n", shortened(one_line(note))));
    }
}

} // namespace estampe::app
