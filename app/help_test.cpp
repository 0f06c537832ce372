// SPDX-License-Identifier: MIT
#include "help.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

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

/// What the program prints for `words` before it ends.
std::string printed(const std::vector<const char*>& words)
{
    testing::internal::CaptureStdout();
    EXPECT_FALSE(read_command_line(static_cast<int>(words.size()), words.data()));
    return testing::internal::GetCapturedStdout();
}

/// Every command and option of the manual page, which walks them all.
std::vector<Entry> entries()
{
    std::istringstream page(printed({"estampe", "--man"}));
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

/// How many lines of a help text are about an option: that is how often they name it.
std::map<std::string, size_t> options_of(const std::string& help)
{
    std::map<std::string, size_t> counts;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  -")) {
            const size_t dashes = line.find("--");
            ++counts[line.substr(dashes, line.find_first_of(" [\n", dashes) - dashes)];
        }
    }
    return counts;
}

TEST(CommandLineHelp, HelpOfRenderFitsAScreen)
{
    const std::string help = printed({"estampe", "render", "--help"});
    EXPECT_LE(std::ranges::count(help, '\n'), 60) << help;
    EXPECT_EQ(help.find("\nOptions:"), std::string::npos) << "an option is in no group\n" << help;
    EXPECT_NE(help.find("--help-all"), std::string::npos);
}

TEST(CommandLineHelp, EveryOptionHasOneLineInOneGroup)
{
    size_t commands = 0;
    for (const Entry& entry : entries()) {
        if (!entry.name.starts_with("estampe ")) {
            continue;
        }
        ++commands;
        const std::string command = entry.name.substr(entry.name.find(' ') + 1);
        const std::string help = printed({"estampe", command.c_str(), "--help"});
        std::istringstream lines(help);
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 100U) << command << ": " << line;
        }
        const std::map<std::string, size_t> short_help = options_of(help);
        const std::map<std::string, size_t> full_help =
            options_of(printed({"estampe", command.c_str(), "--help-all"})); // its examples name some again
        for (const auto& [option, count] : short_help) {
            EXPECT_EQ(count, 1U) << command << " " << option;
            EXPECT_TRUE(full_help.contains(option)) << command << " " << option;
        }
        EXPECT_EQ(short_help.size(), full_help.size()) << command;
    }
    EXPECT_GE(commands, 9U);
}

TEST(CommandLineHelp, ShortLinesAreFirstSentences)
{
    const std::string help = printed({"estampe", "render", "--help"});
    EXPECT_NE(help.find("  --size WxH            Width and height of the picture in pixels [1280x720]\n"),
              std::string::npos)
        << help;
    EXPECT_NE(help.find("Picture format when writing to standard output [png]\n"), std::string::npos);
    EXPECT_NE(printed({"estampe", "render", "--help-all"}).find("Formats are png, jpg,"), std::string::npos);
}

} // namespace
} // namespace estampe::app
