// SPDX-License-Identifier: MIT
// Compares shadows of height fields with formulas, and with a long march in double precision.
#include "techniques/shadow/heightfield/height_shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <span>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::shadow {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double sun_radius = 0.004651;

/// Height in metres as a function of the place in metres.
using Ground = std::function<double(glm::dvec2)>;

struct Sky {
    double azimuth_rad = 0.0; ///< azimuth of the sun, from the field's x towards its y
    double elevation_rad = 0.5;
    double radius_rad = sun_radius;

    [[nodiscard]] glm::dvec2 sunwards() const { return {std::cos(azimuth_rad), std::sin(azimuth_rad)}; }

    [[nodiscard]] glm::dvec3 towards_sun() const
    {
        const glm::dvec2 level = std::cos(elevation_rad) * sunwards();
        return {level.x, std::sin(elevation_rad), level.y};
    }
};

/// A field of `size` texels centred at the origin.
struct Field {
    glm::uvec2 size{64};
    double texel_m = 1.0;
    Ground ground;

    [[nodiscard]] glm::dvec2 place(glm::uvec2 texel) const
    {
        return texel_m * (glm::dvec2(texel) - 0.5 * glm::dvec2(size - 1U));
    }

    [[nodiscard]] test::Layer layer() const
    {
        return test::Layer::depth(size,
                                  [&](glm::uvec2 texel) { return static_cast<float>(ground(place(texel))); });
    }
};

std::vector<float> shadow_of(const Field& field, const Sky& sky, const HeightShadowStyle& style = {},
                             bool horizon = false, const shared::FieldSector& wanted = {})
{
    test::Layer height = field.layer();
    gpu::Graph graph;
    const HeightShadowInputs in{.height = height.in(graph),
                                .texel_m = {static_cast<float>(field.texel_m)},
                                .towards_sun = sky.towards_sun(),
                                .sun_radius_rad = sky.radius_rad,
                                .wanted = wanted};
    return test::run_and_read_coverage(graph, horizon ? add_height_horizon(graph, in, style)
                                                      : add_height_shadow(graph, in, style));
}

double share_of_disc(double x)
{
    x = std::clamp(x, -1.0, 1.0);
    return (std::acos(x) - x * std::sqrt(1.0 - x * x)) / pi;
}

/// Visible share of the sun at a place, from `looks` samples of the ground up to `reach_m`. No ground is
/// higher than `highest_m`, so samples that cannot change the result are skipped.
double marched(const Ground& ground, glm::dvec2 place, const Sky& sky, double reach_m, int looks,
               double highest_m)
{
    double slope = 0.0;
    const double from = ground(place);
    const double enough = std::tan(sky.elevation_rad + sky.radius_rad);
    const double least = std::tan(sky.elevation_rad - sky.radius_rad);
    for (int i = 1; i <= looks && slope < enough; ++i) {
        const double distance = reach_m * i / looks;
        slope = std::max(slope, (ground(place + distance * sky.sunwards()) - from) / distance);
        if (highest_m - from < std::max(slope, least) * distance) {
            break;
        }
    }
    return share_of_disc((std::atan(slope) - sky.elevation_rad) / sky.radius_rad);
}

constexpr HeightShadowStyle by_sweep{.method = HeightMethod::sweep};
constexpr HeightShadowStyle by_pyramid{.method = HeightMethod::pyramid};
constexpr HeightShadowStyle by_march{.method = HeightMethod::march, .blur_m = 0.0F};

double flat(glm::dvec2 /*place*/)
{
    return 0.0;
}

/// Hills of all sizes, and a pit.
double hills(glm::dvec2 p)
{
    const auto bump = [&](glm::dvec2 middle, double width, double height) {
        return height * std::exp(-glm::dot(p - middle, p - middle) / (width * width));
    };
    return bump({4.0, 2.0}, 6.0, 5.0) + bump({-9.0, 7.0}, 4.0, 4.0) + bump({-5.0, -11.0}, 5.0, -4.0) +
           bump({10.0, -8.0}, 3.0, 3.0);
}

