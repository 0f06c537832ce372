// SPDX-License-Identifier: MIT
#include "scene/assimp/transfer.hpp"

#include <random>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

TransferScene sample()
{
    TransferScene transfer;
    Scene& scene = transfer.scene;
    scene.name = "sample";
    scene.textures.resize(1);
    scene.textures[0].wrap_v = Wrap::mirror;
    transfer.images.push_back({.file = "a.png", .bytes = {std::byte{1}, std::byte{2}}});
    scene.materials.resize(2);
    scene.materials[1].base_color = {0.1F, 0.2F, 0.3F, 0.4F};
    scene.materials[1].alpha_mode = AlphaMode::blend;
    scene.meshes.push_back({.name = "box", .primitives = {shapes::box({1, 2, 3})}, .morph_weights = {0.5F}});
    scene.meshes[0].primitives[0].morph_targets.resize(1);
    scene.meshes[0].primitives[0].morph_targets[0].position_offsets.assign(24, {1, 0, 0});
    scene.nodes.resize(2);
    scene.nodes[0].children = {1};
    scene.nodes[1].parent = 0;
    scene.nodes[1].matrix = glm::dmat4(3.0);
    scene.roots = {0};
    scene.skins.push_back({.name = "skin", .joints = {1}, .joint_from_bind = {glm::mat4(2.0F)}});
    scene.lights.push_back({.name = "sun", .type = LightType::directional, .intensity = 3.0F});
    scene.cameras.push_back({.name = "eye", .orthographic = true});
    scene.animations.push_back({.name = "turn", .channels = {AnimationChannel{}}, .duration_s = 2.0F});
    scene.animations[0].channels[0].times_s = {0.0F, 2.0F};
    scene.animations[0].start_s = 0.5F;
    scene.frames_per_s = 30.0;
    scene.file_unit_m = 0.01;
    scene.warnings = {"mended"};
    return transfer;
}

TEST(Transfer, ComesBackAsItWent)
{
    const TransferScene before = sample();
    const std::vector<std::byte> bytes = pack(before);
    const TransferScene after = unpack(bytes, "");
    EXPECT_EQ(pack(after), bytes);
    EXPECT_EQ(after.scene.name, "sample");
    EXPECT_EQ(after.images[0].file, "a.png");
    EXPECT_EQ(after.scene.materials[1].base_color, before.scene.materials[1].base_color);
    EXPECT_EQ(after.scene.meshes[0].primitives[0].positions, before.scene.meshes[0].primitives[0].positions);
    EXPECT_EQ(after.scene.meshes[0].primitives[0].indices, before.scene.meshes[0].primitives[0].indices);
    EXPECT_EQ(*after.scene.nodes[1].matrix, glm::dmat4(3.0));
    EXPECT_FALSE(after.scene.nodes[0].matrix);
    EXPECT_EQ(after.scene.lights[0].type, LightType::directional);
    EXPECT_TRUE(after.scene.cameras[0].orthographic);
    EXPECT_EQ(after.scene.animations[0].channels[0].times_s, (std::vector<float>{0.0F, 2.0F}));
    EXPECT_EQ(after.scene.animations[0].start_s, 0.5F);
    EXPECT_EQ(after.scene.frames_per_s, 30.0);
    EXPECT_EQ(after.scene.file_unit_m, 0.01);
}

TEST(Transfer, WhatIsNoTreeIsRefusedBeforeItIsPosed)
{
    for (const Index root : {Index{2}, no_index}) {
        Scene scene = sample().scene;
        scene.roots = {root};
        EXPECT_THROW(check_structure(scene, "sample"), Error);
    }
    Scene none = sample().scene;
    none.nodes.clear();
    EXPECT_THROW(check_structure(none, "sample"), Error);
}

TEST(Transfer, EveryTruncationIsAnError)
{
    const std::vector<std::byte> bytes = pack(sample());
    for (size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 37)
        EXPECT_THROW((void)unpack(std::span(bytes).first(size), "x"), Error) << size;
}

TEST(Transfer, DamageIsAnErrorOrAnotherScene)
{
    const std::vector<std::byte> bytes = pack(sample());
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
        std::vector<std::byte> damaged = bytes;
        damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        try {
            (void)unpack(damaged, "x");
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), "x");
        }
    }
}

} // namespace
} // namespace estampe
