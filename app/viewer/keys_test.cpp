// SPDX-License-Identifier: MIT
#include "viewer/keys.hpp"

#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/files.hpp"
#include "viewer/screen.hpp"

namespace estampe::viewer {
namespace {

TEST(ViewerKeys, EachKeyDoesOneThingAndEachThingHasOneKey)
{
    std::set<Action> actions;
    for (const KeyGroup& group : key_groups()) {
        for (const KeyHelp& help : group.keys) {
            if (help.action == Action::none) {
                continue;
            }
            EXPECT_TRUE(actions.insert(help.action).second) << help.name;
            const auto found = help.modifiers < 0 ? action_of_letter(static_cast<char32_t>(help.key))
                                                  : action_of_key(help.key, help.modifiers);
            EXPECT_EQ(found, help.action) << help.name;
        }
    }
    for (int action = 0; action < static_cast<int>(Action::none); ++action) {
        EXPECT_TRUE(actions.contains(static_cast<Action>(action))) << "no key for " << action;
    }
}

TEST(ViewerKeys, ModifiersTellKeysApart)
{
    EXPECT_EQ(action_of_key(GLFW_KEY_Z, GLFW_MOD_CONTROL), Action::undo);
    EXPECT_EQ(action_of_key(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT), Action::redo);
    EXPECT_EQ(action_of_key(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_NUM_LOCK), Action::undo);
    EXPECT_EQ(action_of_key(GLFW_KEY_Z, 0), std::nullopt);
    EXPECT_EQ(action_of_letter(U'Q'), Action::quit);
}

TEST(ViewerKeys, TheManualListsThem)
{
    std::ifstream file(test::source_folder() / "docs/how-to/viewer.md");
    std::ostringstream text;
    text << file.rdbuf();
    for (const KeyGroup& group : key_groups()) {
        for (const KeyHelp& help : group.keys) {
            const std::string line = fmt::format("| {} | {} |\n", help.name, help.help);
            EXPECT_NE(text.str().find(line), std::string::npos) << "docs/how-to/viewer.md lacks: " << line;
        }
    }
}

} // namespace
} // namespace estampe::viewer
