// SPDX-License-Identifier: MIT
// Light that spreads under flat surfaces, against the integral of Burley's profile.
#include "techniques/subsurface/subsurface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/subsurface/subsurface_test_support.hpp"

namespace estampe::subsurface {
namespace {

constexpr glm::uvec2 sheet_px(160, 96);
constexpr double near_m = 0.1;
constexpr double away_m = 5.0;
const Camera sheet_camera{
    .eye = {0.0, 0.0, away_m}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.5, .near_m = near_m};

/// Size of a pixel on a sheet that faces the camera.
double pixel_m()
{
    return 2.0 * away_m * std::tan(0.25) / sheet_px.y;
}

struct Painted {
    test::Painter<glm::vec4> light;
    test::Painter<float> depth = [](glm::uvec2) { return static_cast<float>(near_m / away_m); };
    test::Painter<uint32_t> draw = [](glm::uvec2) { return 1U; };
};

SubsurfaceStyle spreading(double scatter_px, const glm::vec3& color = glm::vec3(1.0F))
{
    return {.enabled = true,
            .scatter_m = static_cast<float>(scatter_px * pixel_m()),
            .scatter_color = color,
            .depth_m = 0.0F,
            .reach_mm = 200.0F};
}

/// Light after spreading, of a part of the page or of the whole page.
std::vector<glm::vec4> spread(const Painted& page, const SubsurfaceStyle& style, glm::uvec2 from_px = {0, 0},
                              glm::uvec2 part_px = sheet_px, bool on_processor = false)
{
    const auto shifted = [&](const auto& painter) {
        return [&painter, from_px](glm::uvec2 pixel) { return painter(pixel + from_px); };
    };
    auto light = test::Layer::color(part_px, shifted(page.light));
    auto depth = test::Layer::depth(part_px, shifted(page.depth));
    auto draw = test::Layer::words(part_px, shifted(page.draw));
    auto globals = features::frame_globals(sheet_camera, {}, {}, {.size_px = sheet_px});
    globals.size_px = part_px;
    globals.tile_from_px = from_px;
    auto frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    auto parameters =
        gpu::upload_buffer(test::shared_device(), "subsurface parameters", std::vector{parameters_of(style)});
    gpu::Graph graph;
    // The graph must not change the imported image, so the light is copied first.
    const gpu::ImageId given = light.in(graph);
    const gpu::ImageId result =
        add_scatter(graph,
                    {.frame = gpu::import_whole(graph, "frame", frame),
                     .draw = draw.in(graph),
                     .depth = depth.in(graph),
                     .normal = depth.in(graph),
                     .parameters = gpu::import_whole(graph, "subsurface parameters", parameters),
                     .variant_of_draw = std::nullopt,
                     .reach_mm = style.reach_mm,
                     .pixels_per_mm = 4.0F,
                     .size_px = part_px,
                     .from_px = from_px,
                     .execution = {.is_processor = on_processor}},
                    given);
    return test::run_and_read_colors(graph, result);
}

TEST(Scatter, IntegratesTheProfileOnce)
{
    EXPECT_NEAR(beside_line(60.0), 0.5, 1e-4);
}

/// Largest difference between a blurred step and the profile's integral, per colour.
glm::dvec3 worst_of_step(double scatter_px, const glm::vec3& color)
{
    const std::vector<glm::vec4> result =
        spread({.light = [](glm::uvec2 pixel) { return glm::vec4(pixel.x < 80 ? 1.0F : 0.0F); }},
               spreading(scatter_px, color));
    glm::dvec3 worst(0.0);
    for (uint32_t x = 0; x < sheet_px.x; ++x) {
        for (int channel = 0; channel < 3; ++channel) {
            const double off_px = x + 0.5 - 80.0;
            const double beside =
                beside_line(std::abs(off_px) / (scatter_px * static_cast<double>(color[channel])));
            const double wanted = off_px < 0.0 ? 0.5 + beside : 0.5 - beside;
            const double got = static_cast<double>(result[size_t{48} * sheet_px.x + x][channel]);
            worst[channel] = std::max(worst[channel], std::abs(got - wanted));
        }
    }
    return worst;
}

TEST(Scatter, BlursAStepAsTheProfileDoes)
{
    for (const double scatter_px : {4.0, 7.0, 9.0}) {
        const double worst = worst_of_step(scatter_px, glm::vec3(1.0F)).x;
        RecordProperty(fmt::format("worst_at_{}_px", scatter_px), fmt::format("{:.4f}", worst));
        EXPECT_LT(worst, 0.01) << scatter_px;
    }
}

TEST(Scatter, SpreadsColorsByTheirShare)
{
    // Blue spreads by little more than two pixels, about the limit of the half page.
    const glm::dvec3 worst = worst_of_step(9.0, {1.0F, 0.5F, 0.25F});
    RecordProperty("worst", fmt::format("{:.4f}, {:.4f}, {:.4f}", worst.x, worst.y, worst.z));
    EXPECT_LT(worst.x, 0.01);
    EXPECT_LT(worst.y, 0.01);
    EXPECT_LT(worst.z, 0.01);
}

TEST(Scatter, KeepsTheEnergyOfAPoint)
{
    for (const glm::uvec2 point : {glm::uvec2(80, 48), glm::uvec2(81, 48), glm::uvec2(81, 49)}) {
        const std::vector<glm::vec4> result =
            spread({.light = [&](glm::uvec2 pixel) { return glm::vec4(pixel == point ? 1000.0F : 0.0F); }},
                   spreading(2.2));
        glm::dvec4 sum(0.0);
        for (const glm::vec4& pixel : result) {
            sum += glm::dvec4(pixel);
        }
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(sum[channel] / 1000.0, 1.0, 1e-3);
        }
    }
}

TEST(Scatter, LeavesEvenLightAsItIs)
{
    const std::vector<glm::vec4> result =
        spread({.light = [](glm::uvec2) { return glm::vec4(0.5F, 0.25F, 2.0F, 0.0F); }}, spreading(6.0));
    for (const glm::vec4& pixel : result) {
        EXPECT_NEAR(pixel.x, 0.5F, 5e-4F);
        EXPECT_NEAR(pixel.y, 0.25F, 2.5e-4F);
        EXPECT_NEAR(pixel.z, 2.0F, 2e-3F);
    }
}

TEST(Scatter, LeavesWhatSpreadsWithinPixelsToTheBit)
{
    const auto stripes = [](glm::uvec2 pixel) { return glm::vec4(pixel.x % 3 == 0 ? 1.0F : 0.25F); };
    const std::vector<glm::vec4> result = spread({.light = stripes}, spreading(0.04));
    for (uint32_t x = 0; x < sheet_px.x; ++x) {
        EXPECT_EQ(result[size_t{48} * sheet_px.x + x].x, stripes({x, 48}).x) << x;
    }
}

TEST(Scatter, DoesNotCrossAGap)
{
    // A lit sheet in front of a dark one; next to both, lit surfaces that scatter no light.
    Painted page{.light = [](glm::uvec2 pixel) {
        return glm::vec4(pixel.x < 60 ? 1.0F : pixel.x < 120 ? 0.0F : 5.0F);
    }};
    page.depth = [](glm::uvec2 pixel) {
        return static_cast<float>(near_m / (pixel.x < 60 ? away_m : away_m + 40.0));
    };
    page.draw = [](glm::uvec2 pixel) { return pixel.x < 120 ? 1U : 0U; };
    const std::vector<glm::vec4> result = spread(page, spreading(5.0));
    for (uint32_t y = 0; y < sheet_px.y; ++y) {
        for (uint32_t x = 0; x < sheet_px.x; ++x) {
            const float wanted = x < 60 ? 1.0F : x < 120 ? 0.0F : 5.0F;
            EXPECT_NEAR(result[size_t{y} * sheet_px.x + x].x, wanted, 2e-3F) << x;
        }
    }
}

TEST(Scatter, IsOnAProcessorWhatItIsOnAGpu)
{
    // Depths differ, and parts of the page scatter no light, so that each tap has its own weight. The widest
    // spreading uses all levels.
    Painted page{.light = [](glm::uvec2 pixel) {
        return glm::vec4(static_cast<float>(pixel.x * 7 % 11), static_cast<float>(pixel.y % 3),
                         static_cast<float>((pixel.x + pixel.y) % 5), 0.0F);
    }};
    page.depth = [](glm::uvec2 pixel) {
        return static_cast<float>(near_m / (away_m + 0.01 * (pixel.x % 9) + 0.03 * (pixel.y % 5)));
    };
    page.draw = [](glm::uvec2 pixel) { return pixel.x % 23 < 20 ? 1U : 0U; };
    for (const glm::uvec2 part_px : {sheet_px, glm::uvec2(113, 71)}) {
        for (const double scatter_px : {2.0, 36.0}) {
            const SubsurfaceStyle style = spreading(scatter_px);
            const auto by_threads = spread(page, style, {0, 0}, part_px, true);
            const auto by_tiles = spread(page, style, {0, 0}, part_px, false);
            EXPECT_EQ(by_tiles, by_threads) << part_px.x << ", " << scatter_px;
            EXPECT_NE(by_tiles[size_t{40} * part_px.x + 40], page.light({40, 40})) << "it spreads";
        }
    }
}

TEST(Scatter, IsInTilesWhatItIsOnTheWholePage)
{
    const Painted page{.light = [](glm::uvec2 pixel) {
        return glm::vec4(static_cast<float>((pixel.x / 7 + pixel.y / 5) % 3));
    }};
    SubsurfaceStyle style = spreading(3.0);
    style.reach_mm = 7.0F;
    const std::vector<glm::vec4> whole = spread(page, style);
    const uint32_t reach = reach_px(style, 4.0F);
    const glm::uvec2 part_px(90, 80);
    for (const glm::uvec2 from_px : {glm::uvec2(31, 7), glm::uvec2(40, 16), glm::uvec2(70, 11)}) {
        const std::vector<glm::vec4> part = spread(page, style, from_px, part_px);
        int count = 0;
        for (uint32_t y = reach; y < part_px.y - reach; ++y) {
            for (uint32_t x = reach; x < part_px.x - reach; ++x) {
                const glm::vec4 wanted = whole[size_t{y + from_px.y} * sheet_px.x + x + from_px.x];
                EXPECT_EQ(part[size_t{y} * part_px.x + x], wanted) << x << ", " << y;
                ++count;
            }
        }
        EXPECT_GT(count, 100);
    }
}

} // namespace
} // namespace estampe::subsurface
