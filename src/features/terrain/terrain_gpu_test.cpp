// SPDX-License-Identifier: MIT
// Pictures of a terrain are equal a million metres away, have no gaps below the horizon, show its shadow,
// and do not swim.
#include <cmath>
#include <numbers>
#include <thread>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>
#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings terrain_page{.width = 160, .height = 90};
const std::string wave_ground =
    "[terrain]\nheight = '2 * sine(32) + rotate(sine(16), 90)'\n[mesh]\ncells = 32\n";

Scene ground_of(const std::string& toml)
{
    Scene scene{.materials = {Material{}}};
    scene.terrain = Terrain(parse_terrain(toml, "test.toml"));
    return scene;
}

Camera looking(const glm::dvec3& eye, double yaw_rad, double pitch)
{
    return {.eye = eye, .target = eye + glm::dvec3(std::cos(yaw_rad), pitch, std::sin(yaw_rad))};
}

/// Shows only light and shadow of the ground.
Style sunlight_alone(float elevation_deg)
{
    Style style;
    for (const char* const setting :
         {"hatch.enabled=false", "contour.enabled=false", "sky.enabled=false", "paper.margin_mm=0",
          "paper.grain=0", "paper.granulation=0", "light.sun_azimuth_deg=90", "light.source=sun"}) {
        style.set(setting);
    }
    style.set("light.sun_elevation_deg=" + std::to_string(elevation_deg));
    return style;
}

double brightness_at(const Image& image, uint32_t x, uint32_t y)
{
    return image.rgba[(size_t{y} * image.width + x) * 4] / 255.0;
}

/// Periodic ground looks the same 2^20 m away, to the byte, also after steps of a millimetre. The eyes and
/// targets are exact in double precision at both places.
TEST(TerrainPictures, DoNotShakeAMillionMetresAway)
{
    const Scene scene = ground_of(wave_ground + "[ripples]\nheight_m = 0\n"); // ripples are not periodic
    const glm::dvec3 far(1048576.0, 0.0, -2097152.0);
    Renderer here(test::validated());
    Renderer there(test::validated());
    here.set_scene(scene);
    there.set_scene(scene);
    for (int step = 0; step < 3; ++step) {
        const glm::dvec3 eye(3.0 + step / 1024.0, 5.0, step / 1024.0);
        const glm::dvec3 ahead(0.9375, -0.3125, 0.28125);
        const Image near_by = here.render({.eye = eye, .target = eye + ahead}, {}, terrain_page);
        const Camera as_far{.eye = eye + far, .target = eye + far + ahead};
        EXPECT_TRUE(near_by == there.render(as_far, {}, terrain_page)) << step;
    }
}

/// Seen from above, ground covers every pixel, including the seams between rings.
TEST(TerrainPictures, HaveNoGaps)
{
    const Scene scene =
        ground_of("[terrain]\nheight = '8 * fbm(60) + dunes(40, 5)'\ncolor = '#000000'\n[mesh]\ncells = 32\n"
                  "reach_m = 4000\n");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 at(37.3 * i, 0.0, -91.7 * i);
        const double ground_m = scene.terrain->sample(at.x, at.z).height_m;
        const Image image = renderer.render(looking({at.x, ground_m + 30.0, at.z}, 0.7 * i, -1.2),
                                            sunlight_alone(60.0F), terrain_page);
        double brightest = 0.0;
        for (uint32_t pixel = 0; pixel < terrain_page.width * terrain_page.height; ++pixel) {
            brightest = std::max(
                brightest, brightness_at(image, pixel % terrain_page.width, pixel / terrain_page.width));
        }
        EXPECT_LT(brightest, 0.7) << i; // the paper is 0.95
    }
}

