// SPDX-License-Identifier: MIT
// The wash compared with its equations, on surfaces and light that the tests paint.
#include "techniques/wash/wash.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "core/color.hpp"
#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "shaders/shade.glsl.h"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::wash {
namespace {

constexpr glm::uvec2 size_px(48, 32);
constexpr uint32_t paper_bit = 1U << 31U; // DRAW_PAPER of shaders/surface_images.glsl
constexpr glm::vec3 red(0.6F, 0.1F, 0.05F);
const Camera camera{.eye = {0.0, 0.0, 4.0}, .vertical_fov_rad = 0.7};

/// A page covered by one draw of a red material, in full light, without transparent surfaces.
struct Page {
    test::Painter<uint32_t> draw = [](glm::uvec2) { return 1U; };
    test::Painter<float> depth = [](glm::uvec2) { return 0.01F; };
    test::Painter<glm::vec4> color = [](glm::uvec2) { return glm::vec4(red, 1.0F); };
    test::Painter<glm::vec4> light = [](glm::uvec2) { return glm::vec4(1.0F); };
    test::Painter<glm::vec4> background = [](glm::uvec2) { return glm::vec4(1.0F); };
    test::Painter<glm::vec4> screen = [](glm::uvec2) { return glm::vec4(0.0F); };
    std::optional<test::Painter<glm::vec4>> shade;
    glm::uvec2 background_size_px{1};
    bool has_background = true;
    bool has_screen = false;
    shared::MaterialRecord material{.mean_color = red, .shade_color = glm::vec3(1.0F)};
};

/// Paints at full strength, greys included.
WashStyle strong()
{
    WashStyle style;
    style.strength = 1.0F;
    style.neutral = 1.0F;
    style.detail = 0.0F;
    style.least = 0.0F;
    return style;
}

/// Darkness is one minus the light.
constexpr shared::ToneConstants plain_tone{
    .exposure = 1.0F, .gamma = 1.0F, .contrast = 1.0F, .floor = 0.0F, .ceiling = 1.0F, .local_value = 0.0F};

std::vector<glm::vec4> paint(const Page& page, const WashStyle& style,
                             const shared::ToneConstants& tone = plain_tone)
{
    const auto globals = features::frame_globals(camera, {}, glm::dvec3(0.0), {.size_px = size_px});
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    gpu::Buffer draws =
        gpu::upload_buffer(test::shared_device(), "draws", std::vector(1, shared::DrawRecord{}));
    gpu::Buffer materials =
        gpu::upload_buffer(test::shared_device(), "materials", std::vector{page.material});
    auto draw = test::Layer::words(size_px, page.draw);
    auto depth = test::Layer::depth(size_px, page.depth);
    auto color = test::Layer::root_color(size_px, page.color);
    auto light = test::Layer::color(size_px, page.light);
    auto background = test::Layer::color(page.background_size_px, page.background);
    auto screen = test::Layer::root_color(page.has_screen ? size_px : glm::uvec2(1), page.screen);
    std::optional<test::Layer> shade;
    if (page.shade) {
        shade = test::Layer::color(size_px, *page.shade);
    }
    gpu::Graph graph;
    const auto wash = add_wash(graph,
                               {.frame = gpu::import_whole(graph, "frame", frame),
                                .draw = draw.in(graph),
                                .depth = depth.in(graph),
                                .color = color.in(graph),
                                .light = light.in(graph),
                                .draws = gpu::import_whole(graph, "draws", draws),
                                .materials = gpu::import_whole(graph, "materials", materials),
                                .screen = screen.in(graph),
                                .has_screen = page.has_screen,
                                .shade = shade ? std::optional(shade->in(graph)) : std::nullopt,
                                .background = background.in(graph),
                                .has_background = page.has_background,
                                .size_px = size_px},
                               {{.style = style, .tone = tone}});
    return test::run_and_read_colors(graph, wash);
}

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-3F)
{
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
    }
}

void expect_everywhere(const std::vector<glm::vec4>& wash, const glm::vec3& expected, float tolerance = 1e-3F)
{
    expect_near(glm::vec3(wash[0]), expected, tolerance);
    EXPECT_TRUE(std::ranges::all_of(wash, [&](const glm::vec4& color) { return color == wash[0]; }))
        << "flat";
}

