// SPDX-License-Identifier: MIT
// Occlusion in whole pictures: when it runs, what it darkens, and its mask.
#include "techniques/occlusion/occlusion.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include <estampe/layers.hpp>
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::occlusion {
namespace {

const Camera camera{.eye = {2.0, 2.0, 4.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.6};
constexpr RenderSettings small{.width = 120, .height = 90};

/// A box in front of a wall, on a floor.
Scene corner()
{
    Scene scene = test::scene_of(shapes::plane(12.0F, 12.0F, 24));
    test::add_object(scene, shapes::box({8.0F, 4.0F, 0.2F}), glm::vec3(1.0F), {0.0, 0.0, -0.8});
    test::add_object(scene, shapes::box({0.8F, 0.8F, 0.8F}), glm::vec3(1.0F), {0.0, 0.0, 0.0});
    return scene;
}

Style with(const std::vector<std::string>& assignments)
{
    return test::effect_style({"light.turn_sun=false"}, assignments);
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

    [[nodiscard]] std::vector<float> mask_of(const std::vector<std::string>& assignments)
    {
        const LayeredImage image = renderer.render_layers(camera, with(assignments), small);
        const auto mask = std::ranges::find(image.masks, std::string("occlusion"), &PictureMask::name);
        return mask == image.masks.end() ? std::vector<float>() : mask->cover;
    }

    Renderer& renderer = test::shared_renderer();
};

TEST_F(OcclusionInPictures, OcclusionCostsNothingWhenOff)
{
    const Image plain = draw({});
    EXPECT_FALSE(test::has_pass("occlusion"));
    EXPECT_EQ(
        draw({"occlusion.strength=3", "occlusion.radius_m=2", "occlusion.thickness_from=back_faces"}).rgba,
        plain.rgba);
    EXPECT_FALSE(test::has_pass("occlusion"));
    for (const char* method : {"horizon", "discs", "splats", "uv", "unsharp"}) {
        // An occlusion that only feeds layers is skipped if no layer is read.
        EXPECT_EQ(draw({"occlusion.enabled=true", "occlusion.feeds=layer",
                        fmt::format("occlusion.method={}", method)})
                      .rgba,
                  plain.rgba);
        EXPECT_FALSE(test::has_pass("occlusion")) << method;
    }
}

TEST_F(OcclusionInPictures, OcclusionDarkensWhatItFeeds)
{
    for (const char* method : {"horizon", "discs", "splats", "uv", "unsharp"}) {
        const std::string by = fmt::format("occlusion.method={}", method);
        const std::string ambient = "tone.exposure=0.5";
        const double plain = mean_of(draw({ambient}));
        const double of_ambient = mean_of(draw({ambient, "occlusion.enabled=true", by}));
        EXPECT_TRUE(test::has_pass("occlusion"));
        const double of_all = mean_of(draw({ambient, "occlusion.enabled=true", "occlusion.feeds=tone", by}));
        EXPECT_LT(of_ambient, plain - 0.05) << method;
        EXPECT_LT(of_all, of_ambient - 0.05) << method;
    }
}

TEST_F(OcclusionInPictures, OcclusionOfAmbientLeavesTheSunAlone)
{
    // Without ambient and fill light, occlusion has nothing to darken.
    const std::vector<std::string> sun_alone{"light.ambient=0", "light.fill=0"};
    std::vector<std::string> occluded = sun_alone;
    occluded.emplace_back("occlusion.enabled=true");
    EXPECT_EQ(draw(occluded).rgba, draw(sun_alone).rgba);
    occluded.emplace_back("light.fill=0.5");
    EXPECT_NE(draw(occluded).rgba, draw({"light.ambient=0", "light.fill=0.5"}).rgba);
}

TEST_F(OcclusionInPictures, OcclusionIsAMaskOfItsOwn)
{
    EXPECT_TRUE(mask_of({}).empty());
    const std::vector<float> alone = mask_of({"occlusion.enabled=true", "occlusion.feeds=layer"});
    ASSERT_EQ(alone.size(), size_t{small.width} * small.height);
    EXPECT_GT(std::ranges::max(alone), 0.3F);
    EXPECT_EQ(std::ranges::min(alone), 0.0F);
    EXPECT_EQ(mask_of({"occlusion.enabled=true", "occlusion.feeds=tone"}), alone);
}

TEST_F(OcclusionInPictures, UnsharpDepthsLeavePlanesAlone)
{
    // Depth darkening appears behind a box's edges. It never appears on a slanted floor, at any strength.
    const std::vector<std::string> unsharp{"occlusion.enabled=true", "occlusion.method=unsharp",
                                           "occlusion.feeds=layer", "occlusion.strength=8"};
    EXPECT_GT(std::ranges::max(mask_of(unsharp)), 0.2F);
    renderer.set_scene(test::scene_of(shapes::plane(400.0F, 400.0F)));
    EXPECT_LT(std::ranges::max(mask_of(unsharp)), 2e-3F);
}

TEST_F(OcclusionInPictures, DiscsThrowTheirColorOnWhatIsBeside)
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F, 24));
    test::add_object(scene, shapes::sphere(0.6F, 24, 16), {0.9F, 0.05F, 0.05F}, {0.0, 0.62, 0.0});
    renderer.set_scene(scene);
    const auto redness_of = [&](const char* method, const char* bleeding) {
        Style style = Style::load("cel");
        for (const char* assignment : {"occlusion.enabled=true", "contour.enabled=false", "wash.light_tint=1",
                                       "occlusion.radius_m=2", method, bleeding}) {
            style.set(assignment);
        }
        const Image image = renderer.render(camera, style, small);
        std::vector<float> shares;
        for (size_t i = 0; i < image.rgba.size(); i += 4) {
            const auto sum = static_cast<float>(image.rgba[i] + image.rgba[i + 1] + image.rgba[i + 2]);
            shares.push_back(static_cast<float>(image.rgba[i]) / std::max(sum, 1.0F));
        }
        return shares;
    };
    // One renderer draws both pictures. Results without colours must not be reused for a picture with
    // colours.
    for (const char* method : {"occlusion.method=discs", "occlusion.method=splats", "occlusion.method=uv"}) {
        const std::vector<float> plain = redness_of(method, "occlusion.bleeding=0");
        const std::vector<float> tinted = redness_of(method, "occlusion.bleeding=4");
        size_t redder = 0;
        size_t paler = 0;
        for (size_t i = 0; i < plain.size(); ++i) {
            redder += tinted[i] > plain[i] + 0.01F ? 1 : 0;
            paler += tinted[i] < plain[i] - 0.01F ? 1 : 0;
        }
        EXPECT_GT(redder, plain.size() / 50) << method;
        EXPECT_LT(paler, plain.size() / 500) << method;
    }
}

