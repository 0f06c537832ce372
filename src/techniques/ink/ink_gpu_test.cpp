// SPDX-License-Identifier: MIT
// Ink in water whose flow is known.
#include "techniques/ink/ink_test_support.hpp"

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace estampe::ink {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Ink, FadesExponentially)
{
    for (const float life_s : {0.4F, 3.0F}) {
        InkStyle style = still_ink();
        style.life_s = life_s;
        Bench bench({16, 16});
        bench.fill(style, [](glm::uvec2) { return glm::vec2(0.8F, 0.0F); });
        for (double time_s = 0.3; time_s < 4.0; time_s += 0.3) {
            bench.advance(style, time_s);
            const double wanted = 0.8 * std::exp(-time_s / static_cast<double>(life_s));
            EXPECT_NEAR(bench.cells().at(8 * 16 + 8).x, wanted, 1e-3) << life_s << " s, at " << time_s;
        }
    }
}

TEST(Ink, DriesIntoThePaperWhereItIs)
{
    InkStyle style = still_ink();
    style.life_s = 1.0F;
    style.soak = 0.5F;
    style.wind_mm_per_s = 8.0F;
    style.wind_deg = 0.0F;
    Bench bench({64, 32});
    bench.fill(style,
               [](glm::uvec2 cell) { return glm::vec2(cell.x >= 8 && cell.x < 16 ? 0.5F : 0.0F, 0.0F); });
    for (int second = 1; second <= 4; ++second) {
        bench.advance(style, second);
    }
    const auto cells = bench.cells();
    const auto row = [&](size_t x) { return cells.at(16 * 64 + x); };
    EXPECT_NEAR(row(44).x, 0.5 * std::exp(-4.0), 2e-3) << "what is wet has gone 32 cells with the wind";
    EXPECT_LT(row(12).x, 1e-3F);
    EXPECT_GT(row(12).y, 0.05F) << "what is dry stays behind it";
    EXPECT_GT(row(12).y, row(40).y) << "most where most was";
    EXPECT_EQ(row(4).y, 0.0F) << "and none upwind";
}

TEST(Ink, IsSweptAwayByABallThatExpandsAndByNothingElse)
{
    // The cubed radius grows from 8^3 to 24^3 within a second.
    const PageBlast blast{.middle_mm = {40.0F, 32.0F}, .cubed_radius_mm3 = [](double time_s) {
                              return static_cast<float>(
                                  glm::mix(512.0, 13824.0, glm::clamp(time_s, 0.0, 1.0)));
                          }};
    // A spot outside of the ball, 16 cells to the right of its middle.
    const auto spot = [](glm::uvec2 cell) {
        const glm::vec2 off = glm::vec2(cell) + 0.5F - glm::vec2(56.0F, 32.0F);
        return glm::vec2(std::exp(-glm::dot(off, off) / 8.0F), 0.0F);
    };
    const auto middle_after = [&](const std::vector<PageBlast>& blasts) {
        const InkStyle style = still_ink();
        Bench bench({96, 64});
        bench.blasts = blasts;
        bench.fill(style, spot);
        for (int tenth = 1; tenth <= 12; ++tenth) {
            bench.advance(style, tenth / 10.0);
        }
        EXPECT_EQ((bench.plan.variant & shared::ink_has_blasts) != 0, false) << "the ball grows no more";
        const auto cells = bench.cells();
        glm::dvec2 sum(0.0);
        double weight = 0.0;
        for (size_t i = 0; i < cells.size(); ++i) {
            sum += static_cast<double>(cells[i].x) * (glm::dvec2(i % 96, i / 96) + 0.5);
            weight += static_cast<double>(cells[i].x);
        }
        return sum / weight;
    };
    const glm::dvec2 still = middle_after({});
    EXPECT_NEAR(still.x, 56.0, 1e-3);
    const glm::dvec2 swept = middle_after({blast});
    EXPECT_NEAR(swept.x, 40.0 + std::cbrt(std::pow(16.0, 3.0) + 13824.0 - 512.0), 0.4);
    EXPECT_NEAR(swept.y, 32.0, 0.05);
}

/// A disc with a slot, after Zalesak.
float slotted(glm::dvec2 from_middle, double radius)
{
    const bool is_slot = std::abs(from_middle.x) < radius / 6.0 && from_middle.y > -2.0 * radius / 3.0;
    return glm::length(from_middle) < radius && !is_slot ? 1.0F : 0.0F;
}