TEST(HeightShadow, ShareOfTheDiscByItsFormula)
{
    // On level ground the horizon is at 0, and the sun's centre is `x` radii below it.
    for (const auto& style : {by_sweep, by_pyramid}) {
        for (const auto& [x, share] : {std::pair(-1.1, 1.0), std::pair(-0.5, 0.8045), std::pair(0.0, 0.5),
                                       std::pair(0.5, 0.1955), std::pair(1.1, 0.0)}) {
            const Sky sky{.azimuth_rad = 0.7, .elevation_rad = -x * sun_radius};
            for (const float v : shadow_of({.size = {9, 7}, .ground = flat}, sky, style)) {
                EXPECT_NEAR(v, share, 6e-4) << x;
            }
        }
    }
}

TEST(HeightShadow, WallThrowsUmbraAndPenumbraByTheirFormulas)
{
    constexpr double height = 1.0;
    constexpr double texel_m = 1.0 / 256.0;
    const Sky sky{.azimuth_rad = pi, .elevation_rad = pi / 6.0};
    const double umbra = height / std::tan(sky.elevation_rad + sky.radius_rad);
    const double penumbra = height / std::tan(sky.elevation_rad - sky.radius_rad);
    EXPECT_NEAR(umbra, 1.7136, 1e-4);
    EXPECT_NEAR(penumbra, 1.7508, 1e-4);
    // A long, thin field with a wall across it whose edge is at a texel's centre.
    Field field{.size = {640, 5}, .texel_m = texel_m};
    const double edge = field.place({64, 0}).x;
    field.ground = [&](glm::dvec2 p) { return p.x <= edge + 1e-9 ? height : 0.0; };
    for (const auto& style : {by_sweep, by_pyramid}) {
        const std::vector<float> seen = shadow_of(field, sky, style);
        double first_light = 0.0;
        double first_full = 0.0;
        for (uint32_t x = 65; x < 640; ++x) {
            const float v = seen[2 * 640 + x];
            const double distance = field.place({x, 0}).x - edge;
            first_light = first_light == 0.0 && v > 0.0F ? distance : first_light;
            first_full = first_full == 0.0 && v > 0.9999F ? distance : first_full;
            const double expected =
                share_of_disc((std::atan2(height, distance) - sky.elevation_rad) / sky.radius_rad);
            EXPECT_NEAR(v, expected, 2e-3) << distance;
        }
        EXPECT_NEAR(first_light, umbra, texel_m);
        EXPECT_NEAR(first_full, penumbra, texel_m);
    }
}

TEST(HeightShadow, WallThrowsTheSameShadowUnderEveryAzimuthWithoutStreaks)
{
    constexpr double height = 10.0;
    constexpr uint32_t side = 192;
    for (const double azimuth : {0.1, 0.5, pi / 4.0, 1.2, 2.0, 2.9, 3.7, 4.4, 5.3, 6.0}) {
        const Sky sky{.azimuth_rad = azimuth, .elevation_rad = 0.35, .radius_rad = 0.05};
        const auto towards = [&](glm::dvec2 p) { return glm::dot(p, sky.sunwards()); };
        // A steep, straight ramp, which the field represents exactly.
        Field field{.size = {side, side}, .texel_m = 0.5};
        field.ground = [&](glm::dvec2 p) { return std::clamp(towards(p) - 10.0, 0.0, height); };
        for (const auto& style : {by_sweep, by_pyramid}) {
            const std::vector<float> seen = shadow_of(field, sky, style);
            double worst = 0.0;
            for (uint32_t i = 0; i < side * side; ++i) {
                const glm::dvec2 p = field.place({i % side, i / side});
                const double to_crest = 20.0 - towards(p);
                // Only where the crest that shades a place is inside the field and is not at this place.
                const glm::dvec2 crest = p + to_crest * sky.sunwards();
                if (to_crest > 11.0 && std::max(std::abs(crest.x), std::abs(crest.y)) < 0.25 * side - 2.0) {
                    const double expected =
                        share_of_disc((std::atan2(height, to_crest) - sky.elevation_rad) / sky.radius_rad);
                    worst = std::max(worst, std::abs(expected - static_cast<double>(seen[i])));
                }
            }
            EXPECT_LT(worst, 0.06) << azimuth;
            EXPECT_GT(worst, 0.0);
        }
    }
}

