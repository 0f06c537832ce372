// SPDX-License-Identifier: MIT
// Default light without options: rooms without lights, seen from outside, from a corner, and from inside.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "scene/view_analysis/view_analysis.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/light/light.hpp"

namespace estampe {
namespace {

constexpr RenderSettings lit_page{.width = 192, .height = 144};
constexpr double aspect = 192.0 / 144.0;

/// Shares of paper, ink and half tones in a picture.
struct Tones {
    double mean_ink = 0.0; ///< 0 paper, 1 black
    double blank = 0.0;    ///< share of pixels
    double dark = 0.0;     ///< share of pixels that are nearly black, since strokes are thinner than a pixel
};

Tones tones_of(const Image& image)
{
    Tones tones;
    const double count = static_cast<double>(image.width) * image.height;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        const double lightness = std::max({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]}) / 245.0;
        const double ink = std::clamp(1.0 - lightness, 0.0, 1.0);
        tones.mean_ink += ink / count;
        tones.blank += (ink < 0.15 ? 1.0 : 0.0) / count;
        tones.dark += (ink > 0.35 ? 1.0 : 0.0) / count;
    }
    return tones;
}

Image draw_lit(const Scene& scene, const Camera& camera, const Style& style = {})
{
    test::shared_renderer().set_scene(scene);
    return test::shared_renderer().render(camera, style, lit_page);
}

Camera framed(const Scene& scene)
{
    return framing_camera(scene, pose_scene(scene, 0.0), aspect);
}

void expect_light_half_tone_and_dark(const Image& image)
{
    const Tones tones = tones_of(image);
    EXPECT_GT(tones.mean_ink, 0.06);
    EXPECT_LT(tones.mean_ink, 0.42);
    EXPECT_GT(tones.blank, 0.25);
    EXPECT_GT(tones.dark, 0.02);
}

void furnish(Scene& scene)
{
    test::add_object(scene, shapes::box({1.2F, 0.8F, 0.8F}), glm::vec3(0.8F), {-0.8, 0.0, -0.6});
    test::add_object(scene, shapes::cylinder(0.3F, 1.6F), glm::vec3(0.6F), {1.0, 0.0, -1.0});
}

/// A single-sided room of 4 x 3 x 5 metres whose walls face inwards; `open` leaves out the wall at +z.
Scene thin_room(bool open)
{
    Primitive inside;
    shapes::append(inside, shapes::box({4.0F, 3.0F, 5.0F}), glm::mat4(1.0F));
    Primitive walls = inside;
    walls.indices.clear();
    for (size_t i = 0; i < inside.indices.size(); i += 3) {
        const auto z = [&](size_t k) { return inside.positions[inside.indices[i + k]].z; };
        if (!open || std::min({z(0), z(1), z(2)}) < 0.0F) {
            walls.indices.insert(walls.indices.end(),
                                 {inside.indices[i], inside.indices[i + 2], inside.indices[i + 1]});
        }
    }
    for (glm::vec3& normal : walls.normals) {
        normal = -normal;
    }
    Scene scene = test::scene_of(walls);
    furnish(scene);
    return scene;
}

/// A room of 6 x 3 x 5 metres, made of six slabs.
Scene thick_room()
{
    Primitive slabs;
    const auto add = [&slabs](const glm::vec3& size, const glm::vec3& place) {
        shapes::append(slabs, shapes::box(size), glm::translate(glm::mat4(1.0F), place));
    };
    add({6.6F, 0.3F, 5.6F}, {0.0F, -0.3F, 0.0F});
    add({6.6F, 0.3F, 5.6F}, {0.0F, 3.0F, 0.0F});
    for (const float side : {-1.0F, 1.0F}) {
        add({6.6F, 3.0F, 0.3F}, {0.0F, 0.0F, 2.65F * side});
        add({0.3F, 3.0F, 5.0F}, {3.15F * side, 0.0F, 0.0F});
    }
    Scene scene = test::scene_of(slabs);
    furnish(scene);
    return scene;
}

