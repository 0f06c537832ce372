// SPDX-License-Identifier: MIT
#include "help.hpp"

#include <array>
#include <sstream>

#include <gtest/gtest.h>

#include "options.hpp"
#include "support/help_rules.hpp"

namespace estampe::app {
namespace {

/// What the manual page says, as `man -l -` would show it.
std::string plain_text(const std::string& roff)
{
    std::string text;
    for (size_t i = 0; i < roff.size(); ++i) {
        if (roff[i] != '\\') {
            text += roff[i];
            continue;
        }
        ++i;
        text += roff[i] == '-' ? "-" : roff[i] == 'e' ? "\\" : "";
        i += roff[i] == 'f' ? 1 : 0; // the name of a font
    }
    return text;
}

struct Entry {
    std::string name;
    std::string help;
};

/// Every command and option of the manual page, which walks them all.
std::vector<Entry> entries()
{
    constexpr std::array words{"estampe", "--man"};
    testing::internal::CaptureStdout();
    EXPECT_FALSE(read_command_line(static_cast<int>(words.size()), words.data()));
    std::istringstream page(testing::internal::GetCapturedStdout());
    std::vector<Entry> found;
    bool is_text = false;
    for (std::string line; std::getline(page, line) && line != ".SH EXAMPLES";) {
        const bool is_command = line.starts_with(".SS ");
        if (is_command || line == ".TP") {
            std::string heading = line.substr(std::min<size_t>(line.size(), 4));
            if (!is_command) {
                std::getline(page, heading);
            }
            found.push_back({plain_text(heading), {}});
            is_text = true;
        } else if (line.starts_with('.')) {
            is_text = false;
        } else if (is_text) {
            found.back().help += plain_text(line) + "\n";
        }
    }
    return found;
}

TEST(CommandLineHelp, EveryLineStandsAlone)
{
    const std::vector<Entry> all = entries();
    EXPECT_GT(all.size(), 90U);
    for (const Entry& entry : all) {
        std::string help = entry.help;
        if (entry.name.starts_with("estampe ")) { // the page ends descriptions of commands
            ASSERT_TRUE(help.ends_with(".\n")) << entry.name;
            help.resize(help.size() - 2);
        }
        EXPECT_EQ(test::fault_of_help(help), "") << entry.name << ": " << help;
    }
}

} // namespace
} // namespace estampe::app