TEST(HeightShadow, CosineHillsAreShadedAsMuchAsAMarchOf100000StepsSays)
{
    constexpr double height = 2.0;
    constexpr double wave = 2.0 * pi / 61.3;
    const Ground ground = [](glm::dvec2 p) { return height * std::cos(wave * p.x); };
    const Field field{.size = {1024, 2}, .texel_m = 0.25, .ground = ground};
    const double onset = std::atan(height * wave);
    for (const double part : {0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 1.1}) {
        const Sky sky{.elevation_rad = part * onset};
        const std::vector<float> swept = shadow_of(field, sky, by_sweep);
        const std::vector<float> climbed = shadow_of(field, sky, by_pyramid);
        double asked = 0.0;
        double by_lines = 0.0;
        double by_cells = 0.0;
        uint32_t count = 0;
        // The farther half: its occluders are inside the field, at most two waves away.
        for (uint32_t x = 0; x < 490; ++x) {
            by_lines += 1.0 - static_cast<double>(swept[x]);
            by_cells += 1.0 - static_cast<double>(climbed[x]);
            asked += 1.0 - marched(ground, field.place({x, 0}), sky, 123.0, 100000, height);
            ++count;
        }
        EXPECT_NEAR(by_lines / count, asked / count, 0.005) << part;
        EXPECT_NEAR(by_cells / count, asked / count, 0.005) << part;
        if (part > 1.05) {
            EXPECT_EQ(by_lines, 0.0) << "before the onset nothing is in shade";
        }
        if (part > 0.9 && part < 1.0) {
            EXPECT_GT(by_lines / count, 0.01) << "past the onset something is";
        }
    }
}

/// Mean difference from the march, away from the field's edge. Also the largest difference from the nearest
/// of the march's values within one texel ahead, behind and sideways.
std::pair<double, double> difference(const Field& field, const Sky& sky, const HeightShadowStyle& style)
{
    const std::vector<float> seen = shadow_of(field, sky, style);
    double sum = 0.0;
    double worst = 0.0;
    uint32_t count = 0;
    for (uint32_t y = 3; y < field.size.y - 3; y += 5) {
        for (uint32_t x = 3; x < field.size.x - 3; x += 5) {
            const glm::dvec2 forward = field.texel_m * sky.sunwards();
            const auto expected = [&](double ahead, double aside) {
                const glm::dvec2 place =
                    field.place({x, y}) + ahead * forward + aside * glm::dvec2(-forward.y, forward.x);
                return marched(field.ground, place, sky, 30.0, 400, 9.0);
            };
            const auto v = static_cast<double>(seen[y * field.size.x + x]);
            const double here = expected(0.0, 0.0);
            const auto [least, most] = std::minmax(
                {here, expected(-1.0, 0.0), expected(1.0, 0.0), expected(0.0, -1.0), expected(0.0, 1.0)});
            sum += std::abs(here - v);
            worst = std::max({worst, least - v, v - most});
            ++count;
        }
    }
    return {sum / count, worst};
}

TEST(HeightShadow, HillsAreShadedAsAMarchSaysUnderEveryAzimuth)
{
    const Field field{.size = {160, 128}, .texel_m = 0.25, .ground = hills};
    for (int i = 0; i < 8; ++i) {
        const Sky sky{.azimuth_rad = 0.11 + i * pi / 4.0, .elevation_rad = 0.4, .radius_rad = 0.06};
        for (const auto& style : {by_sweep, by_pyramid}) {
            const auto [mean, worst] = difference(field, sky, style);
            EXPECT_LT(mean, 0.005) << i;
            EXPECT_LT(worst, 0.03) << i;
        }
    }
}

