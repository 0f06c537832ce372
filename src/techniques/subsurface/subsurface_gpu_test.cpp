// SPDX-License-Identifier: MIT
// Subsurface scattering in whole pictures.
#include "techniques/subsurface/subsurface.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::subsurface {
namespace {

const Camera body_camera{.eye = {0.0, 0.5, 4.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.6};
constexpr RenderSettings small{.width = 120, .height = 90};

/// Two backlit slabs; the slab of skin contains a thin slab of stone.
Scene against_the_sun()
{
    Scene scene = test::scene_of(shapes::box({0.8F, 1.0F, 0.1F}));
    scene.materials.front().name = "skin";
    scene.nodes.front().transform.translation = {-0.6, 0.0, 0.0};
    test::add_object(scene, shapes::box({0.8F, 1.0F, 0.1F}), glm::vec3(1.0F), {0.6, 0.0, 0.0});
    scene.materials.back().name = "stone";
    test::add_object(scene, shapes::box({0.6F, 0.8F, 0.02F}), glm::vec3(1.0F), {-0.6, 0.1, 0.0});
    scene.materials.back().name = "stone within";
    test::add_sun(scene, {0.0, 0.3, -1.0});
    return scene;
}

Style with(const std::vector<std::string>& assignments)
{
    return test::effect_style({"hatch.enabled=false", "sky.enabled=false"}, assignments);
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
        return renderer.render(body_camera, with(assignments), small);
    }

    Renderer& renderer = test::shared_renderer();
};

TEST_F(SubsurfaceInPictures, LightInThingsCostsNothingWhenOff)
{
    const Image plain = draw({});
    EXPECT_FALSE(test::has_pass("subsurface"));
    EXPECT_EQ(draw({"subsurface.scatter_m=0.1", "subsurface.depth_m=1"}).rgba, plain.rgba);
    EXPECT_FALSE(test::has_pass("subsurface"));
    EXPECT_EQ(draw({"subsurface.enabled=true", "subsurface.scatter_m=0", "subsurface.depth_m=0"}).rgba,
              plain.rgba);
    EXPECT_FALSE(test::has_pass("subsurface"));
}

TEST_F(SubsurfaceInPictures, LightComesThroughNamedMaterialsAlone)
{
    const std::vector<std::string> glowing{"material.sk*.subsurface.enabled=true",
                                           "material.sk*.subsurface.depth_m=0.1",
                                           "material.sk*.subsurface.tint=#e04020"};
    const Image plain = draw({});
    const Image image = draw(glowing);
    EXPECT_TRUE(test::has_pass("subsurface"));
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
    const Style style = with({"subsurface.enabled=true", "subsurface.depth_m=0.1", "subsurface.scatter_m=0.2",
                              "subsurface.reach_mm=18"});
    EXPECT_LE(test::most_between_tiles(body_camera, style, 130), 2);
}

/// A clear slab in front of a wall whose left half is bright.
Scene slab_before_halves(float thickness_m)
{
    Scene scene = test::scene_of(shapes::box({2.0F, 2.0F, thickness_m}));
    scene.materials.front().name = "glass";
    scene.nodes.front().transform.translation = {0.0, -1.0, -0.5 * static_cast<double>(thickness_m)};
    for (const double side : {-1.0, 1.0}) {
        const glm::vec3 color = side < 0.0 ? glm::vec3(0.9F) : glm::vec3(0.2F, 0.1F, 0.05F);
        test::add_object(scene, shapes::box({4.0F, 8.0F, 0.1F}), color, {2.0 * side, -4.0, -2.0});
        scene.materials.back().unlit = true;
    }
    test::add_sun(scene, {0.0, 0.3, 1.0});
    return scene;
}

class SeenBehind : public testing::Test {
protected:
    [[nodiscard]] static LinearImage draw(float thickness_m, const std::vector<std::string>& assignments)
    {
        std::vector<std::string> all{"paper.margin_mm=0", "paper.color=#ffffff", "wash.strength=1",
                                     "wash.neutral=1",    "wash.least=0",        "light.shadows=false"};
        all.insert(all.end(), assignments.begin(), assignments.end());
        Camera parallel{.eye = {0.0, 0.0, 4.0}, .target = {0.0, 0.0, 0.0}};
        parallel.orthographic_half_height_m = 0.8;
        test::shared_renderer().set_scene(slab_before_halves(thickness_m));
        return test::shared_renderer().render_linear(parallel, with(all), {.width = 128, .height = 64});
    }

