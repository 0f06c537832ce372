// SPDX-License-Identifier: MIT
// Moving casters over a map of static casters must give the same pictures as a newly drawn map.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/image_compare.hpp"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

constexpr RenderSettings settings{.width = 160, .height = 90};
constexpr Index rider = 6; ///< the moving node
constexpr Index bird = 7;  ///< another moving node, small and far away

/// Pillars on a long plane under a low sun. The two outermost pillars enclose all moving nodes.
Scene pillars()
{
    Scene scene = test::scene_of(shapes::plane(120.0F, 120.0F));
    for (const double x : {-45.0, -6.0, 0.0, 7.0, 45.0}) {
        test::add_object(scene, shapes::box({1.0F, 12.0F, 1.0F}), glm::vec3(0.7F), {x, 6.0, -0.8 * x});
    }
    test::add_object(scene, shapes::sphere(0.8F), {0.7F, 0.1F, 0.1F}, {-3.0, 1.5, 3.0});
    test::add_object(scene, shapes::sphere(0.3F), {0.1F, 0.1F, 0.7F}, {30.0, 9.0, -20.0});
    test::add_sun(scene, {-1.0, 0.7, 0.6});
    return scene;
}

struct RiderMoment {
    double eye_x = 0.0;
    glm::dvec3 rider{-3.0, 1.5, 3.0};
    glm::dvec3 bird{30.0, 9.0, -20.0};
    double hour = 16.0; ///< time of day, which sets the sun
};

Style clipmapped(double hour)
{
    Style style;
    style.set("shadow.sun_map=clipmap");
    style.set("sun.by=place");
    style.set("sun.hour=" + std::to_string(hour));
    return style;
}

Image draw(Renderer& renderer, const RiderMoment& moment)
{
    const std::vector<NodePlace> places{{rider, {.translation = moment.rider}},
                                        {bird, {.translation = moment.bird}}};
    renderer.place(places, 0.0);
    return renderer.render({.eye = {moment.eye_x, 3.0, 16.0}, .target = {moment.eye_x, 1.0, 0.0}},
                           clipmapped(moment.hour), settings);
}

bool has_pass_of(const Renderer& renderer, const std::string& name)
{
    return std::ranges::any_of(renderer.timings(),
                               [&](const PassTiming& timing) { return timing.name.starts_with(name); });
}

RendererOptions by_compute()
{
    RendererOptions options = test::validated();
    options.raster = RasterPath::compute;
    return options;
}

/// The rider moves back and forth with pauses; the eye follows, turns back and jumps.
std::vector<RiderMoment> rider_moments()
{
    return {{0.0},
            {0.0, {-2.5, 1.5, 3.0}},
            {0.0, {-2.0, 1.5, 2.0}, {29.0, 9.0, -21.0}},
            {0.0, {2.0, 0.9, 2.0}, {29.0, 9.0, -21.0}},
            {1.5, {2.0, 0.9, 2.0}, {29.0, 9.0, -21.0}},
            {3.0, {2.2, 0.9, 2.5}, {12.0, 9.0, -3.0}},
            {3.0, {2.2, 0.9, 2.5}, {12.0, 9.0, -3.0}},
            {40.0, {2.3, 0.9, 2.5}, {28.0, 9.0, -3.0}},
            {2.0, {2.4, 0.9, 2.5}, {27.0, 9.0, -3.0}},
            {2.0, {-3.0, 1.5, 3.0}, {26.0, 8.0, -3.0}}};
}

TEST(SunLayers, GiveThePicturesOfAMapDrawnAfresh)
{
    Renderer kept(by_compute());
    Renderer fresh(by_compute());
    const Scene scene = pillars();
    kept.set_scene(scene);
    size_t mixed = 0;
    size_t at = 0;
    for (const RiderMoment& moment : rider_moments()) {
        fresh.set_scene(scene);
        const Image wanted = draw(fresh, moment);
        EXPECT_FALSE(has_pass_of(fresh, "shadow/mix")) << at;
        EXPECT_EQ(test::compare_images(draw(kept, moment), wanted).failing_fraction, 0.0) << at;
        mixed += has_pass_of(kept, "shadow/mix") ? 1 : 0;
        ++at;
    }
    EXPECT_EQ(mixed, 8U); // all but the first moment and the one without prior motion
}

TEST(SunLayers, WhatStandsStillIsNotDrawnAgain)
{
    Renderer renderer(by_compute());
    renderer.set_scene(pillars());
    const auto draws_still = [&](const RiderMoment& moment) {
        (void)draw(renderer, moment);
        return has_pass_of(renderer, "shadow/small") || has_pass_of(renderer, "shadow/draw");
    };
    EXPECT_TRUE(draws_still({0.0}));
    EXPECT_TRUE(draws_still({0.0, {-2.5, 1.5, 3.0}})); // into the static map
    EXPECT_FALSE(draws_still({0.0, {-2.0, 1.5, 3.0}}));
    EXPECT_FALSE(draws_still({0.0, {-1.5, 1.5, 3.0}}));
    EXPECT_FALSE(has_pass_of((draw(renderer, {0.0, {-1.5, 1.5, 3.0}}), renderer), "shadow/"));
}

/// The rider moves all the time; the sun rests, moves, and rests again.
std::vector<RiderMoment> evening()
{
    std::vector<RiderMoment> moments;
    for (const double hour : {16.0, 16.0, 16.0, 16.004, 16.004, 16.004, 16.3, 16.3, 16.31, 16.32, 16.32}) {
        const double x = -3.0 + 0.3 * static_cast<double>(moments.size());
        moments.push_back({.rider = {x, 1.5, 3.0}, .hour = hour});
    }
    return moments;
}

TEST(SunLayers, FollowASunThatGoesOnInSteps)
{
    Renderer kept(by_compute());
    Renderer fresh(by_compute());
    const Scene scene = pillars();
    kept.set_scene(scene);
    std::vector<size_t> still_drawn; // indices of moments
    size_t at = 0;
    for (const RiderMoment& moment : evening()) {
        fresh.set_scene(scene);
        const Image wanted = draw(fresh, moment);
        EXPECT_EQ(test::compare_images(draw(kept, moment), wanted).failing_fraction, 0.0) << at;
        if (has_pass_of(kept, "shadow/small")) {
            still_drawn.push_back(at);
        }
        ++at;
    }
    // Static casters are drawn with all others first, then into their own map, and again for each sun step
    // after a rest. Of two consecutive steps the second draws everything together again.
    EXPECT_EQ(still_drawn, (std::vector<size_t>{0, 1, 3, 6, 8, 9, 10}));
}

TEST(SunLayers, AllLevelsAreDrawnTogether)
{
    Renderer renderer(by_compute());
    renderer.set_scene(pillars());
    (void)draw(renderer, {});
    const auto timings = renderer.timings();
    const auto count = [&](const std::string& name) {
        return std::ranges::count(timings, name, &PassTiming::name);
    };
    EXPECT_EQ(count("shadow/clear"), 1);
    EXPECT_LE(count("shadow/small"), 7); // batches of moving and static casters
    EXPECT_EQ(count("shadow/part"), 0);
}

} // namespace
} // namespace estampe::features