TEST(HeightShadow, TurningTheFieldWithTheSunTurnsTheShadow)
{
    const Field field{.size = {96, 96}, .texel_m = 0.3, .ground = hills};
    const Field turned{.size = {96, 96}, .texel_m = 0.3, .ground = [](glm::dvec2 p) {
                           return hills({p.y, -p.x});
                       }};
    for (const double azimuth : {0.2, 0.9, 2.6}) {
        for (const auto& style : {by_sweep, by_pyramid}) {
            const std::vector<float> seen =
                shadow_of(field, {.azimuth_rad = azimuth, .elevation_rad = 0.35}, style);
            const std::vector<float> after =
                shadow_of(turned, {.azimuth_rad = azimuth + pi / 2.0, .elevation_rad = 0.35}, style);
            double sum = 0.0;
            for (uint32_t y = 0; y < 96; ++y) {
                for (uint32_t x = 0; x < 96; ++x) {
                    sum += std::abs(static_cast<double>(after[x * 96 + 95 - y] - seen[y * 96 + x]));
                }
            }
            // Whole quarter turns map texels onto texels: only rounding differs.
            EXPECT_LT(sum / (96.0 * 96.0), 1e-4) << azimuth;
        }
    }
}

TEST(HeightShadow, LongFieldsGoOnWhereADispatchEnds)
{
    // This field has more steps than two dispatches process.
    Field field{.size = {5000, 7}, .texel_m = 1.0};
    const Sky sky{.azimuth_rad = pi + 0.0003, .elevation_rad = 0.02, .radius_rad = 0.0005};
    const double edge = field.place({100, 0}).x;
    field.ground = [&](glm::dvec2 p) { return std::abs(p.x - edge) < 0.5 ? 80.0 : 0.0; };
    const std::vector<float> swept = shadow_of(field, sky, by_sweep);
    const std::vector<float> climbed = shadow_of(field, sky, by_pyramid);
    for (uint32_t x = 101; x < 5000; ++x) {
        const double distance = static_cast<double>(x) - 100.0;
        const double expected =
            share_of_disc((std::atan2(80.0, distance) - sky.elevation_rad) / sky.radius_rad);
        EXPECT_NEAR(swept[3 * 5000 + x], expected, 2e-3) << x;
        EXPECT_NEAR(climbed[3 * 5000 + x], expected, 2e-3) << x;
    }
}

TEST(HeightShadow, HorizonGivesTheSameShadowAndTellsItsHeight)
{
    const Field field{.size = {96, 80}, .texel_m = 0.4, .ground = hills};
    const Sky sky{.azimuth_rad = 0.8, .elevation_rad = 0.3, .radius_rad = 0.05};
    for (const auto& style : {by_sweep, by_pyramid}) {
        const std::vector<float> seen = shadow_of(field, sky, style);
        const std::vector<float> above = shadow_of(field, sky, style, true);
        for (size_t i = 0; i < seen.size(); ++i) {
            EXPECT_NEAR(share_of_disc(static_cast<double>(above[i]) / sky.radius_rad), seen[i], 2e-3);
            EXPECT_GE(above[i], -0.3002F) << "never under level ground";
        }
    }
    EXPECT_THROW(static_cast<void>(shadow_of(field, sky, by_march, true)), std::logic_error);
}