TEST(DefaultLightPictures, ARoomIsLitWhetherItIsOpenOrClosed)
{
    for (const bool open : {true, false}) {
        SCOPED_TRACE(open);
        const Scene scene = thin_room(open);
        expect_light_half_tone_and_dark(draw_lit(scene, framed(scene)));
        EXPECT_EQ(test::shared_renderer().notes().size(), 1U);
    }
    const Scene closed = thin_room(false);
    Style sun;
    sun.set("light.source=sun");
    const Tones in_the_sun = tones_of(draw_lit(closed, framed(closed), sun));
    EXPECT_TRUE(test::shared_renderer().notes().empty());
    EXPECT_GT(in_the_sun.mean_ink, tones_of(draw_lit(closed, framed(closed))).mean_ink + 0.1);
}

TEST(DefaultLightPictures, DaylightThrowsNoEdgeOfTheOpeningThroughARoom)
{
    const Scene scene = thin_room(true);
    const ScenePose pose = pose_scene(scene, 0.0);
    const Bounds bounds = scene_bounds(scene, pose);
    const light::Lighting lighting =
        light::gather_lights(scene, pose, bounds, bounds.center(), {}, analyze_view(scene));
    ASSERT_TRUE(lighting.indoors);
    EXPECT_EQ(lighting.directional_count, 1U);
    EXPECT_EQ(lighting.sun_casters, 0U);
}

TEST(DefaultLightPictures, TheGroundStaysBlankHoweverLowTheSun)
{
    const Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    for (const float elevation_deg : {60.0F, 20.0F, 8.0F}) {
        Style style;
        style.set("light.turn_sun=false");
        style.set("light.sun_azimuth_deg=-150"); // backlight: shadows fall towards the eye
        style.set(fmt::format("light.sun_elevation_deg={}", elevation_deg));
        const Image image = draw_lit(scene, framed(scene), style);
        Image corner{.width = image.width / 6, .height = image.height / 6};
        for (uint32_t y = 0; y < corner.height; ++y) {
            const auto row = image.rgba.begin() + static_cast<std::ptrdiff_t>(4) * y * image.width;
            corner.rgba.insert(corner.rgba.end(), row, row + static_cast<std::ptrdiff_t>(4) * corner.width);
        }
        EXPECT_GT(tones_of(corner).blank, 0.99) << elevation_deg << " degrees";
    }
}

TEST(DefaultLightPictures, AClosedHouseIsSeenFromItsCorner)
{
    const Scene scene = thick_room();
    expect_light_half_tone_and_dark(draw_lit(scene, framed(scene)));
}

TEST(DefaultLightPictures, ACameraInsideOfAHouseHasALampAndOneOutsideTheSun)
{
    Scene scene = thick_room();
    test::add_object(scene, shapes::cone(1.5F, 4.0F), glm::vec3(0.7F), {9.0, -0.3, 0.0});
    expect_light_half_tone_and_dark(draw_lit(scene, {.eye = {2.4, 1.6, 2.0}, .target = {-1.0, 0.8, -1.0}}));
    EXPECT_EQ(test::shared_renderer().notes().size(), 1U);
    std::ignore = draw_lit(scene, {.eye = {14.0, 5.0, 16.0}, .target = {3.0, 1.0, 0.0}});
    EXPECT_TRUE(test::shared_renderer().notes().empty());
}

TEST(DefaultLightPictures, TheSunTurnsWithTheFront)
{
    // The model turns by 180 degrees. Camera and sun follow its front, so the picture must not change.
    Primitive beast;
    const auto add = [&beast](const Primitive& part, const glm::vec3& place) {
        shapes::append(beast, part, glm::translate(glm::mat4(1.0F), place));
    };
    add(shapes::box({0.6F, 0.6F, 1.6F}), {0.0F, 0.6F, 0.0F});
    add(shapes::box({0.5F, 0.5F, 0.5F}), {0.0F, 1.2F, 1.0F});
    for (const float z : {-0.7F, 0.7F}) {
        add(shapes::box({0.5F, 0.7F, 0.15F}), {0.0F, 0.0F, z});
    }
    Scene scene = test::scene_of(beast);
    const Tones forward = tones_of(draw_lit(scene, framed(scene)));
    scene.nodes[0].transform.rotation = glm::angleAxis(3.14159265, glm::dvec3(0, 1, 0));
    const Tones turned = tones_of(draw_lit(scene, framed(scene)));
    EXPECT_NEAR(forward.mean_ink, turned.mean_ink, 0.01);
    EXPECT_NEAR(forward.blank, turned.blank, 0.02);
    EXPECT_NEAR(forward.dark, turned.dark, 0.01);
}

} // namespace
} // namespace estampe