TEST(Wash, OfASpotColourIsMoreOfOneInkWhereAColourIsDarker)
{
    WashStyle style = strong();
    style.spot_color = {0.8F, 0.2F, 0.1F};
    Page page;
    page.background = [](glm::uvec2) { return glm::vec4(0.25F, 0.25F, 0.25F, 1.0F); };
    const float brightness = std::sqrt(0.2126F * red.x + 0.7152F * red.y + 0.0722F * red.z);
    for (const float spot : {0.0F, 0.5F, 1.0F}) {
        style.spot = spot;
        page.draw = [](glm::uvec2) { return 1U; };
        const glm::vec3 ink = glm::mix(style.spot_color, glm::vec3(1.0F), brightness);
        expect_everywhere(paint(page, style), glm::mix(red, ink, spot));
        page.draw = [](glm::uvec2) { return 0U; }; // the sky is printed too
        const glm::vec3 grey_ink = glm::mix(style.spot_color, glm::vec3(1.0F), 0.5F);
        expect_everywhere(paint(page, style), glm::mix(glm::vec3(0.25F), grey_ink, spot));
    }
}

TEST(Wash, IsTheMaterialsColourInLightAndTintedInShadow)
{
    Page page;
    WashStyle style = strong();
    expect_everywhere(paint(page, style), red);
    page.light = [](glm::uvec2) { return glm::vec4(0.2F); };
    expect_everywhere(paint(page, style), red * style.shadow_tint);
    page.material.shade_color = {0.2F, 0.9F, 0.5F};
    expect_everywhere(paint(page, style), red * style.shadow_tint * page.material.shade_color);
    const glm::vec3 tint = WashStyle{}.shadow_tint;
    EXPECT_LT(tint.x, tint.z) << "the shadow of the default style is cooler than its light";
}

TEST(Wash, ASecondColourReplacesTheTintInShadow)
{
    Page page;
    const glm::vec3 violet(0.25F, 0.0625F, 0.5F);
    float alpha = shared::shade_by_wash;
    page.shade.emplace([&](glm::uvec2) { return glm::vec4(violet, alpha); });
    page.material.shade_color = {0.2F, 0.9F, 0.5F};
    const WashStyle style = strong();
    expect_everywhere(paint(page, style), red);
    page.light = [](glm::uvec2) { return glm::vec4(0.2F); };
    expect_everywhere(paint(page, style), violet);
    alpha = shared::shade_absent;
    expect_everywhere(paint(page, style), red * style.shadow_tint * page.material.shade_color);
    for (const float lit : {0.0F, 0.25F, 1.0F}) {
        alpha = lit; // in place of the darkness of the light
        expect_everywhere(paint(page, style), glm::mix(violet, red, lit));
    }
    WashStyle grey = style;
    grey.saturation = 0.0F;
    alpha = 0.0F;
    expect_everywhere(paint(page, grey), glm::vec3(luminance(violet)));
}

TEST(Wash, LiftsDarkColoursAndKeepsTheirHue)
{
    Page page;
    WashStyle style = strong();
    style.least = 0.2F;
    page.material.mean_color = glm::vec3(0.0F);
    expect_everywhere(paint(page, style), glm::vec3(0.2F), 2e-3F);
    page.material.mean_color = {0.03F, 0.02F, 0.01F};
    const glm::vec3 brown(paint(page, style)[0]);
    EXPECT_NEAR(luminance(brown), std::hypot(0.2F, luminance(page.material.mean_color)), 2e-3F);
    EXPECT_NEAR(brown.x / brown.z, 3.0F, 0.05F);
    page.material.mean_color = {0.9F, 0.8F, 0.7F};
    EXPECT_LT(glm::distance(glm::vec3(paint(page, style)[0]), page.material.mean_color), 0.05F)
        << "pale ones stay";
}