TEST(HeightShadow, MarchAgreesButForTheSunsSize)
{
    const Field field{.size = {128, 128}, .texel_m = 0.25, .ground = hills};
    const Sky sky{.azimuth_rad = 2.2, .elevation_rad = 0.35, .radius_rad = 1e-5};
    const std::vector<float> swept = shadow_of(field, sky, by_sweep);
    const std::vector<float> hard = shadow_of(field, sky, by_march);
    uint32_t differing = 0;
    for (size_t i = 0; i < hard.size(); ++i) {
        EXPECT_TRUE(hard[i] == 0.0F || hard[i] == 1.0F);
        differing += std::abs(hard[i] - swept[i]) > 0.5F ? 1 : 0;
    }
    EXPECT_LT(differing, hard.size() / 100);
    // The blur preserves the mean, and leaves no step as high as that of the hard edge.
    const std::vector<float> soft = shadow_of(field, sky, {.method = HeightMethod::march, .blur_m = 0.75F});
    double sum = 0.0;
    float steepest = 0.0F;
    for (size_t i = 0; i < hard.size(); ++i) {
        sum += static_cast<double>(soft[i] - hard[i]);
        steepest = std::max(steepest, i % 128 > 0 ? std::abs(soft[i] - soft[i - 1]) : 0.0F);
    }
    EXPECT_NEAR(sum / static_cast<double>(hard.size()), 0.0, 0.005);
    EXPECT_LT(steepest, 0.2F);
}

/// Fields of equal size, stacked vertically.
test::Layer stacked(std::span<const Field> fields)
{
    const glm::uvec2 size = fields.front().size;
    return test::Layer::depth({size.x, size.y * static_cast<uint32_t>(fields.size())}, [&](glm::uvec2 texel) {
        const Field& field = fields[texel.y / size.y];
        return static_cast<float>(field.ground(field.place({texel.x, texel.y % size.y})));
    });
}

TEST(HeightShadow, FieldsTogetherAreAsEachAlone)
{
    const auto turned_hills = [](glm::dvec2 p) { return 1.4 * hills({p.y, -p.x}); };
    const std::array<Field, 3> fields{Field{.size = {96, 70}, .texel_m = 0.5, .ground = hills},
                                      Field{.size = {96, 70}, .texel_m = 0.125, .ground = turned_hills},
                                      Field{.size = {96, 70}, .texel_m = 2.0, .ground = hills}};
    FieldTexels texel_m;
    for (const Field& field : fields) {
        texel_m.push_back(static_cast<float>(field.texel_m));
    }
    for (const auto& style : {by_sweep, by_pyramid}) {
        for (const double azimuth : {0.4, 2.1, 3.9, 5.5}) {
            const Sky sky{.azimuth_rad = azimuth, .elevation_rad = 0.3};
            test::Layer height = stacked(fields);
            gpu::Graph graph;
            const std::vector<float> together =
                test::run_and_read_coverage(graph, add_height_horizon(graph,
                                                                      {.height = height.in(graph),
                                                                       .texel_m = texel_m,
                                                                       .towards_sun = sky.towards_sun(),
                                                                       .sun_radius_rad = sky.radius_rad},
                                                                      style));
            std::vector<float> alone;
            for (const Field& field : fields) {
                std::ranges::copy(shadow_of(field, sky, style, true), std::back_inserter(alone));
            }
            EXPECT_EQ(together, alone) << azimuth;
        }
    }
    for (const HeightMethod method : {HeightMethod::march, HeightMethod::above}) {
        const HeightShadowStyle style{.method = method, .blur_m = 0.8F};
        const Sky sky{.azimuth_rad = 2.1, .elevation_rad = 0.3};
        test::Layer height = stacked(fields);
        gpu::Graph graph;
        const std::vector<float> together =
            test::run_and_read_coverage(graph, add_height_shadow(graph,
                                                                 {.height = height.in(graph),
                                                                  .texel_m = texel_m,
                                                                  .towards_sun = sky.towards_sun(),
                                                                  .sun_radius_rad = sky.radius_rad},
                                                                 style));
        std::vector<float> alone;
        for (const Field& field : fields) {
            std::ranges::copy(shadow_of(field, sky, style), std::back_inserter(alone));
        }
        EXPECT_EQ(together, alone) << static_cast<int>(method);
    }
}

