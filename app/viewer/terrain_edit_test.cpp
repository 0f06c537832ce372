// SPDX-License-Identifier: MIT
#include "viewer/terrain_edit.hpp"

#include <fstream>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace estampe::viewer {
namespace {

const std::string dunes = "[terrain]\n"
                          "height = 'swell + 2' # above the sea\n"
                          "[nodes]\n"
                          "swell = '3 + x'\n"
                          "small = '2 * swell'\n";

/// A terrain file in a folder, opened for editing.
struct Edited {
    explicit Edited(const std::string& text) : path(folder.path() / "mine.toml")
    {
        write(text);
        edit.emplace(Terrain(load_terrain(path)));
    }

    void write(const std::string& text) const { std::ofstream(path) << text; }

    [[nodiscard]] std::string text() const
    {
        std::ifstream file(path);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    [[nodiscard]] double height() const { return edit->terrain().sample(0.0, 0.0).height_m; }

    test::Folder folder;
    std::filesystem::path path;
    std::optional<TerrainEdit> edit;
};

TEST(TerrainEdit, WhatMakesNoSenseLeavesTheLastGround)
{
    Edited it(dunes);
    const uint64_t first = it.edit->revision();
    it.edit->set_expression(1, "30");
    EXPECT_EQ(it.height(), 32.0);
    EXPECT_GT(it.edit->revision(), first);
    const uint64_t good = it.edit->revision();
    it.edit->set_expression(1, "30 + fmb(2)");
    ASSERT_TRUE(it.edit->problem());
    EXPECT_EQ(it.edit->problem()->node, 1U);
    EXPECT_EQ(it.edit->problem()->text,
              "node \"swell\", character 6: there is no node or function \"fmb\"; did "
              "you mean \"fbm\"?");
    EXPECT_EQ(it.height(), 32.0);
    EXPECT_EQ(it.edit->revision(), good);
    EXPECT_THROW(it.edit->save(it.path), Error);
    EXPECT_EQ(it.text(), dunes);
    it.edit->set_expression(1, "4");
    EXPECT_FALSE(it.edit->problem());
    EXPECT_EQ(it.height(), 6.0);
}

TEST(TerrainEdit, ANewNameIsTheOneThatOthersAskBy)
{
    Edited it("[terrain]\nheight = 'swell + swells'\n[nodes]\nswell = '3'\nswells = '4'\n");
    for (const char* const typed : {"swel", "swe", "", "swells", "swellsx", "great"}) {
        it.edit->rename(1, typed);
    }
    EXPECT_EQ(it.edit->draft().nodes[0].expression, "great + swells");
    EXPECT_FALSE(it.edit->problem());
    EXPECT_EQ(it.height(), 7.0);
    it.edit->rename(2, "fbm");
    ASSERT_TRUE(it.edit->problem());
    EXPECT_EQ(it.edit->problem()->node, 2U);
    it.edit->rename(0, "depth");
    it.edit->rename(2, "height");
    EXPECT_EQ(it.edit->draft().nodes[0].name, "height");
    EXPECT_EQ(it.edit->draft().nodes[2].name, "fbm");
    Edited quoted("[terrain]\nheight = '1'\n[nodes]\ndirt = '2'\nother = \"dirt * mask('dirt', 1)\"\n");
    quoted.edit->rename(1, "dust");
    EXPECT_EQ(quoted.edit->draft().nodes[2].expression, "dust * mask('dirt', 1)");
}

TEST(TerrainEdit, ChangesAreUndoneStepByStep)
{
    Edited it("[terrain]\nheight = '1'\n");
    EXPECT_FALSE(it.edit->can_undo());
    for (const char* const typed : {"12", "123"}) {
        it.edit->set_expression(0, typed);
    }
    it.edit->finish_change();
    it.edit->add_node();
    ASSERT_EQ(it.edit->draft().nodes.size(), 2U);
    EXPECT_EQ(it.edit->draft().nodes[1].name, "part1");
    it.edit->set_expression(0, "part1 + 5");
    it.edit->set_expression(0, "part1 + 5 +");
    ASSERT_TRUE(it.edit->problem());
    it.edit->finish_change();
    it.edit->undo(); // undoes the invalid input
    EXPECT_FALSE(it.edit->problem());
    EXPECT_EQ(it.height(), 5.0);
    it.edit->undo();
    EXPECT_EQ(it.height(), 123.0);
    it.edit->undo();
    EXPECT_EQ(it.edit->draft().nodes.size(), 1U);
    it.edit->undo();
    EXPECT_EQ(it.height(), 1.0);
    EXPECT_FALSE(it.edit->can_undo());
    it.edit->redo();
    EXPECT_EQ(it.height(), 123.0);
    it.edit->remove_node(0);
    ASSERT_TRUE(it.edit->problem());
    EXPECT_FALSE(it.edit->problem()->node);
    EXPECT_EQ(it.height(), 123.0);
}

TEST(TerrainEdit, SettingsCountAtOnceOrWhenTheyAreFinished)
{
    Edited it("[terrain]\nheight = 'wind'\n");
    TerrainDescription settings = it.edit->draft();
    settings.wind.speed_m_per_s = 9.0F;
    it.edit->set_settings(settings);
    EXPECT_EQ(it.height(), 9.0);
    settings.meshing.cells = 64;
    const uint64_t before = it.edit->revision();
    it.edit->hold_settings(settings);
    EXPECT_EQ(it.edit->revision(), before);
    EXPECT_NE(it.edit->terrain().description().meshing.cells, 64);
    it.edit->finish_change();
    EXPECT_EQ(it.edit->terrain().description().meshing.cells, 64);
    it.edit->undo();
    EXPECT_EQ(it.height(), 5.0);
}

TEST(TerrainEdit, IsSavedWithItsComments)
{
    Edited it("[terrain]\nheight = 'swell + 2' # above the sea\n[nodes]\nswell = '3'\n");
    it.edit->set_expression(1, "4");
    EXPECT_TRUE(it.edit->is_changed());
    EXPECT_TRUE(it.edit->save(it.path));
    EXPECT_FALSE(it.edit->is_changed());
    EXPECT_FALSE(it.edit->differs_from_file());
    EXPECT_EQ(it.text(), "[terrain]\nheight = 'swell + 2' # above the sea\n[nodes]\nswell = \"4\"\n");
    it.write("[terrain]\nheight = '8'\n");
    EXPECT_TRUE(it.edit->differs_from_file());
    it.edit->load(it.path);
    EXPECT_EQ(it.height(), 8.0);
    it.edit->undo();
    EXPECT_EQ(it.height(), 6.0);
    it.write("[terrain\n");
    EXPECT_THROW(it.edit->load(it.path), Error);
    EXPECT_EQ(it.height(), 6.0);
}

TEST(TerrainEdit, IsNotSavedAwayFromItsTextures)
{
    const test::Folder folder;
    const std::filesystem::path path = folder.path() / "mine.toml";
    const std::filesystem::path picture = folder.path() / "hill.png";
    save_png(Image{.width = 1, .height = 1, .rgba = {51, 51, 51, 255}}, picture);
    std::ofstream(path) << "[terrain]\nheight = \"10 * texture('hill.png', 5)\"\n";
    TerrainEdit edit{Terrain(load_terrain(path))};
    EXPECT_NEAR(edit.terrain().sample(0.0, 0.0).height_m, 2.0, 1e-6);
    EXPECT_EQ(edit.files(), (std::vector<std::filesystem::path>{path, picture}));
    std::filesystem::create_directory(folder.path() / "elsewhere");
    EXPECT_THROW(edit.save(folder.path() / "elsewhere" / "mine.toml"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "elsewhere" / "mine.toml"));
    EXPECT_TRUE(edit.save(folder.path() / "other.toml"));
    EXPECT_EQ(edit.name(), (folder.path() / "other.toml").string());
    save_png(Image{.width = 1, .height = 1, .rgba = {102, 102, 102, 255}}, picture);
    edit.read_textures();
    EXPECT_NEAR(edit.terrain().sample(0.0, 0.0).height_m, 4.0, 1e-6);
}

} // namespace
} // namespace estampe::viewer
