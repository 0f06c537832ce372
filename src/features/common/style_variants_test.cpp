// SPDX-License-Identifier: MIT
#include "features/common/style_tables.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"

namespace estampe::features {
namespace {

/// Nodes: a tower of the material "Brick" with a child "Roof", a "Wall" of "Brick_old", and the ground.
class StyleVariantsTest : public testing::Test {
protected:
    StyleVariantsTest()
    {
        const std::array<const char*, 3> nodes{"Tower", "Roof", "Wall"};
        const std::array<const char*, 3> materials{"Brick", "frame::Tile", "Brick_old"};
        for (size_t i = 0; i < nodes.size(); ++i) {
            const Index node = test::add_object(scene_, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F));
            scene_.nodes[node].name = nodes.at(i);
            scene_.materials.back().name = materials.at(i);
        }
        scene_.nodes[1].parent = 0;
        scene_.nodes[0].children.push_back(1);
        meshes_ = pose::build_meshes(scene_, static_cast<Index>(scene_.materials.size()));
    }

    void set(const std::string& assignment) { style_schema().set(style_, assignment); }

    [[nodiscard]] StyleVariants plan() const { return style_variants(meshes_, scene_, style_); }

    Scene scene_;
    pose::MeshData meshes_;
    StyleTables style_;
};

TEST_F(StyleVariantsTest, OneStyleIsOneVariant)
{
    EXPECT_FALSE(plan().has_several());
    set("material.Straw.wash.strength=0");
    EXPECT_FALSE(plan().has_several());
    EXPECT_EQ(
        idle_overrides(scene_, style_),
        std::vector<std::string>{"the style speaks of materials \"Straw\", of which the scene has none"});
}

TEST_F(StyleVariantsTest, PatternsNameMaterialsAndObjectsWithWhatHangsOnThem)
{
    set("material.Brick*.hatch.width_mm=1");
    set("object.Tower.wash.strength=0");
    const StyleVariants variants = plan();
    ASSERT_EQ(variants.variant_of_draw.size(), 4U);
    const auto style_of = [&](size_t draw) { return variants.styles.at(variants.variant_of_draw[draw]); };
    EXPECT_EQ(style_of(0).hatch.width_mm, 1.0F);
    EXPECT_EQ(style_of(0).wash.strength, 0.0F);
    EXPECT_EQ(style_of(1).hatch.width_mm, style_.hatch.width_mm);
    EXPECT_EQ(style_of(1).wash.strength, 0.0F);
    EXPECT_EQ(style_of(2).hatch.width_mm, 1.0F);
    EXPECT_EQ(style_of(2).wash.strength, style_.wash.strength);
    EXPECT_EQ(variants.variant_of_draw[3], 0U) << "the ground";
    EXPECT_TRUE(idle_overrides(scene_, style_).empty());
}

TEST_F(StyleVariantsTest, KindsMeanMaterialsByTheirNamesAndNeedNone)
{
    set("material.kind:stone.hatch.width_mm=1");
    set("material.kind:water.hatch.width_mm=2");
    scene_.materials[1] = {.name = "frame::Tile", .metallic = 1.0F, .roughness = 0.2F};
    set("material.kind:metal.hatch.layers=1");
    const StyleVariants variants = plan();
    ASSERT_EQ(variants.styles.size(), 3U);
    const auto style_of = [&](size_t draw) { return variants.styles.at(variants.variant_of_draw[draw]); };
    EXPECT_EQ(style_of(0).hatch.width_mm, 1.0F) << "Brick";
    EXPECT_EQ(style_of(2).hatch.width_mm, 1.0F) << "Brick_old";
    EXPECT_EQ(style_of(1).hatch.width_mm, style_.hatch.width_mm);
    EXPECT_EQ(style_of(1).hatch.layers, 1) << "metal by the file";
    EXPECT_TRUE(idle_overrides(scene_, style_).empty()) << "no water is no mistake";
}

TEST_F(StyleVariantsTest, TheSameOverridesAreOneVariant)
{
    set("material.*.hatch.width_mm=1");
    const StyleVariants variants = plan();
    EXPECT_EQ(variants.styles.size(), 2U);
    EXPECT_EQ(variants.variant_of_draw, (std::vector<uint32_t>{1, 1, 1, 0}));
}

TEST_F(StyleVariantsTest, LaterOverridesWin)
{
    set("object.Tower.hatch.width_mm=1");
    set("material.Brick.hatch.width_mm=2");
    const StyleVariants variants = plan();
    EXPECT_EQ(variants.styles.at(variants.variant_of_draw[0]).hatch.width_mm, 2.0F);
}

TEST_F(StyleVariantsTest, LinesAreFoundForWhicheverWantsThem)
{
    set("contour.enabled=false");
    set("contour.ridge.enabled=false");
    set("object.Wall.contour.enabled=true");
    set("object.Wall.contour.ridge.enabled=true");
    set("object.Wall.contour.ridge.width_mm=0.5");
    const StyleVariants variants = plan();
    EXPECT_TRUE(variants.lines.enabled);
    EXPECT_EQ(variants.lines.ridge.width_mm, 0.5F);
    EXPECT_FALSE(variants.styles.front().contour.enabled);
}

} // namespace
} // namespace estampe::features