TEST(HeightShadow, HorizonsAreKnownAsFarFromABroadSunAsItIsSeen)
{
    const Field level{.ground = [](glm::dvec2) { return 0.0; }};
    for (const auto& [radius_rad, below_rad] : {std::pair(0.005, 0.15), {0.02, 0.32}, {0.2, 0.5}}) {
        const Sky sky{.elevation_rad = 0.5, .radius_rad = radius_rad};
        for (const float horizon : shadow_of(level, sky, by_pyramid, true)) {
            ASSERT_NEAR(static_cast<double>(horizon), -below_rad, 1e-3) << radius_rad;
        }
    }
}

TEST(HeightShadow, HorizonsOfASectorAreThoseOfTheWholeFieldAndTakeNoHeightsBeside)
{
    for (const double azimuth : {0.4, 1.9, 3.3, 5.6}) {
        const Sky sky{.azimuth_rad = azimuth, .elevation_rad = 0.25};
        // Tests a sector to the right of one line and to the left of another line, through a place in the
        // field.
        shared::FieldSector wanted{.sides = {{0.6F, 0.8F}, {0.8F, -0.6F}}, .offsets = {{-50.0F, -3.0F}}};
        const auto is_within = [&](const shared::FieldSector& sector, glm::uvec2 texel) {
            return glm::dot(sector.sides[0], glm::vec2(texel)) + sector.offsets[0].x >= 0.0F &&
                   glm::dot(sector.sides[1], glm::vec2(texel)) + sector.offsets[0].y >= 0.0F;
        };
        shared::FieldSector sunward = wanted;
        for (int line = 0; line < 2; ++line) {
            const bool leaves = glm::dot(glm::dvec2(wanted.sides[line]), sky.sunwards()) < 0.0;
            sunward.sides[line] = leaves ? glm::vec2(0.0F) : wanted.sides[line];
            sunward.offsets[0][line] = leaves ? 0.0F : wanted.offsets[0][line] + 3.0F;
        }
        const Field field{.size = {90, 75}, .texel_m = 0.25, .ground = hills};
        Field sunk = field;
        sunk.ground = [&](glm::dvec2 place) {
            const glm::dvec2 texel = glm::round(place / field.texel_m + 0.5 * glm::dvec2(field.size - 1U));
            return is_within(sunward, glm::uvec2(texel)) ? hills(place) : -1e30;
        };
        const std::vector<float> whole = shadow_of(field, sky, by_pyramid, true);
        const std::vector<float> part = shadow_of(sunk, sky, by_pyramid, true, wanted);
        size_t compared = 0;
        for (uint32_t i = 0; i < whole.size(); ++i) {
            if (is_within(wanted, {i % field.size.x, i / field.size.x})) {
                EXPECT_EQ(part[i], whole[i]) << i;
                ++compared;
            }
        }
        EXPECT_GT(compared, 1000U);
        EXPECT_LT(compared, whole.size() / 2);
    }
}

TEST(HeightShadow, FieldsOfNoAreaAreRefused)
{
    test::Layer height = Field{.size = {8, 9}, .ground = flat}.layer();
    gpu::Graph graph;
    const gpu::ImageId image = height.in(graph);
    const auto in = [&](FieldTexels texel_m) {
        return HeightShadowInputs{.height = image, .texel_m = texel_m, .towards_sun = Sky{}.towards_sun()};
    };
    EXPECT_THROW(static_cast<void>(add_height_shadow(graph, in({}))), std::logic_error);
    EXPECT_THROW(static_cast<void>(add_height_shadow(graph, in({1.0F, 1.0F}))), std::logic_error);
    EXPECT_THROW(static_cast<void>(shadow_of({.size = {1, 8}, .ground = flat}, {})), std::logic_error);
    for (const glm::uvec2 size : {glm::uvec2(2, 2), glm::uvec2(2, 33), glm::uvec2(17, 2)}) {
        for (const auto& style : {by_sweep, by_pyramid, by_march}) {
            for (const float v : shadow_of({.size = size, .ground = flat}, {.azimuth_rad = 1.0}, style)) {
                EXPECT_EQ(v, 1.0F);
            }
        }
    }
}

} // namespace
} // namespace estampe::shadow