TEST(Wash, PaintsGreysAsBrightAsTheColoursWere)
{
    Page page;
    WashStyle style = strong();
    const auto brightness = luminance(glm::vec3(paint(page, style)[0]));
    style.saturation = 0.0F;
    expect_everywhere(paint(page, style), glm::vec3(brightness), 3e-3F);
    style.saturation = 0.5F;
    expect_everywhere(paint(page, style), glm::mix(glm::vec3(brightness), red, 0.5F), 3e-3F);
}

TEST(Wash, ShadowsOnBlankGroundHaveTheirShareOfTheShadowsColor)
{
    Page page;
    page.light = [](glm::uvec2) { return glm::vec4(0.0F, 0.0F, 0.0F, 0.05F); };
    page.draw = [](glm::uvec2) { return 1U | paper_bit; };
    WashStyle style = strong();
    for (const float share : {0.0F, 0.6F, 1.0F}) {
        style.ground_shadow = share;
        expect_everywhere(paint(page, style), glm::mix(glm::vec3(1.0F), style.shadow_tint, share));
    }
}

TEST(Wash, LiesInShadowWhereOcclusionKeepsLightOff)
{
    // Half of 0.9 is darker than the shadow's edge; 0.9 is not.
    Page page;
    page.light = [](glm::uvec2) { return glm::vec4(0.9F); };
    page.color = [](glm::uvec2) { return glm::vec4(red, 0.5F); };
    const WashStyle style = strong();
    shared::ToneConstants tone = plain_tone;
    expect_everywhere(paint(page, style, tone), red);
    tone.occlusion = 1.0F;
    expect_everywhere(paint(page, style, tone), red * style.shadow_tint);
    tone.occlusion = 0.2F; // darkness 0.19
    expect_everywhere(paint(page, style, tone), red);
}

TEST(Wash, StepsIntoShadowOnceAndWandersLittle)
{
    // Light falls from 1 at the left to 0 at the right.
    Page page;
    page.light = [](glm::uvec2 pixel) {
        return glm::vec4(1.0F - static_cast<float>(pixel.x) / static_cast<float>(size_px.x - 1));
    };
    WashStyle style = strong();
    style.shadow_tint = glm::vec3(0.5F);
    const auto wash = paint(page, style);
    std::vector<int> edges;
    for (uint32_t y = 0; y < size_px.y; ++y) {
        int pure = 0;
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const float dark = static_cast<float>(x) / static_cast<float>(size_px.x - 1);
            const float share = 2.0F * (1.0F - wash[y * size_px.x + x].x / red.x);
            // The edge is at shadow_from, softened by `softness`, and wavers by 0.025.
            if (dark < style.shadow_from - style.softness - 0.026F) {
                EXPECT_NEAR(share, 0.0F, 4e-3F);
            }
            if (dark > style.shadow_from + style.softness + 0.026F) {
                EXPECT_NEAR(share, 1.0F, 4e-3F);
            }
            pure += share < 0.5F ? 1 : 0;
        }
        edges.push_back(pure);
    }
    EXPECT_NE(*std::ranges::min_element(edges), *std::ranges::max_element(edges)) << "it does wander";
}

TEST(Wash, ItsEdgeStaysWholeWhereLightFallsOffSlowly)
{
    // Darkness rises by 0.002 per pixel, so a waver of 0.025 would span half of the page.
    Page page;
    const WashStyle style = [] {
        WashStyle hard = strong();
        hard.softness = 0.001F;
        return hard;
    }();
    page.light = [&](glm::uvec2 pixel) {
        const float from_middle = static_cast<float>(pixel.x) - 0.5F * static_cast<float>(size_px.x);
        return glm::vec4(1.0F - style.shadow_from - 0.002F * from_middle);
    };
    const auto wash = paint(page, style);
    const float half = 0.5F * (red.x + red.x * style.shadow_tint.x);
    int turns = 0;
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 1; x < size_px.x; ++x) {
            const bool is_dark = wash[y * size_px.x + x].x < half;
            turns += is_dark != (wash[y * size_px.x + x - 1].x < half) ? 1 : 0;
        }
    }
    EXPECT_LE(turns, static_cast<int>(2 * size_px.y)) << "one edge a row, and few spots";
}