    /// Colour in the middle row.
    [[nodiscard]] static glm::dvec3 at(const LinearImage& image, uint32_t x)
    {
        return glm::dvec3(image.pixels[size_t{32} * image.width + x]);
    }

    std::vector<std::string> clear{
        "material.glass.subsurface.enabled=true", "material.glass.subsurface.behind=1",
        "material.glass.subsurface.depth_m=0.2", "material.glass.subsurface.tint=#808080",
        "material.glass.subsurface.behind_blur=0"};
};

TEST_F(SeenBehind, IsTintedByTheThickness)
{
    const LinearImage bare = draw(0.01F, {"object.*.subsurface.enabled=false", "picture.ground=false"});
    const double gray = std::pow((128.0 / 255.0 + 0.055) / 1.055, 2.4);
    const LinearImage thin = draw(0.001F, clear);
    // The paper adds one common offset to all three pictures.
    const auto left = [&](double thickness_m) { return std::pow(gray, (thickness_m - 0.001) / 0.2); };
    const LinearImage thicker = draw(0.1F, clear);
    const LinearImage thickest = draw(0.4F, clear);
    for (const uint32_t x : {50U, 78U}) {
        const auto off = static_cast<double>(at(thin, x).y - at(thicker, x).y);
        EXPECT_NEAR((at(thicker, x).y - at(thickest, x).y) / off, (left(0.1) - left(0.4)) / (1.0 - left(0.1)),
                    0.02)
            << x;
    }
    EXPECT_GT(at(thin, 50).x, at(thin, 78).x + 0.3) << "the wall is seen";
    EXPECT_NEAR(at(bare, 50).x, at(bare, 78).x, 0.05) << "and not where there is nothing clear";
}

TEST_F(SeenBehind, IsTheMoreBlurredTheThickerItIs)
{
    clear.back() = "material.glass.subsurface.behind_blur=0.5";
    clear.emplace_back("material.glass.subsurface.tint=#ffffff");
    clear.emplace_back("subsurface.reach_mm=200");
    double before = 1.0;
    for (const float thickness_m : {0.001F, 0.1F, 0.2F, 0.4F}) {
        const LinearImage seen = draw(thickness_m, clear);
        // Share of the step within two pixels.
        const double steep = (at(seen, 63).x - at(seen, 65).x) / (at(seen, 28).x - at(seen, 100).x);
        EXPECT_LT(steep, before * 1.001) << thickness_m;
        before = 0.8 * steep;
    }
}

/// A slab of glass from a file's transmission, in front of a wall whose left half is bright.
Scene glass_before_halves(const Transmission& transmission, const glm::vec3& color = glm::vec3(1.0F))
{
    Scene scene = slab_before_halves(0.2F);
    Material& glass = scene.materials.front();
    glass.transmission = transmission;
    glass.base_color = glm::vec4(color, 1.0F);
    glass.metallic = 0.0F;
    glass.roughness = 0.0F;
    return scene;
}

class SeenThroughGlass : public testing::Test {
protected:
    [[nodiscard]] static LinearImage draw(const Scene& scene, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> all{"paper.margin_mm=0",   "paper.color=#ffffff", "wash.strength=1",
                                     "wash.neutral=1",      "wash.least=0",        "light.shadows=false",
                                     "picture.ground=false"};
        all.insert(all.end(), more.begin(), more.end());
        Camera parallel{.eye = {0.0, 0.0, 4.0}, .target = {0.0, 0.0, 0.0}};
        parallel.orthographic_half_height_m = 0.8;
        test::shared_renderer().set_scene(scene);
        return test::shared_renderer().render_linear(parallel, with(all), {.width = 128, .height = 64});
    }

    [[nodiscard]] static glm::vec4 at(const LinearImage& image, uint32_t x)
    {
        return image.pixels[size_t{32} * image.width + x];
    }
};

TEST_F(SeenThroughGlass, IsWhatTheFileSays)
{
    // The slab of the previous scene, with glass parameters from the style alone.
    Scene plain = glass_before_halves({});
    plain.materials.front().transmission.reset();
    const LinearImage by_style =
        draw(plain, {"material.glass.subsurface.enabled=true", "material.glass.subsurface.behind=0.75",
                     "material.glass.subsurface.behind_blur=0", "material.glass.subsurface.depth_m=0.2",
                     "material.glass.subsurface.strength=0", "material.glass.subsurface.scatter_m=0",
                     "material.glass.subsurface.tint=#00ffff"});
    const LinearImage by_file = draw(glass_before_halves(
        {.share = 0.75F, .attenuation_m = 0.2F, .attenuation_color = {1e-4F, 1.0F, 1.0F}}));
    for (const uint32_t x : {40U, 50U, 78U, 88U}) {
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(at(by_file, x)[channel], at(by_style, x)[channel], 5e-3F) << x;
        }
    }
    EXPECT_GT(at(by_file, 50).y, at(by_file, 78).y + 0.2F) << "the wall is seen";
}