TEST(Ink, KeepsASlottedDiscThatTurnsOnce)
{
    constexpr uint32_t side = 200;
    constexpr double seconds = 15.0;
    const InkStyle style = still_ink();
    Bench bench({side, side});
    const auto disc = [](glm::uvec2 cell) {
        return slotted(glm::dvec2(cell) + 0.5 - glm::dvec2(100.0, 60.0), 30.0);
    };
    bench.fill(style, [&](glm::uvec2 cell) { return glm::vec2(disc(cell), 0.0F); });
    const shared::InkZone turns{.middle_mm = glm::vec2(0.5F * side),
                                .radius_mm = 2.0F * side,
                                .amount = 1.0F,
                                .turn_rad_s = static_cast<float>(2.0 * pi / seconds)};
    for (int second = 1; second <= 15; ++second) {
        bench.advance(style, second, {}, {turns});
    }
    const auto cells = bench.cells();
    double error = 0.0;
    double sum = 0.0;
    double wanted_sum = 0.0;
    for (uint32_t i = 0; i < cells.size(); ++i) {
        const auto wanted = static_cast<double>(disc({i % side, i / side}));
        error += std::abs(static_cast<double>(cells[i].x) - wanted);
        sum += static_cast<double>(cells[i].x);
        wanted_sum += wanted;
    }
    EXPECT_LE(error / (side * side), 0.01) << "of the whole field, as for Zalesak's disc";
    EXPECT_LE(std::abs(sum - wanted_sum) / wanted_sum, 0.01);
    RecordProperty("error of the field", std::to_string(error / (side * side)));
    RecordProperty("error of the disc", std::to_string(error / wanted_sum));
    RecordProperty("drift of the sum", std::to_string((sum - wanted_sum) / wanted_sum));
}

TEST(Ink, ComesBackWhenTheCameraHasRolledOnce)
{
    constexpr uint32_t side = 96;
    InkStyle style = still_ink();
    style.follow = Follow::turn;
    style.oversize = 1.0F;
    Bench bench({side, side});
    bench.keeps_layers = true;
    // Threads of ink ten cells wide, as in the style, away from the page's edge.
    const auto threads = [](glm::uvec2 cell) {
        const glm::dvec2 at = glm::dvec2(cell) + 0.5 - 0.5 * side;
        const double within = glm::smoothstep(44.0, 36.0, glm::length(at));
        const double wave = 0.5 + 0.5 * std::sin(0.25 * at.x + 3.0 * std::sin(0.07 * at.y));
        return static_cast<float>(within * wave * wave);
    };
    bench.fill(style, [&](glm::uvec2 cell) { return glm::vec2(threads(cell), threads(cell)); });
    View view{.is_moved = true};
    view.before_from_clip = glm::rotate(glm::mat4(1.0F), glm::radians(1.0F), glm::vec3(0.0F, 0.0F, 1.0F));
    const auto start = bench.cells();
    for (int frame = 0; frame < 360; ++frame) {
        bench.advance(style, 0.0, view);
        if (frame == 89) {
            EXPECT_GT(glm::distance(bench.cells().at(48 * side + 60), start.at(48 * side + 60)), 0.1F)
                << "meanwhile it has turned";
        }
    }
    glm::dvec2 square(0.0);
    const auto cells = bench.cells();
    for (uint32_t i = 0; i < cells.size(); ++i) {
        const glm::dvec2 off = glm::dvec2(cells[i]) - static_cast<double>(threads({i % side, i / side}));
        square += off * off / static_cast<double>(cells.size());
    }
    const glm::dvec2 psnr_db = -10.0 * glm::log(square) / std::log(10.0);
    EXPECT_GE(psnr_db.x, 35.0) << "wet";
    EXPECT_GE(psnr_db.y, 35.0) << "dry";
    RecordProperty("wet, dB", std::to_string(psnr_db.x));
}

/// Dark strokes everywhere, and adjacent spots that emit much ink.
InkStyle flood()
{
    InkStyle style = still_ink();
    style.amount_per_s = 100.0F;
    style.spot_mm = 4.0F;
    style.spacing_mm = 8.0F;
    style.swirl_mm_per_s = 9.0F;
    style.swirl_mm = 30.0F;
    style.life_s = 3.0F;
    style.age_s = 4.0F;
    style.opacity = 1.0F;
    style.sharpness = 0.6F;
    return style;
}

TEST(Ink, StaysWithinItsBudget)
{
    double unbound = 0.0;
    for (const float budget : {1.0F, 0.3F, 0.1F, 0.02F}) {
        InkStyle style = flood();
        style.budget = budget;
        Bench bench({96, 64});
        bench.hatch_at = [](glm::uvec2) { return 1.0F; };
        for (int picture = 0; picture < 4; ++picture) {
            bench.advance(style, 0.5 * picture);
            const double covered = bench.mean_cover();
            // Only a quarter of the pixels is measured.
            EXPECT_LE(covered, 1.05 * static_cast<double>(budget) + 0.002) << budget;
            EXPECT_GE(covered, std::min(0.4 * static_cast<double>(budget), 0.5 * unbound)) << budget;
            unbound = budget == 1.0F ? covered : unbound;
        }
    }
    EXPECT_GT(unbound, 0.4);
}