TEST_F(OcclusionInPictures, BackFacesAreDrawnOnlyForTheMethodThatReadsThem)
{
    const char* const backs = "occlusion.thickness_from=back_faces";
    const Image guessed = draw({"occlusion.enabled=true"});
    EXPECT_FALSE(test::has_pass("occlusion/behind"));
    EXPECT_NE(draw({"occlusion.enabled=true", backs}).rgba, guessed.rgba);
    EXPECT_TRUE(test::has_pass("occlusion/behind"));
    EXPECT_TRUE(test::has_pass("occlusion/backs"));
    (void)draw({"occlusion.enabled=true", backs, "occlusion.method=discs"});
    EXPECT_FALSE(test::has_pass("occlusion/behind"));
}

TEST_F(OcclusionInPictures, OcclusionHasNoSeamsBetweenTiles)
{
    for (const char* const thickness : {"guess", "back_faces"}) {
        const Style style = with({"occlusion.enabled=true", "occlusion.feeds=tone", "occlusion.radius_m=2",
                                  "occlusion.reach_mm=18", "hatch.enabled=false",
                                  fmt::format("occlusion.thickness_from={}", thickness)});
        EXPECT_LE(test::most_between_tiles(camera, style, 130), 2) << thickness;
    }
}

} // namespace
} // namespace estampe::occlusion
