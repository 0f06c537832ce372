// SPDX-License-Identifier: MIT
// A lens applied to layers that the tests paint themselves.
#include "techniques/lens/lens.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::lens {
namespace {

constexpr glm::uvec2 size_px(96, 72);
constexpr double near_m = 0.1;
constexpr double focus_m = 2.0;
constexpr float infinite_px = 8.0F; ///< radius of the blur circle at infinite distance

/// Reversed depth, near_m / distance.
float depth_at(double away_m)
{
    return static_cast<float>(near_m / away_m);
}

/// Depth at which the blur circle has this radius; negative in front of the plane in focus.
float depth_of(float radius_px)
{
    return static_cast<float>(near_m / focus_m) * (1.0F - radius_px / infinite_px);
}

shared::LensConstants lens_of(const LensStyle& style)
{
    LensPage page{.focus_m = focus_m, .near_m = near_m, .pixels_per_mm = 4.0F, .line_half_px = 0.0F};
    const double aperture_m =
        1e-3 * static_cast<double>(style.focal_mm) / static_cast<double>(style.f_number);
    page.pixel_at_one_m = 0.5 * aperture_m / (focus_m * static_cast<double>(infinite_px));
    return lens_on(style, page).value();
}

/// Arbitrary but reproducible numbers.
float noise(glm::uvec2 pixel, uint32_t seed)
{
    uint32_t bits = (pixel.x + 977U * pixel.y + 65537U * seed) * 747796405U + 2891336453U;
    bits = ((bits >> ((bits >> 28U) + 4U)) ^ bits) * 277803737U;
    return static_cast<float>((bits >> 22U ^ bits) & 0xffffU) / 65535.0F;
}

struct Painted {
    test::Painter<float> depth = [](glm::uvec2) { return depth_at(focus_m); };
    test::Painter<glm::vec4> wash = [](glm::uvec2) { return glm::vec4(0.0F, 0.0F, 0.0F, 1.0F); };
    test::Painter<float> hatch = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> lines = [](glm::uvec2) { return glm::vec4(0.0F); };
};

struct Seen {
    std::vector<glm::vec4> wash;
    std::vector<float> hatch;
    std::vector<uint32_t> lines;