/// A ridge casts a shadow, on the ground and on objects, whose length follows from the ridge's height and
/// the sun's elevation.
TEST(TerrainPictures, RidgesThrowTheirShadow)
{
    // A wall along z, 8 m high, with a foot of 1 m on both sides; the sun shines from +x.
    Scene scene =
        ground_of("[terrain]\nheight = '8 * smoothstep(2, 1, abs(x))'\n[mesh]\ncell_m = 0.25\ncells = 128\n");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const double elevation_deg = 30.0;
    const double end_m = -1.0 - 8.0 / std::tan(elevation_deg * std::numbers::pi / 180.0);
    Camera above{.eye = {-10.0, 60.0, 0.0}, .target = {-10.0, 0.0, 0.0}, .up = {0.0, 0.0, -1.0}};
    above.orthographic_half_height_m = 9.0;
    // The picture is 32 m wide, from x = -26 to 6.
    const auto column = [](double x_m) { return static_cast<uint32_t>((x_m + 26.0) / 32.0 * 160.0); };
    for (const char* const method : {"auto", "sweep", "pyramid", "march", "above"}) {
        Style style = sunlight_alone(static_cast<float>(elevation_deg));
        style.set(std::string("shadow.ground=") + method);
        style.set("shadow.ground_blur_m=0.2");
        const Image image = renderer.render(above, style, terrain_page);
        const double lit = brightness_at(image, column(end_m - 1.5), 45);
        const double dark = brightness_at(image, column(end_m + 1.5), 45);
        EXPECT_LT(dark, 0.85 * lit) << method;
        for (double x_m = -3.0; x_m > -24.0; x_m -= 0.2) {
            if (std::abs(x_m - end_m) > 0.6) {
                EXPECT_NEAR(brightness_at(image, column(x_m), 20), x_m > end_m ? dark : lit, 0.05)
                    << method << ' ' << x_m;
            }
        }
    }
}

/// Blurred shadows are as wide as the style asks: the transition takes more metres.
TEST(TerrainPictures, ABlurredShadowIsAsSoftAsTheStyleAsks)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(ground_of(
        "[terrain]\nheight = '8 * smoothstep(2, 1, abs(x))'\n[mesh]\ncell_m = 0.25\ncells = 128\n"));
    Camera above{.eye = {-10.0, 60.0, 0.0}, .target = {-10.0, 0.0, 0.0}, .up = {0.0, 0.0, -1.0}};
    above.orthographic_half_height_m = 9.0;
    const auto between = [&](const std::string& method, const std::string& blur_m) {
        Style style = sunlight_alone(30.0F);
        style.set("shadow.ground=" + method);
        style.set("shadow.ground_blur_m=" + blur_m);
        style.set("wash.softness=0.5"); // paint shows all shares of the sun, not only light and shade
        const Image image = renderer.render(above, style, terrain_page);
        const double lit = brightness_at(image, 8, 45);
        const double dark = brightness_at(image, 80, 45);
        int count = 0;
        for (uint32_t x = 8; x < 80; ++x) {
            const double share = (brightness_at(image, x, 45) - dark) / (lit - dark);
            count += share > 0.1 && share < 0.9 ? 1 : 0;
        }
        return count;
    };
    for (const char* const method : {"march", "above"}) {
        const int narrow = between(method, "0.75");
        EXPECT_LE(between(method, "0"), 2) << method;
        EXPECT_GT(narrow, 4) << method;
        EXPECT_NEAR(between(method, "1.5"), 2 * narrow, 3) << method;
    }
}

/// After a jump of a million metres, nothing kept from earlier pictures is visible.
TEST(TerrainPictures, NothingIsLeftOfWhereTheEyeWas)
{
    const Scene scene = ground_of(wave_ground);
    Renderer walked(test::validated());
    walked.set_scene(scene);
    const glm::dvec3 far(1048576.0 + 7.0, 6.0, 11.0);
    const Image before = walked.render(looking({3.0, 6.0, 0.0}, 0.3, -0.2), {}, terrain_page);
    const Image after = walked.render(looking(far, 0.9, -0.2), {}, terrain_page);
    Renderer fresh(test::validated());
    fresh.set_scene(scene);
    EXPECT_TRUE(after == fresh.render(looking(far, 0.9, -0.2), {}, terrain_page));
    EXPECT_FALSE(before == after);
}

