// SPDX-License-Identifier: MIT
// Drifting sand and footprints in pictures.
#include <algorithm>
#include <array>
#include <vector>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace estampe {
namespace {

constexpr RenderSettings drift_page{.width = 192, .height = 96};

/// A ridge along z, 24 m long: a gentle rise for 40 m, a brink at x = 0, a slip face.
Scene ridge(const std::string& rest)
{
    Scene scene{.materials = {Material{}}};
    scene.terrain = Terrain(parse_terrain("[terrain]\nheight = 'max(0, min(0.2 * (x + 40), 8 - 0.62 * x)) * "
                                          "smoothstep(12, 8, abs(z))'\n[mesh]\ncells = 64\ncell_m = 1\n"
                                          "[ripples]\nheight_m = 0\n" +
                                              rest,
                                          "test.toml"));
    return scene;
}

Style plain(const char* setting = nullptr)
{
    Style style;
    for (const char* const each : {"hatch.enabled=false", "contour.enabled=false", "sky.enabled=false",
                                   "paper.margin_mm=0", "paper.grain=0", "paper.granulation=0",
                                   "haze.enabled=false", "paper.ink_break=0", "drift.width_mm=2"}) {
        style.set(each);
    }
    if (setting != nullptr) {
        style.set(setting);
    }
    return style;
}

/// Looks along z over the ridge; the picture is 48 m wide, from x = -24 to 24.
Camera from_the_side(double z_m)
{
    Camera camera{.eye = {0.0, 9.0, z_m}, .target = {0.0, 9.0, z_m + 1.0}};
    camera.orthographic_half_height_m = 12.0;
    return camera;
}

double place_of(uint32_t column)
{
    return 24.0 - (column + 0.5) * 48.0 / drift_page.width; // +x is on the left when looking along +z
}

struct Difference {
    size_t pixels = 0;
    double least_x_m = 1e9;
    double most_x_m = -1e9;
};

Difference between(const Image& a, const Image& b)
{
    Difference result;
    for (uint32_t i = 0; i < a.width * a.height; ++i) {
        if (std::abs(a.rgba[4 * i] - b.rgba[4 * i]) > 8) {
            ++result.pixels;
            result.least_x_m = std::min(result.least_x_m, place_of(i % a.width));
            result.most_x_m = std::max(result.most_x_m, place_of(i % a.width));
        }
    }
    return result;
}

Image drawn_drift(const Scene& scene, const Camera& camera, const Style& style, double time_s = 0.0)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    RenderSettings settings = drift_page;
    settings.time_s = time_s;
    return renderer.render(camera, style, settings);
}

/// Streaks start at the brink and fly with the wind. There are none in weak wind, in wind up the slip face,
/// or if the style turns them off.
TEST(Drift, FliesOffTheBrinkWithTheWind)
{
    const Scene windy = ridge("[wind]\nspeed_m_per_s = 9\n");
    const Image none = drawn_drift(windy, from_the_side(-30.0), plain("drift.enabled=false"));
    const Image with = drawn_drift(windy, from_the_side(-30.0), plain());
    const Difference sand = between(with, none);
    EXPECT_GT(sand.pixels, 150U);
    EXPECT_GT(sand.least_x_m, -3.0);
    EXPECT_GT(sand.most_x_m, 8.0);
    EXPECT_TRUE(with == drawn_drift(windy, from_the_side(-30.0), plain()));
    EXPECT_GT(between(with, drawn_drift(windy, from_the_side(-30.0), plain(), 0.3)).pixels, 100U);
    const Image still = drawn_drift(ridge("[wind]\nspeed_m_per_s = 5\n"), from_the_side(-30.0), plain());
    EXPECT_TRUE(still == none);
    const Scene wanted = ridge("[wind]\nspeed_m_per_s = 5\n");
    EXPECT_GT(between(drawn_drift(wanted, from_the_side(-30.0), plain("drift.enabled=true")), none).pixels,
              100U);
    const Scene level = [] {
        Scene scene{.materials = {Material{}}};
        scene.terrain =
            Terrain(parse_terrain("[terrain]\nheight = 'x * 0'\n[wind]\nspeed_m_per_s = 9\n", "level.toml"));
        return scene;
    }();
    EXPECT_TRUE(drawn_drift(level, from_the_side(-30.0), plain()) ==
                drawn_drift(level, from_the_side(-30.0), plain("drift.enabled=false")));
}

/// Objects in front hide the drift: an eye below the slip face sees none.
TEST(Drift, IsHiddenByWhatStandsBefore)
{
    const Scene windy = ridge("[wind]\nspeed_m_per_s = 9\n");
    Camera from_windward{.eye = {-60.0, 3.0, 0.0}, .target = {0.0, 3.0, 0.0}};
    from_windward.orthographic_half_height_m = 2.5; // the windward side fills the page
    EXPECT_TRUE(drawn_drift(windy, from_windward, plain()) ==
                drawn_drift(windy, from_windward, plain("drift.enabled=false")));
}