TEST(Wash, TakesHalfOfTheLightsHue)
{
    Page page;
    page.light = [](glm::uvec2) { return glm::vec4(1.0F, 0.8F, 0.4F, 1.0F); };
    expect_everywhere(paint(page, strong()), red * glm::vec3(1.0F, 0.9F, 0.7F));
}

TEST(Wash, IsTintedByTheLightsColourAlone)
{
    Page page;
    const glm::vec3 grey(0.3F);
    page.material.mean_color = grey;
    WashStyle style = strong();
    // Half of the light's hue (colour over luminance) always tints the wash; light_tint adds colour over the
    // brightest channel.
    const glm::vec4 red_light(2.0F, 0.5F, 0.5F, 0.8189F);
    const glm::vec3 hue = glm::mix(glm::vec3(1.0F), glm::vec3(red_light) / red_light.w, 0.5F);
    for (const float share : {0.0F, 0.5F, 1.0F}) {
        style.light_tint = share;
        page.light = [](glm::uvec2) { return glm::vec4(0.9F); };
        expect_everywhere(paint(page, style), grey);
        page.light = [](glm::uvec2) { return glm::vec4(0.0F); };
        expect_everywhere(paint(page, style), grey * style.shadow_tint);
        page.light = [&](glm::uvec2) { return red_light; };
        const glm::vec3 tint = glm::mix(glm::vec3(1.0F), glm::vec3(1.0F, 0.25F, 0.25F), share);
        expect_everywhere(paint(page, style), grey * hue * tint, 2e-3F);
    }
}

TEST(Wash, MixesInTheTextureByDetail)
{
    Page page;
    const glm::vec3 texel(0.36F, 0.64F, 0.04F); // its roots fit eight bits
    page.color = [&](glm::uvec2) { return glm::vec4(texel, 1.0F); };
    WashStyle style = strong();
    for (const float detail : {0.25F, 1.0F}) {
        style.detail = detail;
        expect_everywhere(paint(page, style), glm::mix(red, texel, detail), 3e-3F);
    }
}

TEST(Wash, PaintsGreysWeakly)
{
    Page page;
    page.material.mean_color = glm::vec3(0.3F);
    WashStyle style = strong();
    style.neutral = 0.4F;
    expect_everywhere(paint(page, style), glm::mix(glm::vec3(1.0F), glm::vec3(0.3F), 0.4F));
    page.material.mean_color = red; // saturated by more than 0.3
    expect_everywhere(paint(page, style), red);
    style.strength = 0.5F;
    expect_everywhere(paint(page, style), glm::mix(glm::vec3(1.0F), red, 0.5F));
    style.strength = 0.0F;
    expect_everywhere(paint(page, style), glm::vec3(1.0F), 0.0F);
}

TEST(Wash, GreyPaintStaysGreyUnderColouredLight)
{
    Page page;
    page.light = [](glm::uvec2) { return glm::vec4(1.0F, 0.8F, 0.4F, 1.0F); };
    WashStyle style = strong();
    style.saturation = 0.0F;
    for (const glm::vec4& wash : paint(page, style)) {
        EXPECT_NEAR(wash.x, wash.y, 1e-3F);
        EXPECT_NEAR(wash.x, wash.z, 1e-3F);
    }
}

TEST(Wash, PalesWithDistance)
{
    Page page;
    page.depth = [](glm::uvec2 pixel) { return 0.01F / (1.0F + 3.0F * static_cast<float>(pixel.x)); };
    WashStyle style = strong();
    style.air = 0.8F;
    style.air_color = {0.7F, 0.8F, 0.9F};
    style.air_distance_m = 30.0F;
    const auto wash = paint(page, style);
    const auto globals = features::frame_globals(camera, {}, glm::dvec3(0.0), {.size_px = size_px});
    for (uint32_t i = 0; i < wash.size(); ++i) {
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        const glm::vec2 ndc = 2.0F * (glm::vec2(pixel) + 0.5F) / glm::vec2(size_px) - 1.0F;
        // Reversed depth is near / distance along the view direction of this camera.
        const float ahead = 0.01F / page.depth(pixel);
        const auto half = static_cast<float>(std::tan(0.5 * camera.vertical_fov_rad));
        const float away = ahead * glm::length(glm::vec3(ndc.x * half * 1.5F, ndc.y * half, 1.0F));
        EXPECT_NEAR(globals.near_m / page.depth(pixel), ahead, 1e-3F);
        expect_near(glm::vec3(wash[i]),
                    glm::mix(red, style.air_color, 0.8F * (1.0F - std::exp2(-away / 30.0F))), 2e-3F);
    }
    EXPECT_GT(wash[size_px.x - 1].z, wash[0].z);
}

