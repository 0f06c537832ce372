// SPDX-License-Identifier: MIT
// Occlusion in whole pictures: what it costs, what it darkens, and its mask.
#include "techniques/occlusion/occlusion.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include <estampe/layers.hpp>
#include <estampe/renderer.hpp>

#include "scene/shapes.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::occlusion {
namespace {

const Camera camera{.eye = {2.0, 2.0, 4.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.6};
constexpr RenderSettings small{.width = 120, .height = 90};

/// A box before a wall, on a floor.
Scene corner()
{
    Scene scene = test::scene_of(shapes::plane(12.0F, 12.0F, 24));
    test::add_object(scene, shapes::box({8.0F, 4.0F, 0.2F}), glm::vec3(1.0F), {0.0, 0.0, -0.8});
    test::add_object(scene, shapes::box({0.8F, 0.8F, 0.8F}), glm::vec3(1.0F), {0.0, 0.0, 0.0});
    return scene;
}

Style with(const std::vector<std::string>& assignments)
{
    Style style;
    for (const char* flat : {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0",
                             "picture.ground=none", "contour.drawn=false", "light.turn_sun=false"}) {
        style.set(flat);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

double mean_of(const Image& image)
{
    return static_cast<double>(std::accumulate(image.rgba.begin(), image.rgba.end(), uint64_t{0})) /
           static_cast<double>(image.rgba.size());
}

class OcclusionInPictures : public testing::Test {
protected:
    void SetUp() override { renderer.set_scene(corner()); }

    [[nodiscard]] Image draw(const std::vector<std::string>& assignments)
    {
        return renderer.render(camera, with(assignments), small);
    }

    [[nodiscard]] bool has_pass() const
    {
        return renderer.graph_dot().find("occlusion") != std::string::npos;
    }

    Renderer& renderer = test::shared_renderer();
};

TEST_F(OcclusionInPictures, OcclusionCostsNothingWhenOff)
{
    const Image plain = draw({});
    EXPECT_FALSE(has_pass());
    EXPECT_EQ(draw({"occlusion.strength=3", "occlusion.radius_m=2"}).rgba, plain.rgba);
    for (const char* method : {"horizon", "discs", "unsharp"}) {
        // Nobody reads what lies in layers alone.
        EXPECT_EQ(draw({"occlusion.drawn=true", "occlusion.feeds=layer",
                        fmt::format("occlusion.method={}", method)})
                      .rgba,
                  plain.rgba);
        EXPECT_FALSE(has_pass()) << method;
    }
}

TEST_F(OcclusionInPictures, OcclusionDarkensWhatItFeeds)
{
    for (const char* method : {"horizon", "discs", "unsharp"}) {
        const std::string by = fmt::format("occlusion.method={}", method);
        const std::string ambient = "tone.exposure=0.5";
        const double plain = mean_of(draw({ambient}));
        const double of_ambient = mean_of(draw({ambient, "occlusion.drawn=true", by}));
        EXPECT_TRUE(has_pass());
        const double of_all = mean_of(draw({ambient, "occlusion.drawn=true", "occlusion.feeds=tone", by}));
        EXPECT_LT(of_ambient, plain - 0.05) << method;
        EXPECT_LT(of_all, of_ambient - 0.05) << method;
    }
}

TEST_F(OcclusionInPictures, OcclusionOfAmbientLeavesTheSunAlone)
{
    // Without ambient light and fill there is nothing that it could take.
    const std::vector<std::string> sun_alone{"light.ambient=0", "light.fill=0"};
    std::vector<std::string> occluded = sun_alone;
    occluded.emplace_back("occlusion.drawn=true");
    EXPECT_EQ(draw(occluded).rgba, draw(sun_alone).rgba);
    occluded.emplace_back("light.fill=0.5");
    EXPECT_NE(draw(occluded).rgba, draw({"light.ambient=0", "light.fill=0.5"}).rgba);
}

TEST_F(OcclusionInPictures, OcclusionIsAMaskOfItsOwn)
{
    const auto mask_of = [&](const std::vector<std::string>& assignments) {
        const LayeredImage image = renderer.render_layers(camera, with(assignments), small);
        const auto mask = std::ranges::find(image.masks, std::string("occlusion"), &PictureMask::name);
        return mask == image.masks.end() ? std::vector<float>() : mask->cover;
    };
    EXPECT_TRUE(mask_of({}).empty());
    const std::vector<float> alone = mask_of({"occlusion.drawn=true", "occlusion.feeds=layer"});
    ASSERT_EQ(alone.size(), size_t{small.width} * small.height);
    EXPECT_GT(std::ranges::max(alone), 0.3F);
    EXPECT_EQ(std::ranges::min(alone), 0.0F);
    EXPECT_EQ(mask_of({"occlusion.drawn=true", "occlusion.feeds=tone"}), alone);
}

TEST_F(OcclusionInPictures, UnsharpDepthsLeavePlanesAlone)
{
    // Behind the edges of a box, and nowhere on the slanted floor itself.
    renderer.set_scene(test::scene_of(shapes::plane(400.0F, 400.0F)));
    EXPECT_EQ(renderer
                  .render(camera,
                          with({"occlusion.drawn=true", "occlusion.method=unsharp", "occlusion.feeds=tone"}),
                          small)
                  .rgba,
              draw({}).rgba);
}

TEST_F(OcclusionInPictures, OcclusionHasNoSeamsBetweenTiles)
{
    const std::vector<std::string> assignments{"occlusion.drawn=true", "occlusion.feeds=tone",
                                               "occlusion.reach_mm=8"};
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
} // namespace estampe::occlusion