TEST_F(SeenThroughGlass, IsLeftToTheStyle)
{
    Scene plain = glass_before_halves({});
    plain.materials.front().transmission.reset();
    const Scene glass = glass_before_halves({.share = 1.0F});
    EXPECT_EQ(draw(glass, {"subsurface.transmission=false"}).pixels, draw(plain).pixels);
    EXPECT_FALSE(test::has_pass("subsurface"));
    (void)draw(glass);
    EXPECT_TRUE(test::has_pass("subsurface/clear"));
}

TEST_F(SeenThroughGlass, IsBentOnlyIfTheStyleAsks)
{
    // A slab that is parallel to the page shifts nothing; a file without thickness describes a sheet.
    Scene turned = glass_before_halves({.share = 1.0F, .thickness_m = 0.2F, .ior = 1.5F});
    turned.nodes.front().transform.rotation = glm::angleAxis(0.7, glm::dvec3(0, 1, 0));
    const LinearImage straight = draw(turned);
    EXPECT_FALSE(test::has_pass("subsurface/refract"));
    EXPECT_EQ(draw(turned, {"subsurface.ior=2", "subsurface.refraction_mm=9"}).pixels, straight.pixels);
    EXPECT_FALSE(test::has_pass("subsurface/refract"));
    const LinearImage bent = draw(turned, {"subsurface.refraction=thick"});
    EXPECT_TRUE(test::has_pass("subsurface/refract"));
    EXPECT_NE(bent.pixels, straight.pixels);
    // The rays run to the left inside the slab, so the step of the wall behind is seen farther to the right.
    EXPECT_GT(at(bent, 65).x, at(straight, 65).x + 0.2F);
    Scene sheet = glass_before_halves({.share = 1.0F});
    (void)draw(sheet, {"subsurface.refraction=thick"});
    EXPECT_FALSE(test::has_pass("subsurface/refract"));
}

TEST_F(SeenThroughGlass, HasNoSeamsBetweenTilesWhereItIsBent)
{
    // A ball that shows places as far away as allowed.
    Scene ball = glass_before_halves({.share = 1.0F, .thickness_m = 0.2F, .ior = 1.5F});
    ball.meshes.front().primitives.front() = shapes::sphere(0.6F, 64, 32);
    ball.meshes.front().primitives.front().material = 0;
    ball.nodes.front().transform.translation = {0.0, 0.0, 0.0};
    test::shared_renderer().set_scene(ball);
    Camera parallel{.eye = {0.3, 0.2, 4.0}, .target = {0.0, 0.0, 0.0}};
    parallel.orthographic_half_height_m = 0.8;
    const Style style = with({"picture.ground=false", "subsurface.refraction=thick", "subsurface.reach_mm=2",
                              "subsurface.refraction_mm=25"});
    EXPECT_LE(test::most_between_tiles(parallel, style, 140), 2);
}

TEST_F(SeenThroughGlass, IsTintedByItsOwnColour)
{
    const auto seen = [](float share, const std::vector<std::string>& more = {}) {
        return at(draw(glass_before_halves({.share = 1.0F}, {1.0F, share, share}), more), 50);
    };
    const glm::vec4 clear = seen(1.0F);
    const glm::vec4 red = seen(0.25F);
    EXPECT_NEAR(red.x, clear.x, 5e-3F);
    // The paper adds the same offset to all three.
    EXPECT_NEAR((clear.y - seen(0.5F).y) / (clear.y - red.y), 2.0F / 3.0F, 0.01F);
    EXPECT_GT(clear.y - red.y, 0.3F);
    const std::vector<std::string> gray{"wash.strength=0"};
    EXPECT_NEAR(seen(0.25F, gray).y, seen(1.0F, gray).y, 5e-3F)
        << "where no colour is painted glass has none";
}

} // namespace
} // namespace estampe::subsurface
