// SPDX-License-Identifier: MIT
// A sheet of sand seen from above in a low sun: a sea of dunes, lone ones, and trails; the documentation
// shows it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "golden/golden.hpp"
#include "support/gpu_device.hpp"
#include "techniques/terrain/slabs/slabs.hpp"
#include "techniques/terrain/trails/trails.hpp"

namespace estampe {
namespace {

constexpr int tile_px = 256;

/// Heights in metres on a square of texels that repeats.
struct Ground {
    int side = 0;
    float texel_m = 1.0F;
    std::vector<float> heights_m;

    [[nodiscard]] float at(int x, int y) const
    {
        return heights_m[static_cast<size_t>((y & (side - 1)) * side + (x & (side - 1)))];
    }

    /// Linear between texels.
    [[nodiscard]] float at(glm::vec2 place_m) const
    {
        const glm::vec2 texels = place_m / texel_m;
        const glm::ivec2 near(glm::floor(texels));
        const glm::vec2 share = texels - glm::vec2(near);
        return glm::mix(glm::mix(at(near.x, near.y), at(near.x + 1, near.y), share.x),
                        glm::mix(at(near.x, near.y + 1), at(near.x + 1, near.y + 1), share.x), share.y);
    }
};

uint8_t shaded(const Ground& ground, glm::vec2 place_m, glm::vec3 sun)
{
    const float step_m = 0.7F * ground.texel_m;
    const auto slope = [&](glm::vec2 aside) {
        return (ground.at(place_m + aside) - ground.at(place_m - aside)) / (2.0F * step_m);
    };
    const glm::vec3 normal = glm::normalize(glm::vec3(-slope({step_m, 0.0F}), 1.0F, -slope({0.0F, step_m})));
    float light = std::max(glm::dot(normal, sun), 0.0F);
    const glm::vec2 sunwards = glm::vec2(sun.x, sun.z) / std::hypot(sun.x, sun.z);
    const float rise = sun.y / std::hypot(sun.x, sun.z);
    for (int i = 1; i < 100; ++i) {
        const float away_m = static_cast<float>(i) * step_m;
        const float over_m = ground.at(place_m + away_m * sunwards) - ground.at(place_m) - away_m * rise;
        light = over_m > 0.02F * ground.texel_m ? 0.0F : light;
    }
    return static_cast<uint8_t>(255.0F * std::pow(std::min(0.06F + 1.1F * light, 1.0F), 1.0F / 2.2F));
}

void add_tile(Image& sheet, int tile, const Ground& ground)
{
    const glm::vec3 sun = glm::normalize(glm::vec3(-0.9F, 0.4F, -0.45F));
    const float pixel_m = static_cast<float>(ground.side) * ground.texel_m / tile_px;
    for (int i = 0; i < tile_px * tile_px; ++i) {
        const glm::ivec2 px(i % tile_px, i / tile_px);
        const auto pixel = sheet.rgba.begin() + 4 * (px.y * 3 * tile_px + tile * tile_px + px.x);
        std::fill_n(pixel, 3, shaded(ground, pixel_m * glm::vec2(px), sun));
    }
}

constexpr uint32_t field_side = 256;

Ground settled_dunes(const std::function<double(glm::dvec2)>& start, uint32_t steps)
{
    constexpr terrain::SlabStyle style{.slides = 4};
    std::vector<float> heights_m;
    for (uint32_t i = 0; i < field_side * field_side; ++i) {
        heights_m.push_back(static_cast<float>(start({i % field_side, i / field_side})));
    }
    terrain::SlabField field(test::shared_device(), style, field_side, heights_m);
    constexpr uint32_t at_once = 25;
    for (uint32_t i = 0; i < steps; i += at_once) {
        gpu::Graph graph;
        heights_m = test::run_and_read_as<float>(graph, field.add_steps(graph, style, at_once));
    }
    return {.side = field_side, .texel_m = style.cell_m, .heights_m = heights_m};
}

/// Waves across the wind, which bend and fork.
double forked_waves(glm::dvec2 p)
{
    const glm::dvec2 turn = 2.0 * std::numbers::pi / field_side * p;
    const double bend = 1.3 * std::sin(turn.y + 0.6) + 0.8 * std::sin(3.0 * turn.y + turn.x);
    return 4.0 + 2.2 * std::sin(5.0 * turn.x + bend) + 1.6 * std::sin(6.0 * turn.x - 2.0 * turn.y + bend);
}

/// Heaps on bare rock.
double heaps(glm::dvec2 p)
{
    double height = 0.0;
    for (int i = 0; i < 16; ++i) {
        const auto place = [&](double step) { return std::fmod(step * (i + 1), 1.0) * field_side; };
        const glm::dvec2 away = glm::abs(p - glm::dvec2(place(0.7549), place(0.5698)));
        const double distance = glm::length(glm::min(away, static_cast<double>(field_side) - away));
        height += std::max(4.0 + i % 5 - distance / 2.5, 0.0);
    }
    return height;
}

/// A barefoot walk in a bend, something dragged, a ball that fell; and a walk across them a minute and a half
/// ago.
Ground trails()
{
    constexpr uint32_t side = 256;
    constexpr double extent_m = 6.0;
    terrain::TrailField field(test::shared_device(), side, extent_m);
    const auto step_on = [&](glm::dvec2 from, double heading, double bend, int steps) {
        for (int i = 0; i < steps; ++i) {
            const glm::dvec2 ahead(std::cos(heading), std::sin(heading));
            const glm::dvec2 aside = (i % 2 == 0 ? 0.1 : -0.1) * glm::dvec2(-ahead.y, ahead.x);
            const TrailStamp foot = TrailStamp::foot(from + aside, ahead);
            field.press({&foot, 1});
            from += 0.62 * ahead;
            heading += bend;
        }
    };
    const auto passed = [&](uint32_t ticks) {
        gpu::Graph graph;
        const terrain::TrailImage image = field.add_step(graph, {}, ticks, {0.0, 0.0});
        return test::run_and_read_as<float>(graph, image.height);
    };
    step_on({-2.6, 1.6}, -0.5, 0.0, 9);
    static_cast<void>(passed(120 * 90));
    step_on({-2.4, -2.3}, 0.2, 0.14, 9);
    for (int i = 0; i < 40; ++i) {
        const auto place = [](double t) {
            return glm::dvec2(-2.3 + 4.6 * t, 2.2 + 0.25 * std::sin(7.0 * t));
        };
        const auto drag = TrailStamp::drag(place(i / 40.0), place((i + 1) / 40.0), 0.12F, 0.06F);
        field.press({&drag, 1});
        static_cast<void>(passed(4));
    }
    const auto ball = TrailStamp::disc({0.4, 0.9}, 0.35F, 0.15F);
    field.press({&ball, 1});
    static_cast<void>(passed(40));
    return {.side = side, .texel_m = static_cast<float>(extent_m / side), .heights_m = passed(40)};
}

TEST(SandGolden, DunesAndTrailsInALowSun)
{
    Image sheet{.width = 3 * tile_px, .height = tile_px};
    sheet.rgba.assign(4ULL * sheet.width * sheet.height, 255);
    add_tile(sheet, 0, settled_dunes(forked_waves, 300));
    add_tile(sheet, 1, settled_dunes(heaps, 300));
    add_tile(sheet, 2, trails());
    test::expect_matches_golden(sheet, "sand");
}

} // namespace
} // namespace estampe
