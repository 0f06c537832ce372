// SPDX-License-Identifier: MIT
// Light that goes into things, in whole pictures.
#include "techniques/subsurface/subsurface.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>

#include "scene/shapes.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::subsurface {
namespace {

const Camera camera{.eye = {0.0, 0.5, 4.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.6};
constexpr RenderSettings small{.width = 120, .height = 90};

/// Two slabs against the sun.
Scene against_the_sun()
{
    Scene scene = test::scene_of(shapes::box({0.8F, 1.0F, 0.1F}));
    scene.materials.front().name = "skin";
    scene.nodes.front().transform.translation = {-0.6, 0.0, 0.0};
    test::add_object(scene, shapes::box({0.8F, 1.0F, 0.1F}), glm::vec3(1.0F), {0.6, 0.0, 0.0});
    scene.materials.back().name = "stone";
    test::add_sun(scene, {0.0, 0.3, -1.0});
    return scene;
}

Style with(const std::vector<std::string>& assignments)
{
    Style style;
    for (const char* flat :
         {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "picture.ground=none",
          "contour.drawn=false", "hatch.drawn=false", "sky.mode=paper"}) {
        style.set(flat);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

/// Mean of a channel over a part of the page.
double mean_of(const Image& image, glm::uvec2 from, glm::uvec2 to, size_t channel)
{
    double sum = 0.0;
    for (uint32_t y = from.y; y < to.y; ++y) {
        for (uint32_t x = from.x; x < to.x; ++x) {
            sum += image.rgba[4 * (size_t{y} * image.width + x) + channel];
        }
    }
    return sum / ((to.x - from.x) * (to.y - from.y));
}

class SubsurfaceInPictures : public testing::Test {
protected:
    void SetUp() override { renderer.set_scene(against_the_sun()); }

    [[nodiscard]] Image draw(const std::vector<std::string>& assignments)
    {
        return renderer.render(camera, with(assignments), small);
    }

    [[nodiscard]] bool has_pass() const
    {
        return renderer.graph_dot().find("subsurface") != std::string::npos;
    }

    Renderer& renderer = test::shared_renderer();
};

TEST_F(SubsurfaceInPictures, LightInThingsCostsNothingWhenOff)
{
    const Image plain = draw({});
    EXPECT_FALSE(has_pass());
    EXPECT_EQ(draw({"subsurface.scatter_m=0.1", "subsurface.depth_m=1"}).rgba, plain.rgba);
    EXPECT_FALSE(has_pass());
    EXPECT_EQ(draw({"subsurface.drawn=true", "subsurface.scatter_m=0", "subsurface.depth_m=0"}).rgba,
              plain.rgba);
    EXPECT_FALSE(has_pass());
}

TEST_F(SubsurfaceInPictures, LightComesThroughNamedMaterialsAlone)
{
    const std::vector<std::string> glowing{"material.sk*.subsurface.drawn=true",
                                           "material.sk*.subsurface.depth_m=0.1",
                                           "material.sk*.subsurface.tint=#e04020"};
    const Image plain = draw({});
    const Image image = draw(glowing);
    EXPECT_TRUE(has_pass());
    const glm::uvec2 skin_from(30, 35);
    const glm::uvec2 skin_to(45, 60);
    const glm::uvec2 stone_from(75, 35);
    const glm::uvec2 stone_to(90, 60);
    EXPECT_GT(mean_of(image, skin_from, skin_to, 0), mean_of(plain, skin_from, skin_to, 0) + 10.0);
    EXPECT_GT(mean_of(image, skin_from, skin_to, 0) - mean_of(image, skin_from, skin_to, 2),
              mean_of(plain, skin_from, skin_to, 0) - mean_of(plain, skin_from, skin_to, 2) + 10.0)
        << "it glows red";
    EXPECT_EQ(mean_of(image, stone_from, stone_to, 0), mean_of(plain, stone_from, stone_to, 0));
}

TEST_F(SubsurfaceInPictures, LightInThingsHasNoSeamsBetweenTiles)
{
    const std::vector<std::string> assignments{"subsurface.drawn=true", "subsurface.depth_m=0.1",
                                               "subsurface.scatter_m=0.02", "subsurface.reach_mm=8"};
    RenderSettings in_tiles{.width = 240, .height = 180};
    const Image whole = renderer.render(camera, with(assignments), in_tiles);
    in_tiles.tile_px = 130;
    const Image tiled = renderer.render(camera, with(assignments), in_tiles);
    size_t different = 0;
    for (size_t i = 0; i < whole.rgba.size(); ++i) {
        different += std::abs(int{whole.rgba[i]} - int{tiled.rgba[i]}) > 2 ? 1 : 0;
    }
    EXPECT_LT(different, whole.rgba.size() / 1000);
}

} // namespace
} // namespace estampe::subsurface
