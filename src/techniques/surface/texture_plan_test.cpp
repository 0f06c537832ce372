// SPDX-License-Identifier: MIT
// Assignment of textures when a class has fewer layers than there are textures of its size.
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"
#include "techniques/surface/materials.hpp"

namespace estampe::surface {
namespace {

/// A scene with one material per texture; textures have the widths in `widths` and a height of one pixel.
Scene painted(const std::vector<uint32_t>& widths)
{
    Scene scene = test::scene_of(shapes::quad(1.0F, 1.0F));
    scene.materials.resize(widths.size());
    for (Index i = 0; i < widths.size(); ++i) {
        scene.textures.push_back({.image = {.width = widths[i],
                                            .height = 1,
                                            .rgba = std::vector<uint8_t>(size_t{4} * widths[i])}});
        scene.materials[i].base_color_texture.texture = i;
    }
    return scene;
}

std::vector<size_t> layers_of(const TexturePlan& plan)
{
    std::vector<size_t> counts;
    for (const auto& layers : plan.layers) {
        counts.push_back(layers.size());
    }
    return counts;
}

TEST(TexturePlan, EachGoesToTheClassOfItsSize)
{
    const TexturePlan plan = plan_textures(painted({1, 256, 257, 1024, 2048, 4096}), 256);
    EXPECT_EQ(layers_of(plan), (std::vector<size_t>{2, 1, 1, 1, 1}));
    EXPECT_EQ(plan.reduced, 0U);
    EXPECT_EQ(plan.left_out, 0U);
    EXPECT_TRUE(notes_of(plan).empty());
}

TEST(TexturePlan, WhatIsLargerThanAllClassesIsSaidToBeReduced)
{
    const TexturePlan plan = plan_textures(painted({4097, 16384, 100}), 256);
    EXPECT_EQ(layers_of(plan), (std::vector<size_t>{1, 0, 0, 0, 2}));
    EXPECT_EQ(plan.reduced, 2U);
    ASSERT_EQ(notes_of(plan).size(), 1U);
    EXPECT_TRUE(notes_of(plan)[0].starts_with("2 of the scene's textures are drawn smaller"))
        << notes_of(plan)[0];
}

TEST(TexturePlan, WhatAClassHasNoLayerForGoesToASmallerOneElseALargerOne)
{
    const TexturePlan plan = plan_textures(painted({1000, 1000, 1000, 300, 10, 10, 10}), 2);
    EXPECT_EQ(layers_of(plan), (std::vector<size_t>{2, 2, 2, 1, 0}));
    EXPECT_EQ(plan.reduced, 1U);
    EXPECT_EQ(plan.left_out, 0U);
    const Scene crowd = painted(std::vector<uint32_t>(12, 500));
    const TexturePlan full = plan_textures(crowd, 2);
    EXPECT_EQ(layers_of(full), (std::vector<size_t>(5, 2)));
    EXPECT_EQ(full.reduced, 2U);
    EXPECT_EQ(full.left_out, 2U);
    EXPECT_EQ(notes_of(full).size(), 2U);
    EXPECT_EQ(full.location[11], shared::no_texture);
    EXPECT_EQ(material_records(crowd, full)[11].base_texture.location, shared::no_texture);
}

} // namespace
} // namespace estampe::surface