/// The terrain's graph changes in an unchanged scene. It is interpreted first, then compiled; both give the
/// same picture.
TEST(TerrainPictures, GraphsAreSwapped)
{
    Renderer swapped(test::validated());
    swapped.set_scene(ground_of(wave_ground));
    const Camera camera = looking({3.0, 6.0, 0.0}, 0.3, -0.2);
    const Image first = swapped.render(camera, {}, terrain_page);
    const std::string other = "[terrain]\nheight = '1.5 * sine(20) + x * 0'\n[mesh]\ncells = 32\n";
    const Terrain terrain(parse_terrain(other, "other.toml"));
    swapped.set_terrain(terrain, true);
    const Image at_once = swapped.render(camera, {}, terrain_page);
    while (swapped.is_terrain_compiling()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const Image meanwhile = swapped.render(camera, {}, terrain_page);
    swapped.set_terrain(terrain);
    const Image compiled = swapped.render(camera, {}, terrain_page);
    EXPECT_FALSE(first == at_once);
    EXPECT_TRUE(meanwhile == compiled);
    size_t differing = 0;
    for (size_t i = 0; i < compiled.rgba.size(); i += 4) {
        differing += std::abs(compiled.rgba[i] - at_once.rgba[i]) > 8 ? 1U : 0U;
    }
    EXPECT_LE(differing, terrain_page.width * terrain_page.height / 200);
    swapped.set_scene(test::scene_of(shapes::box({1.0F, 1.0F, 1.0F})));
    EXPECT_THROW(swapped.set_terrain(terrain), Error);
}

/// Changes a terrain in one respect after the other. Each picture equals that of a scene loaded with that
/// terrain, bit for bit; a rejected terrain leaves the last one.
TEST(TerrainPictures, WhatIsSwappedIsAsIfDrawnAfresh)
{
    const std::string head = "[terrain]\nheight = '2 * sine(32) + sin(time) * sine(8)'\n";
    const std::vector<std::string> files{
        head + "[mesh]\ncells = 32\n",
        head + "color = '#305080'\n[mesh]\ncells = 32\n",
        head + "[mesh]\ncells = 64\ncell_m = 0.5\n",
        head + "[mesh]\nmethod = 'grid'\ncells = 64\n",
        head + "[mesh]\ncells = 32\nreach_m = 60\n",
        head + "[mesh]\ncells = 32\nplanet_radius_m = 300\n",
        head + "[mesh]\ncells = 32\nupdate = 'still'\n",
        head + "[mesh]\ncells = 32\nupdate = 'always'\n",
        head + "[mesh]\ncells = 32\n[ripples]\nwavelength_m = 3\nheight_m = 1\n",
        "[terrain]\nheight = '70 + 2 * sine(32)'\n[mesh]\ncells = 32\n",
        "[terrain]\nheight = '3'\n[mesh]\nmethod = 'object'\nobject = 'Field'\n",
        wave_ground};
    Scene scene = test::scene_of(shapes::box({6.0F, 0.1F, 6.0F}));
    scene.nodes[0].name = "Field";
    Renderer swapped(test::validated());
    Renderer fresh(test::validated());
    RenderSettings settings = terrain_page;
    settings.time_s = 1.25;
    for (const bool has_object : {true, false}) {
        scene.terrain = Terrain(parse_terrain(wave_ground, "first.toml"));
        swapped.set_scene(has_object ? scene : ground_of(wave_ground));
        std::optional<Image> before;
        for (const std::string& file : files) {
            const Terrain terrain(parse_terrain(file, "other.toml"));
            const bool is_raised = terrain.description().meshing.method == TerrainMesh::object;
            if (is_raised && !has_object) {
                EXPECT_THROW(swapped.set_terrain(terrain), Error);
            } else {
                swapped.set_terrain(terrain);
                scene.terrain = terrain;
            }
            fresh.set_scene(has_object ? scene : Scene{.materials = {Material{}}, .terrain = scene.terrain});
            const double height_m = scene.terrain->sample(0.0, 0.0).height_m;
            const Camera camera = looking({3.0, height_m + 6.0, 0.0}, 0.3, -0.3);
            const Image image = swapped.render(camera, {}, settings);
            EXPECT_TRUE(image == fresh.render(camera, {}, settings)) << file << has_object;
            EXPECT_TRUE(!before || file == wave_ground || (is_raised && !has_object) || !(image == *before))
                << file << " shows";
            before = image;
        }
    }
}

/// A planet's ground ends at the point opposite of the eye. A longer reach changes no pixel, because the
/// ground beyond it would go round the planet again and show among the ground before the eye.
TEST(TerrainPictures, APlanetsGroundGoesRoundItOnlyOnce)
{
    const std::string dunes =
        "[terrain]\nheight = 'dunes(40, 5)'\n[mesh]\ncells = 32\nplanet_radius_m = 300\n";
    const Camera camera = looking({3.0, 9.0, 0.0}, 0.3, -0.2);
    std::optional<Image> half_way;
    for (const char* const reach : {"reach_m = 470\n", "reach_m = 3000\n", "reach_m = 100000\n"}) {
        Renderer renderer(test::validated());
        renderer.set_scene(ground_of(dunes + reach));
        const Image image = renderer.render(camera, {}, terrain_page);
        EXPECT_TRUE(!half_way || image == *half_way) << reach;
        half_way = image;
    }
}

/// Simulated sand: dunes move over time, and a moment looks the same whichever moments came before.
TEST(TerrainPictures, SandIsBlown)
{
    const Scene scene =
        ground_of("[terrain]\nheight = 'sand(64, depth = 3, start = 30, rate = 2)'\n[mesh]\ncells = 32\n");
    Renderer once(test::validated());
    once.set_scene(scene);
    const Camera camera = looking({3.0, 14.0, 0.0}, 0.3, -0.4);
    const Style raking = sunlight_alone(6.0F);
    RenderSettings at = terrain_page;
    at.time_s = 10.25;
    const Image later = once.render(camera, raking, at);
    Renderer again(test::validated());
    again.set_scene(scene);
    const Image first = again.render(camera, raking, terrain_page);
    at.time_s = 4.0;
    EXPECT_FALSE(first == again.render(camera, raking, at));
    at.time_s = 10.25;
    EXPECT_TRUE(later == again.render(camera, raking, at));
    EXPECT_TRUE(first == again.render(camera, raking, terrain_page)) << "back again";
}

/// The terrain displaces an object of the scene in place; the object itself is not drawn.
TEST(TerrainPictures, AnObjectIsRaised)
{
    Scene scene = test::scene_of(shapes::box({8.0F, 0.1F, 8.0F}));
    scene.nodes[0].name = "Field";
    scene.materials[0].base_color = {0.0F, 0.0F, 0.0F, 1.0F}; // would show the object's own surface
    scene.terrain = Terrain(parse_terrain(
        "[terrain]\nheight = '3'\n[mesh]\nmethod = 'object'\nobject = 'Field'\n", "raised.toml"));
    Scene lifted = test::scene_of(shapes::box({8.0F, 0.1F, 8.0F}));
    lifted.materials[0].base_color = glm::vec4(scene.terrain->description().look.color, 1.0F);
    lifted.nodes[0].transform.translation.y = 3.0;
    const Camera camera{.eye = {12.0, 9.0, 14.0}, .target = {0.0, 3.0, 0.0}};
    Style style = sunlight_alone(60.0F);
    style.set("picture.ground=false");
    style.set("light.shadows=false");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Image raised = renderer.render(camera, style, terrain_page);
    renderer.set_scene(lifted);
    const Image expected = renderer.render(camera, style, terrain_page);
    size_t differing = 0;
    for (size_t i = 0; i < raised.rgba.size(); i += 4) {
        differing += std::abs(raised.rgba[i] - expected.rgba[i]) > 60 ? 1U : 0U;
    }
    EXPECT_LE(differing, 40U);
    scene.terrain = Terrain(parse_terrain(
        "[terrain]\nheight = '3'\n[mesh]\nmethod = 'object'\nobject = 'Sea'\n", "nowhere.toml"));
    EXPECT_THROW(renderer.set_scene(scene), Error);
}

} // namespace
} // namespace estampe
