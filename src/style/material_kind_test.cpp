// SPDX-License-Identifier: MIT
// Kinds of material by names that real files have, and by what files say of metal and foliage.
#include "style/material_kind.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace estampe::style {
namespace {

std::string kind_by_name(std::string_view name)
{
    return std::string(kind_of({.name = name}).value_or("none"));
}

TEST(MaterialKinds, FollowFromTheWordsOfANameInThreeLanguages)
{
    const std::vector<std::pair<std::string_view, std::string_view>> known{
        {"stone", "stone"},         {"Old_Brick_Wall.001", "stone"},
        {"MarbleFloor", "stone"},   {"pierre taillee", "stone"},
        {"M_WoodenPlanks", "wood"}, {"oak", "wood"},
        {"Bois clair", "wood"},     {"Holzboden", "wood"},
        {"curtain_red", "cloth"},   {"ShirtFabric", "cloth"},
        {"drapeau", "cloth"},       {"BrushedSteel", "metal"},
        {"gold", "metal"},          {"Tins", "metal"},
        {"face", "skin"},           {"Skin_Body", "skin"},
        {"peau", "skin"},           {"sandy ground", "sand"},
        {"sable", "sand"},          {"Water2", "water"},
        {"eau", "water"},           {"ivy_leaf", "leaves"},
        {"Feuilles", "leaves"},     {"HEDGE", "leaves"}};
    for (const auto& [name, kind] : known) {
        EXPECT_EQ(kind_by_name(name), kind) << name;
    }
}

TEST(MaterialKinds, AreUnknownForNamesThatOnlyBeginAlike)
{
    for (const char* name : {"", "Material.001", "tinted glass", "season", "ferry", "oakley", "Rockets",
                             "mercury", "pineapple", "initialShadingGroup", "lambert1"}) {
        EXPECT_EQ(kind_by_name(name), "none") << name;
    }
}

TEST(MaterialKinds, OfSeveralWordsTheLastDecides)
{
    EXPECT_EQ(kind_by_name("stone floor with sand"), "sand");
    EXPECT_EQ(kind_by_name("gold leaf"), "leaves");
    EXPECT_EQ(kind_by_name("WaterTankMetal"), "metal");
}

TEST(MaterialKinds, FollowFromTheFileWhereTheNameSaysNothing)
{
    EXPECT_EQ(kind_of({.name = "a", .metallic = 1.0F, .roughness = 0.3F}), "metal");
    EXPECT_EQ(kind_of({.name = "a", .metallic = 1.0F, .roughness = 1.0F}), std::nullopt)
        << "what glTF assumes if a file says nothing";
    EXPECT_EQ(kind_of({.name = "a", .metallic = 0.0F, .roughness = 0.3F}), std::nullopt);
    EXPECT_EQ(kind_of({.name = "a", .is_foliage = true}), "leaves");
    EXPECT_EQ(kind_of({.name = "wood", .metallic = 1.0F, .roughness = 0.3F}), "wood");
}

TEST(MaterialKinds, AreAllNamedBySomeWord)
{
    for (const std::string_view kind : material_kinds) {
        EXPECT_EQ(kind_by_name(kind), kind);
    }
}

TEST(MaterialKinds, AreMeantByPatternsOfKindsAndNamesByPatternsOfNames)
{
    const std::string brick = "brick_old";
    EXPECT_TRUE(means("kind:stone", brick, "stone"));
    EXPECT_FALSE(means("kind:wood", brick, "stone"));
    EXPECT_TRUE(means("brick*", brick, "stone"));
    EXPECT_FALSE(means("stone", brick, "stone"));
    EXPECT_FALSE(means("kind:stone", brick, std::nullopt));
    EXPECT_EQ(named_kind("kind:wood"), "wood");
    EXPECT_EQ(named_kind("wood"), std::nullopt);
}

} // namespace
} // namespace estampe::style
