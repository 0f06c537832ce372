// SPDX-License-Identifier: MIT
// Lightmaps that a scene's file names.
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "features/lighting/lightmap_test_support.hpp"
#include "features/lighting/lightmaps.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

/// Two panels of one mesh side by side, 2 x 2 m each, with the same UVs in both sets.
Scene two_mapped_panels()
{
    Primitive panel = shapes::quad(2.0F, 2.0F);
    panel.uvs[1] = panel.uvs[0];
    Scene scene;
    test::add_object(scene, panel, glm::vec3(1.0F), {-1.0, 0.0, 0.0});
    scene.nodes.push_back({.transform = {.translation = {1.0, 0.0, 0.0}}, .mesh = 0});
    scene.roots.push_back(1);
    return scene;
}

class NamedLightmaps : public ::testing::Test {
protected:
    Image draw(const Scene& scene, const Lightmap* map, const Style& style)
    {
        renderer_.set_scene(scene, map);
        Camera camera{.eye = {0.0, 1.0, 8.0}, .target = {0.0, 1.0, 0.0}};
        camera.orthographic_half_height_m = 1.5;
        return renderer_.render(camera, style, {.width = 96, .height = 48});
    }

    /// Left or right half of a picture.
    static std::vector<uint8_t> half(const Image& image, bool right)
    {
        std::vector<uint8_t> result;
        for (size_t i = 0; i < image.rgba.size(); ++i) {
            const size_t x = i / 4 % image.width;
            // Leaves out the middle, where the panels meet. A stroke that goes around a corner ends up to
            // 3 px beyond the middle, and the light of the other panel sets the width of its end.
            if (right ? x > image.width / 2 + 5 : x + 5 < image.width / 2) {
                result.push_back(image.rgba[i]);
            }
        }
        return result;
    }

    Renderer renderer_{test::validated()};
};

TEST_F(NamedLightmaps, AnEvenPictureIsDrawnAsTheSameAmbientLight)
{
    const Scene scene = two_mapped_panels();
    Lightmap map{.pictures = {even(0.5F)}, .of_scene = WornPicture{}};
    EXPECT_EQ(draw(scene, &map, bare(0.9F)), draw(scene, nullptr, bare(0.5F)));
    map.of_scene->intensity = 0.5F;
    EXPECT_EQ(draw(scene, &map, bare(0.9F)), draw(scene, nullptr, bare(0.25F)));
    // Independent of the lights' exposure.
    Style darker = bare(0.9F);
    darker.set("light.exposure_stops=-2");
    EXPECT_EQ(draw(scene, &map, darker), draw(scene, nullptr, bare(0.25F)));
}

TEST_F(NamedLightmaps, TheNodesWordCountsBeforeTheMaterialsAndThatBeforeTheScenes)
{
    const Scene scene = two_mapped_panels();
    Lightmap map{.pictures = {even(0.75F), even(0.5F), even(0.25F)}};
    map.of_scene = WornPicture{.picture = 0};
    const Image bright = draw(scene, nullptr, bare(0.75F));
    const Image middle = draw(scene, nullptr, bare(0.5F));
    const Image dark = draw(scene, nullptr, bare(0.25F));
    EXPECT_EQ(draw(scene, &map, bare(0.0F)), bright);
    map.of_material = {WornPicture{.picture = 1}};
    EXPECT_EQ(draw(scene, &map, bare(0.0F)), middle);
    map.of_node = {std::nullopt, WornPicture{.picture = 2, .uv_set = 0}};
    const Image both = draw(scene, &map, bare(0.0F));
    EXPECT_EQ(half(both, false), half(middle, false));
    EXPECT_EQ(half(both, true), half(dark, true));
}

TEST_F(NamedLightmaps, PicturesLieAsTheUvsSay)
{
    Scene scene = two_mapped_panels();
    // Uses only the upper right quarter of the lightmap: rows start at the top, as in glTF.
    for (glm::vec2& uv : scene.meshes[0].primitives[0].uvs[1]) {
        uv = glm::vec2(0.75F, 0.15F) + 0.1F * uv;
    }
    LightImage light = even(0.9F);
    for (const size_t texel : {2U, 3U, 6U, 7U}) {
        light.texels[texel] = glm::vec3(0.25F);
    }
    const Lightmap map{.pictures = {light}, .of_scene = WornPicture{}};
    EXPECT_EQ(draw(scene, &map, bare(0.0F)), draw(scene, nullptr, bare(0.25F)));
}

TEST_F(NamedLightmaps, WhatNothingCanWearIsAnError)
{
    Scene scene = two_mapped_panels();
    scene.meshes[0].primitives[0].uvs[1].clear();
    Lightmap map{.pictures = {even(0.5F)}, .of_scene = WornPicture{}};
    EXPECT_THROW(renderer_.set_scene(scene, &map), Error);
    map.of_scene->uv_set = 0;
    EXPECT_NO_THROW(renderer_.set_scene(scene, &map));
}

} // namespace
} // namespace estampe::features
