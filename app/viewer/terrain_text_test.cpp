// SPDX-License-Identifier: MIT
#include "viewer/terrain_edit.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "support/files.hpp"

namespace estampe::viewer {
namespace {

const std::string commented = "# A sea of sand\n"
                              "[terrain]\n"
                              "height = \"swell + 'small'\"   # metres\n"
                              "\n"
                              "[nodes]\n"
                              "  # the large one\n"
                              "swell = '6 * fbm(600)' # slow\n"
                              "small = 2\n"
                              "[wind]\n"
                              "towards_deg = 70 # from the sea\n";

TerrainDescription description(const std::string& text)
{
    return parse_terrain(text, "test.toml");
}

/// The text after a change of its terrain.
TerrainText changed(const std::string& text, const std::function<void(TerrainDescription&)>& change)
{
    TerrainDescription terrain = description(text);
    change(terrain);
    TerrainText result = text_with(text, terrain);
    EXPECT_EQ(terrain_toml(description(result.text)), terrain_toml(terrain)) << result.text;
    return result;
}

std::string replaced(std::string text, const std::string& before, const std::string& after)
{
    return text.replace(text.find(before), before.size(), after);
}

TEST(TerrainText, WhatIsNotChangedStaysAsItIs)
{
    EXPECT_EQ(changed(commented, [](auto&) {}).text, commented);
}

TEST(TerrainText, AValueIsChangedInItsLine)
{
    const TerrainText text = changed(commented, [](TerrainDescription& terrain) {
        terrain.nodes[0].expression = "swell + \"small\"";
        terrain.nodes[1].expression = "7 * fbm(600)";
        terrain.wind.towards_deg = 45.0F;
    });
    EXPECT_TRUE(text.keeps_comments);
    EXPECT_EQ(text.text,
              replaced(replaced(replaced(commented, "\"swell + 'small'\"", "\"swell + \\\"small\\\"\""),
                                "'6 * fbm(600)'", "\"7 * fbm(600)\""),
                       "= 70 #", "= 45 #"));
}

TEST(TerrainText, NodesComeAndGo)
{
    const TerrainText text = changed(commented, [](TerrainDescription& terrain) {
        terrain.nodes.erase(terrain.nodes.begin() + 2);
        terrain.nodes.push_back({"crest", "3", ""});
        terrain.ripples.height_m = 0.0F;
    });
    EXPECT_EQ(text.text,
              replaced(commented, "small = 2\n", "crest = \"3\"\n") + "\n[ripples]\nheight_m = 0\n");
}

TEST(TerrainText, ANodeOfAnotherNameStaysInItsLine)
{
    const TerrainText text = changed(commented, [](TerrainDescription& terrain) {
        terrain.nodes[0].expression = "rise + 'small'";
        terrain.nodes[1].name = "rise";
    });
    EXPECT_EQ(text.text, replaced(replaced(commented, "swell = '6", "rise = '6"), "\"swell + 'small'\"",
                                  "\"rise + 'small'\""));
}

TEST(TerrainText, WhatIsNoLineOfItsOwnIsWrittenAnew)
{
    const std::string many = "[terrain]\nheight = \"\"\"\n2 +\n3\"\"\" # five\n";
    const TerrainText text =
        changed(many, [](TerrainDescription& terrain) { terrain.nodes[0].expression = "6"; });
    EXPECT_FALSE(text.keeps_comments);
    EXPECT_TRUE(text_with("", description(commented)).keeps_comments) << "there were none";
    EXPECT_FALSE(text_with("not [ TOML # at all", description(commented)).text.empty());
}

TEST(TerrainText, TellsTerrainsFromStyles)
{
    EXPECT_TRUE(is_terrain(test::source_folder() / "examples/dunes/dunes.toml"));
    EXPECT_FALSE(is_terrain(test::source_folder() / "presets/comic.toml"));
    EXPECT_FALSE(is_terrain("nowhere.toml"));
}

} // namespace
} // namespace estampe::viewer
