// SPDX-License-Identifier: MIT
#include "features/common/view.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace estampe::features {
namespace {

/// A row of places at distances of 1, 2, 3 ... metres.
std::vector<glm::vec3> row(int count)
{
    std::vector<glm::vec3> places;
    for (int i = 1; i <= count; ++i) {
        places.emplace_back(0.0F, 0.0F, static_cast<float>(i));
    }
    return places;
}

TEST(Nearby, IsWhereTheNearestFifthEnds)
{
    EXPECT_NEAR(nearby(row(1000), glm::vec3(0.0F)), 200.0F, 2.0F);
    EXPECT_NEAR(nearby(row(50000), glm::vec3(0.0F)), 10000.0F, 30.0F);
    EXPECT_EQ(nearby({}, glm::vec3(0.0F)), 0.0F);
}

TEST(Nearby, ChangesAsLittleAsTheEyeMoves)
{
    const std::vector<glm::vec3> places = row(2000);
    float before = nearby(places, glm::vec3(0.0F));
    for (int step = 1; step < 200; ++step) {
        const float now = nearby(places, {0.0F, 0.0F, 0.5F * static_cast<float>(step)});
        EXPECT_LE(std::abs(now - before), 0.5F + 1e-3F);
        before = now;
    }
}

TEST(SeenWithin, ShowsTheSameInASmallerWindow)
{
    constexpr double share = 0.8;
    Camera perspective{.eye = {1.0, 2.0, 7.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};
    Camera parallel = perspective;
    parallel.orthographic_half_height_m = 2.5;
    for (const Camera& camera : {perspective, parallel}) {
        const auto on_page = [&](const Camera& from, const glm::vec3& place) {
            const auto globals =
                frame_globals(from, {{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}}, {}, {.size_px = {400, 300}});
            const glm::vec4 clip = globals.clip_from_anchor * glm::vec4(place, 1.0F);
            return glm::vec2(clip) / clip.w;
        };
        for (const glm::vec3& place : {glm::vec3(0.3F, 1.4F, 0.2F), glm::vec3(-1.0F, -0.5F, 2.0F)}) {
            const glm::vec2 whole = on_page(camera, place);
            const glm::vec2 within = on_page(seen_within(camera, glm::dvec2(share)), place);
            EXPECT_NEAR(within.x, share * whole.x, 1e-5);
            EXPECT_NEAR(within.y, share * whole.y, 1e-5);
        }
    }
}

TEST(LensShift, MovesThePictureByAShareOfThePage)
{
    Camera perspective{.eye = {1.0, 2.0, 7.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};
    Camera parallel = perspective;
    parallel.orthographic_half_height_m = 2.5;
    const Survey survey{.part = {.size_px = {400, 300}}, .shrink = 4};
    for (const Camera& camera : {perspective, parallel}) {
        for (const std::optional<Survey>& reduced :
             {std::optional<Survey>(), std::optional<Survey>(survey)}) {
            const auto on_page = [&](const Camera& from, const glm::vec3& place) {
                const auto globals = frame_globals(from, {{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}}, {},
                                                   {.size_px = {400, 300}, .survey = reduced});
                const glm::vec4 clip = globals.clip_from_anchor * glm::vec4(place, 1.0F);
                EXPECT_LT(glm::distance(globals.anchor_from_clip * clip, glm::vec4(place, 1.0F)), 1e-3F);
                return glm::vec3(clip) / clip.w;
            };
            Camera shifted = camera;
            shifted.shift = {0.25, -0.125};
            for (const glm::vec3& place : {glm::vec3(0.0F, 0.5F, 0.0F), glm::vec3(-1.0F, -0.5F, 2.0F)}) {
                const glm::vec3 before = on_page(camera, place);
                const glm::vec3 after = on_page(shifted, place);
                EXPECT_NEAR(after.x, before.x - 0.5F, 1e-5) << "to the left by a quarter of the page's width";
                EXPECT_NEAR(after.y, before.y - 0.25F, 1e-5)
                    << "up by an eighth of its height; y points down";
                EXPECT_FLOAT_EQ(after.z, before.z) << "depths stay";
            }
            const glm::vec3 place(0.3F, 1.4F, 0.2F);
            const glm::vec3 within = on_page(seen_within(shifted, {0.9, 0.8}), place);
            EXPECT_NEAR(within.x, 0.8F * on_page(camera, place).x - 0.9F * 0.5F, 1e-5)
                << "a quarter of the window's width";
            EXPECT_NEAR(within.y, 0.8F * on_page(camera, place).y - 0.8F * 0.25F, 1e-5);
        }
    }
}

TEST(EverySecond, HasTheMiddlesOfEvenPixels)
{
    const Camera camera{.eye = {1.0, 2.0, 7.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.7};
    for (const features::PixelRect& tile : {features::PixelRect{.from_px = {0, 0}, .size_px = {401, 300}},
                                            features::PixelRect{.from_px = {33, 18}, .size_px = {64, 51}}}) {
        const auto whole = frame_globals(camera, {{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}}, {},
                                         {.size_px = {401, 301}, .tile = tile});
        const auto half = every_second(whole);
        const auto seen_at = [](const shared::FrameGlobals& globals, glm::uvec2 pixel) {
            const glm::vec2 place = glm::vec2(pixel + globals.tile_from_px) + 0.5F;
            const glm::vec2 ndc = 2.0F * place / glm::vec2(globals.page_px) - 1.0F;
            const glm::vec4 p = globals.anchor_from_clip * glm::vec4(ndc, 0.03F, 1.0F);
            return glm::vec3(p) / p.w;
        };
        const glm::uvec2 first = tile.from_px & 1U;
        EXPECT_EQ(half.size_px, (tile.size_px + 1U - first) / 2U);
        for (const glm::uvec2 pixel : {glm::uvec2(0, 0), glm::uvec2(3, 20), half.size_px - 1U}) {
            EXPECT_LT(glm::distance(seen_at(half, pixel), seen_at(whole, first + 2U * pixel)), 1e-5F);
            const glm::vec4 clip = half.clip_from_anchor * glm::vec4(seen_at(half, pixel), 1.0F);
            const glm::vec2 place = 0.5F * (glm::vec2(clip) / clip.w + 1.0F) * glm::vec2(half.page_px);
            EXPECT_LT(glm::distance(place, glm::vec2(pixel + half.tile_from_px) + 0.5F), 1e-3F);
        }
    }
}

} // namespace
} // namespace estampe::features