TEST(Wash, LeavesPaperBareButForItsShadow)
{
    Page page;
    page.draw = [](glm::uvec2) { return 1U | paper_bit; };
    WashStyle style = strong();
    style.air = 1.0F;
    expect_everywhere(paint(page, style), glm::vec3(1.0F), 0.0F);
    page.light = [](glm::uvec2) { return glm::vec4(0.1F); };
    expect_everywhere(paint(page, style), glm::mix(glm::vec3(1.0F), style.shadow_tint, 0.6F));
}

TEST(Wash, LetsTheSkyThroughWhereNothingIs)
{
    Page page;
    page.draw = [](glm::uvec2 pixel) { return pixel.x < 20 ? 0U : 1U; };
    page.background_size_px = size_px;
    page.background = [](glm::uvec2 pixel) {
        return glm::vec4(0.5F, 0.25F, static_cast<float>(pixel.y) / 32.0F, 1.0F);
    };
    const auto wash = paint(page, strong());
    for (uint32_t i = 0; i < wash.size(); ++i) {
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        const bool is_sky = pixel.x < 20;
        expect_near(glm::vec3(wash[i]), is_sky ? glm::vec3(page.background(pixel)) : red);
        EXPECT_EQ(wash[i].w, is_sky ? 0.0F : 1.0F);
    }
    page.background_size_px = {1, 1};
    expect_near(glm::vec3(paint(page, strong())[5]), {0.5F, 0.25F, 0.0F});
    page.has_background = false;
    expect_near(glm::vec3(paint(page, strong())[5]), glm::vec3(1.0F));
}

TEST(Wash, LaysAScreenOverItByItsCover)
{
    Page page;
    page.has_screen = true;
    page.draw = [](glm::uvec2 pixel) { return pixel.y < 16 ? 0U : 1U; };
    const glm::vec3 tint(0.04F, 0.36F, 0.64F);
    page.screen = [&](glm::uvec2 pixel) { return glm::vec4(tint, static_cast<float>(pixel.x) / 51.0F); };
    WashStyle style = strong();
    style.strength = 0.75F;
    const auto wash = paint(page, style);
    for (uint32_t i = 0; i < wash.size(); ++i) {
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        const glm::vec3 below = pixel.y < 16 ? glm::vec3(1.0F) : glm::mix(glm::vec3(1.0F), red, 0.75F);
        const glm::vec3 above = glm::mix(glm::vec3(1.0F), tint, 0.75F);
        expect_near(glm::vec3(wash[i]), glm::mix(below, above, page.screen(pixel).w), 4e-3F);
    }
}

TEST(Wash, StaysWithinPaperAndFullPaint)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (int round = 0; round < 20; ++round) {
        Page page;
        page.has_screen = share(random) < 0.5F;
        page.color = page.background = page.screen = [&](glm::uvec2) {
            return glm::vec4(share(random), share(random), share(random), share(random));
        };
        page.light = [&](glm::uvec2) {
            return 8.0F * glm::vec4(share(random), share(random), share(random), share(random));
        };
        page.draw = [&](glm::uvec2) { return share(random) < 0.3F ? 0U : 1U; };
        page.material.mean_color = {share(random), share(random), share(random)};
        WashStyle style;
        style.strength = share(random);
        style.neutral = share(random);
        style.detail = share(random);
        style.air = share(random);
        for (const glm::vec4& color : paint(page, style)) {
            for (int i = 0; i < 4; ++i) {
                EXPECT_GE(color[i], 0.0F);
                EXPECT_LE(color[i], 1.0F);
            }
        }
    }
}

} // namespace
} // namespace estampe::wash