TEST(Ink, ComesOutOfWhatIsDarkInSpots)
{
    InkStyle style = flood();
    style.swirl_mm_per_s = 0.0F;
    style.spot_mm = 1.0F;
    style.age_s = 1.0F;
    Bench bench({96, 64});
    bench.hatch_at = [](glm::uvec2 pixel) { return pixel.x < 48 ? 0.45F : 1.0F; };
    bench.advance(style, 7.0);
    size_t inked = 0;
    for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = 0; x < 96; ++x) {
            const float cover = bench.cover(size_t{y} * 96 + x);
            inked += cover > 0.5F ? 1 : 0;
            EXPECT_TRUE(x >= 46 || cover == 0.0F) << "paler than the threshold, at " << x;
        }
    }
    EXPECT_GT(inked, 20U);
    EXPECT_LT(inked, size_t{48} * 64 / 8) << "small spots, not the whole";
}

TEST(Ink, AThinSourceGivesAnEvenThread)
{
    // A single dark pixel in a wind that blows across rows of cells, at several speeds. Along the thread, the
    // ink of a column of cells must be even: no beads and no rungs.
    for (const float mm_per_s : {40.0F, 75.0F, 110.0F, 160.0F}) {
        InkStyle style = flood();
        style.swirl_mm_per_s = 0.0F;
        style.wind_mm_per_s = mm_per_s;
        style.wind_deg = 9.0F;
        style.spot_mm = 40.0F;
        style.spacing_mm = 60.0F;
        style.age_s = 1e6F;
        style.life_s = 1e6F;
        Bench bench({128, 64});
        bench.hatch_at = [](glm::uvec2 pixel) { return pixel == glm::uvec2(12, 40) ? 1.0F : 0.0F; };
        for (int picture = 0; picture <= 60; ++picture) {
            bench.advance(style, 3.0 + picture / 24.0);
        }
        const auto cells = bench.cells();
        std::vector<double> columns(128);
        for (size_t i = 0; i < cells.size(); ++i) {
            columns[i % 128] += static_cast<double>(cells[i].x);
        }
        double mean = 0.0;
        double rough = 0.0;
        for (size_t x = 24; x < 104; ++x) {
            mean += columns[x] / 80.0;
            rough += std::abs(columns[x + 1] - 2.0 * columns[x] + columns[x - 1]) / 80.0;
        }
        std::printf("at %.0f mm/s: ink of a column %.4f, roughness %.4f\n", static_cast<double>(mm_per_s),
                    mean, rough / mean);
        EXPECT_GT(mean, 1e-3);
        EXPECT_LE(rough / mean, 0.1) << mm_per_s;
    }
}

TEST(Ink, IsTheSameEachTime)
{
    std::vector<std::vector<glm::vec2>> runs;
    for (int run = 0; run < 2; ++run) {
        Bench bench({64, 48});
        bench.hatch_at = [](glm::uvec2 pixel) { return pixel.x % 7 < 3 ? 1.0F : 0.0F; };
        for (int picture = 0; picture < 4; ++picture) {
            bench.advance(flood(), picture / 30.0);
        }
        runs.push_back(bench.cells());
    }
    EXPECT_EQ(runs[0], runs[1]);
}

TEST(InkTime, StartsAfreshAfterAGapOrBackInTime)
{
    InkStyle style;
    style.age_s = 2.0F;
    const auto steps = [&](double time_s, std::optional<double> before_s) {
        const Time time = time_of(style, time_s, before_s);
        return std::pair(time.steps, time.is_fresh);
    };
    EXPECT_EQ(steps(5.0, {}), std::pair(48U, true));
    EXPECT_EQ(steps(5.0, 5.1), std::pair(48U, true));
    EXPECT_EQ(steps(5.0, 3.9), std::pair(48U, true));
    EXPECT_EQ(steps(5.0, 5.0), std::pair(0U, false));
    EXPECT_EQ(steps(1.0 / 24.0, 0.0), std::pair(1U, false));
    EXPECT_EQ(steps(1.0 / 30.0, 0.0), std::pair(1U, false));
    EXPECT_EQ(steps(0.1, 0.0), std::pair(3U, false));
    style.steps_per_s = 12.0F;
    EXPECT_EQ(steps(5.0, {}), std::pair(24U, true));
    EXPECT_EQ(steps(0.1, 0.0), std::pair(2U, false));
    style.age_s = 60.0F;
    EXPECT_LE(steps(0.0, {}).first, 100U) << "longer ones then";
}

} // namespace
} // namespace estampe::ink