    [[nodiscard]] glm::vec4 paint(uint32_t x, uint32_t y) const { return wash[size_t{y} * size_px.x + x]; }
};

enum class Through : uint8_t { lens, nothing };

Seen look(const Painted& page, const LensStyle& style, Through through = Through::lens,
          glm::uvec2 from_px = {})
{
    auto depth = test::Layer::depth(size_px, page.depth);
    auto sky = test::Layer::coverage(size_px, [](glm::uvec2) { return 0.0F; });
    Seen seen;
    for (int wanted = 0; wanted < 3; ++wanted) {
        auto wash = test::Layer::color(size_px, page.wash);
        auto hatch = test::Layer::coverage(size_px, page.hatch);
        auto lines = test::Layer::root_color(size_px, page.lines);
        gpu::Graph graph;
        LensLayers layers{.wash = wash.in(graph), .hatch = hatch.in(graph), .lines = lines.in(graph)};
        if (through == Through::lens) {
            layers = add_lens(graph,
                              {.depth = depth.in(graph),
                               .wash = layers.wash,
                               .hatch = layers.hatch,
                               .lines = layers.lines,
                               .sky_ink = sky.in(graph),
                               .from_px = from_px,
                               .size_px = size_px},
                              style, lens_of(style));
        }
        if (wanted == 0) {
            seen.wash = test::run_and_read_colors(graph, layers.wash);
        } else if (wanted == 1) {
            seen.hatch = test::run_and_read_coverage(graph, layers.hatch);
        } else {
            seen.lines = test::run_and_read_as<uint32_t>(graph, layers.lines);
        }
    }
    return seen;
}

Painted noisy()
{
    Painted page;
    page.wash = [](glm::uvec2 p) { return glm::vec4(noise(p, 1), noise(p, 2), noise(p, 3), 1.0F); };
    page.hatch = [](glm::uvec2 p) { return noise(p, 4); };
    page.lines = [](glm::uvec2 p) { return glm::vec4(noise(p, 5), noise(p, 6), noise(p, 7), noise(p, 8)); };
    return page;
}

constexpr Mode blurring[] = {Mode::gather, Mode::separable, Mode::mips, Mode::sums};

TEST(LensGpu, KeepsWhatIsInFocusToTheBit)
{
    Painted page = noisy();
    // Surfaces in focus, and those whose blur circle is smaller than a pixel.
    page.depth = [](glm::uvec2 p) { return depth_of(0.49F * (2.0F * noise(p, 9) - 1.0F)); };
    const Seen drawn = look(page, {}, Through::nothing);
    for (const Mode mode : blurring) {
        const Seen seen = look(page, {.enabled = true, .mode = mode});
        EXPECT_EQ(seen.wash, drawn.wash) << static_cast<int>(mode);
        EXPECT_EQ(seen.hatch, drawn.hatch) << static_cast<int>(mode);
        EXPECT_EQ(seen.lines, drawn.lines) << static_cast<int>(mode);
    }
}

TEST(LensGpu, BlursWhatIsNotInFocus)
{
    Painted page = noisy();
    page.depth = [](glm::uvec2) { return depth_of(6.0F); };
    const Seen drawn = look(page, {}, Through::nothing);
    const auto spread = [](const std::vector<float>& values) {
        const auto [least, most] = std::ranges::minmax(values);
        return most - least;
    };
    for (const Mode mode : blurring) {
        const Seen seen = look(page, {.enabled = true, .mode = mode});
        EXPECT_LT(spread(seen.hatch), 0.5F * spread(drawn.hatch)) << static_cast<int>(mode);
    }
    const Seen wash_alone = look(page, {.enabled = true, .mode = Mode::gather, .acts_on = ActsOn::wash});
    EXPECT_EQ(wash_alone.hatch, drawn.hatch);
    EXPECT_EQ(wash_alone.lines, drawn.lines);
    EXPECT_NE(wash_alone.wash, drawn.wash);
}

struct Blot {
    double energy = 0.0;
    double spread_px = 0.0; ///< root mean square distance from the point
    double edge_px = 0.0;   ///< distance of the farthest pixel with a tenth of the maximum
    glm::dvec2 middle{0.0};
};

/// The blur of a single point of light at a place, with the given radius.
Blot blot_of(const LensStyle& style, glm::uvec2 place, float radius_px, float ground_px)
{
    Painted page;
    page.depth = [&](glm::uvec2 p) { return depth_of(p == place ? radius_px : ground_px); };
    page.wash = [&](glm::uvec2 p) { return glm::vec4(glm::vec3(p == place ? 64.0F : 0.0F), 1.0F); };
    const Seen seen = look(page, style);
    Blot blot;
    double most = 0.0;
    for (const glm::vec4& pixel : seen.wash) {
        most = std::max(most, static_cast<double>(pixel.x));
    }
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const double light = static_cast<double>(seen.paint(x, y).x) / 64.0;
            const glm::dvec2 away = glm::dvec2(x, y) - glm::dvec2(place);
            blot.energy += light;
            blot.middle += light * away;
            blot.spread_px += light * glm::dot(away, away);
            blot.edge_px = 640.0 * light > most ? std::max(blot.edge_px, glm::length(away)) : blot.edge_px;
        }
    }
    blot.middle /= blot.energy;
    blot.spread_px = std::sqrt(blot.spread_px / blot.energy);
    return blot;
}

TEST(LensGpu, KeepsTheEnergyOfAPoint)
{
    const LensStyle style{.enabled = true, .mode = Mode::gather};
    double worst = 0.0;
    for (const float radius_px : {-9.0F, -6.5F, -4.0F, 3.0F, 5.0F, 7.5F}) {
        double energy = 0.0;
        for (const glm::uvec2 place : {glm::uvec2(48, 36), glm::uvec2(49, 37), glm::uvec2(51, 34)}) {
            const Blot blot = blot_of(style, place, radius_px, radius_px);
            // The point's position is only known to a texel of the level on which it is gathered.
            const double texel_px = std::exp2(std::ceil(std::log2(std::abs(radius_px) / 3.0)));
            EXPECT_LT(glm::length(blot.middle), std::max(texel_px - 1.0, 1.0) * std::sqrt(0.5) + 0.05)
                << radius_px;
            // The root mean square distance of a disc's points from its centre.
            EXPECT_NEAR(blot.spread_px, std::abs(radius_px) / std::sqrt(2.0), 0.6) << radius_px;
            EXPECT_NEAR(blot.edge_px, std::abs(radius_px), std::max(texel_px, 2.0)) << radius_px;
            energy += blot.energy / 3.0;
        }
        worst = std::max(worst, std::abs(energy - 1.0));
        EXPECT_NEAR(energy, 1.0, 0.02) << radius_px;
    }
    std::printf("energy of a point off by %.4f at most\n", worst);
}