/// Streaks keep their places when the eye moves by a whole number of their cells: in parallel projection, an
/// eye farther away sees them in the same pixels.
TEST(Drift, StaysInItsPlace)
{
    const Scene windy = ridge("[wind]\nspeed_m_per_s = 9\n");
    const auto sand_seen = [&](double z_m, double time_s) {
        const Image with = drawn_drift(windy, from_the_side(z_m), plain("drift.width_mm=0.8"), time_s);
        const Image none = drawn_drift(windy, from_the_side(z_m), plain("drift.enabled=false"), time_s);
        std::vector<bool> seen(size_t{drift_page.width} * drift_page.height);
        for (size_t i = 0; i < seen.size(); ++i) {
            seen[i] = std::abs(with.rgba[4 * i] - none.rgba[4 * i]) > 8;
        }
        return seen;
    };
    const auto others = [](const std::vector<bool>& a, const std::vector<bool>& b) {
        size_t count = 0;
        for (size_t i = 0; i < a.size(); ++i) {
            count += a[i] != b[i] ? 1U : 0U;
        }
        return count;
    };
    const std::vector<bool> here = sand_seen(-30.0, 0.0);
    EXPECT_GT(std::count(here.begin(), here.end(), true), 100);
    EXPECT_LT(8 * others(here, sand_seen(-53.4375, 0.0)), others(here, sand_seen(-30.0, 1.1)));
}

/// A track from the terrain's file is visible, grows over time, and is filled by the wind. Footprints from
/// the calling program appear next to it.
TEST(TrailPictures, AreSeenAndFilled)
{
    const std::string level = "[terrain]\nheight = 'x * 0'\n[mesh]\ncells = 64\n[ripples]\nheight_m = 0\n"
                              "[trails]\nhalf_life_s = 20\nextent_m = 24\n";
    const auto scene_of = [](const std::string& toml) {
        Scene scene{.materials = {Material{}}};
        scene.terrain = Terrain(parse_terrain(toml, "test.toml"));
        return scene;
    };
    const Camera camera{.eye = {0.0, 3.0, 0.0}, .target = {6.0, 0.0, 0.0}};
    Style style = plain("light.source=sun");
    style.set("light.sun_elevation_deg=20");
    style.set("light.turn_sun=false");
    Renderer& renderer = test::shared_renderer();
    const auto picture = [&](double time_s, Continuity continuity = Continuity::still) {
        RenderSettings settings = drift_page;
        settings.time_s = time_s;
        settings.continuity = continuity;
        return renderer.render(camera, style, settings);
    };
    renderer.set_scene(scene_of(level));
    const Image blank = picture(0.0);
    renderer.set_scene(scene_of(level + "[tracks]\nwalker = '3,-1 5,1 9,0 start=0 pace=1'\n"));
    EXPECT_TRUE(picture(-1.0) == blank);
    std::array<size_t, 4> seen{};
    for (size_t i = 0; i < seen.size(); ++i) {
        const auto continuity = i == 0 ? Continuity::starts : Continuity::follows;
        seen[i] = between(picture(2.0 * static_cast<double>(i) + 1.0, continuity), blank).pixels;
    }
    EXPECT_GT(seen[0], 10U);
    EXPECT_GT(seen[1], seen[0]);
    EXPECT_GT(seen[3], seen[1]);
    const Image alone = picture(7.0);
    const auto found = static_cast<double>(between(alone, blank).pixels);
    EXPECT_NEAR(found, static_cast<double>(seen[3]), 0.35 * found);
    EXPECT_TRUE(picture(400.0) == blank) << "filled";
    EXPECT_TRUE(picture(7.0) == alone) << "whatever was drawn before";
    renderer.set_scene(scene_of(level));
    const TrailStamp ball = TrailStamp::disc({6.0, 0.0}, 0.8F, 0.3F);
    renderer.press({&ball, 1});
    const Image pressed = picture(0.0);
    EXPECT_GT(between(pressed, blank).pixels, 40U);
    EXPECT_FALSE(picture(10.0) == pressed);
    EXPECT_TRUE(picture(0.0) == pressed);
    EXPECT_TRUE(picture(-1.0) == blank) << "forgotten";
    EXPECT_TRUE(picture(0.0) == blank);
    renderer.set_scene(Scene{.materials = {Material{}}});
    EXPECT_THROW(renderer.press({&ball, 1}), Error);
}

} // namespace
} // namespace estampe