TEST(LensGpu, DrawsThePolygonOfTheBlades)
{
    // Three blades: light reaches farther towards a corner than towards a side, and its sum is equal.
    const LensStyle round{.enabled = true, .mode = Mode::gather};
    const LensStyle bladed{.enabled = true, .mode = Mode::gather, .blades = 3};
    const glm::uvec2 place(48, 36);
    const Blot disc = blot_of(round, place, 7.5F, 7.5F);
    const Blot triangle = blot_of(bladed, place, 7.5F, 7.5F);
    EXPECT_NEAR(triangle.energy, disc.energy, 0.03);
    EXPECT_GT(triangle.edge_px, disc.edge_px + 1.0);
}

/// A page that is red on the left and blue on the right.
Painted halves(float left_px, float right_px)
{
    Painted page;
    page.depth = [=](glm::uvec2 p) { return depth_of(p.x < 48 ? left_px : right_px); };
    page.wash = [](glm::uvec2 p) {
        return p.x < 48 ? glm::vec4(0.9F, 0.1F, 0.1F, 1.0F) : glm::vec4(0.1F, 0.1F, 0.9F, 1.0F);
    };
    return page;
}

TEST(LensGpu, KeepsTheSharpOutOfTheBlurredBehindIt)
{
    const Seen seen = look(halves(0.0F, 6.0F), {.enabled = true, .mode = Mode::gather});
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < size_px.x; ++x) {
            EXPECT_NEAR(seen.paint(x, y).x, x < 48 ? 0.9F : 0.1F, 0.01F) << x << ", " << y;
        }
    }
}

TEST(LensGpu, KeepsTheBlurredBehindOffTheSharp)
{
    const Painted page = halves(0.0F, 6.0F);
    const Seen drawn = look(page, {}, Through::nothing);
    const Seen seen = look(page, {.enabled = true, .mode = Mode::gather});
    for (uint32_t y = 0; y < size_px.y; ++y) {
        for (uint32_t x = 0; x < 48; ++x) {
            EXPECT_EQ(seen.paint(x, y), drawn.paint(x, y)) << x << ", " << y;
        }
    }
}

TEST(LensGpu, SpreadsWhatIsNearOverWhatIsSharp)
{
    constexpr float radius = 6.0F;
    const Seen seen = look(halves(-radius, 0.0F), {.enabled = true, .mode = Mode::gather});
    for (uint32_t x = 48; x < 64; ++x) {
        // The share of a disc around the pixel that lies left of the edge.
        const double off = std::min((static_cast<double>(x) + 0.5 - 48.0) / static_cast<double>(radius), 1.0);
        const double share = (std::acos(off) - off * std::sqrt(1.0 - off * off)) / 3.14159265;
        EXPECT_NEAR(seen.paint(x, 36).x, 0.1 + 0.8 * share, 0.05) << x;
    }
    const Seen drawn = look(halves(-radius, 0.0F), {}, Through::nothing);
    for (uint32_t x = 58; x < size_px.x; ++x) {
        EXPECT_EQ(seen.paint(x, 36), drawn.paint(x, 36)) << "beyond its reach at " << x;
    }
}

TEST(LensGpu, FindsTheSameOnATileOfThePage)
{
    // Blocks are counted from the page's corner, so a window with another origin has equal blocks.
    const auto shifted = [](glm::uvec2 by) {
        Painted page = noisy();
        page.depth = [=](glm::uvec2 p) { return depth_of(8.0F * noise((p + by) / 12U, 3) - 3.0F); };
        page.wash = [=](glm::uvec2 p) { return glm::vec4(glm::vec3(noise(p + by, 1)), 1.0F); };
        page.hatch = [=](glm::uvec2 p) { return noise(p + by, 4); };
        page.lines = [](glm::uvec2) { return glm::vec4(0.0F); };
        return page;
    };
    const LensStyle style{.enabled = true, .mode = Mode::gather, .largest_mm = 4.0F}; // radii up to 8 pixels
    const glm::uvec2 by(13, 7);
    const Seen whole = look(shifted({0, 0}), style, Through::lens, {0, 0});
    const Seen tile = look(shifted(by), style, Through::lens, by);
    constexpr uint32_t reach = 24;
    for (uint32_t y = reach; y < size_px.y - reach; ++y) {
        for (uint32_t x = reach; x < size_px.x - reach - by.x; ++x) {
            ASSERT_EQ(tile.paint(x, y), whole.paint(x + by.x, y + by.y)) << x << ", " << y;
        }
    }
}

} // namespace
} // namespace estampe::lens
