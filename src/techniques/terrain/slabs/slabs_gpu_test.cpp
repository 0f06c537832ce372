// SPDX-License-Identifier: MIT
// Compares slabs with plain loops, slab by slab; tests that none is lost and that dunes grow.
#include "techniques/terrain/slabs/slabs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/glsl.hpp"
#include "support/gpu_device.hpp"

namespace estampe::terrain::slab_glsl { // named, as not all of it is used
using namespace test::glsl;             // NOLINT(google-build-using-namespace): GLSL's names are the point
#include "shaders/hash.glsl"
} // namespace estampe::terrain::slab_glsl

namespace estampe::terrain {
namespace {

using Slabs = std::vector<uint32_t>;

Slabs slabs_of(SlabField& field)
{
    gpu::Graph graph;
    return test::run_and_read_as<uint32_t>(graph, gpu::import_whole(graph, "slabs", field.slabs()));
}

/// Heights in metres after `count` more steps, at most `at_once` of them in a graph.
std::vector<float> heights_after(SlabField& field, const SlabStyle& style, uint32_t count,
                                 uint32_t at_once = 20, float fraction = 1.0F)
{
    for (; count > at_once; count -= at_once) {
        gpu::Graph graph;
        static_cast<void>(test::run_and_read_as<float>(graph, field.add_steps(graph, style, at_once)));
    }
    gpu::Graph graph;
    return test::run_and_read_as<float>(graph, field.add_steps(graph, style, count, fraction));
}

Slabs slabs_after(SlabField& field, const SlabStyle& style, uint32_t count, uint32_t at_once = 20)
{
    static_cast<void>(heights_after(field, style, count, at_once));
    return slabs_of(field);
}

uint64_t sum_of_slabs(const Slabs& slabs)
{
    return std::accumulate(slabs.begin(), slabs.end(), uint64_t{0});
}

/// A step of the simulation in plain loops.
class Reference {
public:
    Reference(uint32_t side, const Slabs& slabs)
        : side_(static_cast<int>(side)), slabs_(slabs.begin(), slabs.end())
    {
    }

    void step(const SlabStyle& style, uint64_t number)
    {
        const shared::SlabConstants c = slab_constants(style, static_cast<uint32_t>(side_), number);
        std::vector<int> next = slabs_;
        const std::vector<bool> lee = lee_cells(c);
        for (int i = 0; i < side_ * side_; ++i) {
            lift(c, i, lee, next);
        }
        slabs_ = next;
        for (int i = 0; i < style.slides; ++i) {
            slide(slide_constants(style, static_cast<uint32_t>(side_), i));
        }
    }

    [[nodiscard]] Slabs slabs() const { return {slabs_.begin(), slabs_.end()}; }

private:
    [[nodiscard]] size_t cell(int x, int y) const
    {
        const int last = side_ - 1;
        return static_cast<size_t>((y & last) * side_ + (x & last));
    }

    /// Walks each line for twice the field's length, and keeps the second half.
    [[nodiscard]] std::vector<bool> lee_cells(const shared::SlabConstants& c) const
    {
        std::vector<bool> lee(slabs_.size());
        for (int line = 0; line < side_; ++line) {
            for (int end = 0; end < side_; ++end) {
                const auto at = [&](int step) {
                    const int across = line + ((c.slope * step + c.phase) >> 16);
                    return c.along_y != 0 ? cell(across, c.sign * step) : cell(c.sign * step, across);
                };
                bool is_lee = false;
                // Begins at the start of a piece, one field length before the cell's own piece.
                const int piece = side_ / static_cast<int>(shared::slab_pieces);
                for (int back = 1; end - back >= end / piece * piece - side_; ++back) {
                    is_lee = is_lee || slabs_[at(end - back)] * 256 - c.drop * back > slabs_[at(end)] * 256;
                }
                lee[at(end)] = is_lee;
            }
        }
        return lee;
    }

    void lift(const shared::SlabConstants& c, int from, const std::vector<bool>& lee,
              std::vector<int>& next) const
    {
        const auto start = static_cast<size_t>(from);
        uint32_t bits = slab_glsl::hash(static_cast<uint32_t>(from), c.step, c.seed);
        if (bits >> 16U >= c.lift || lee[start] || slabs_[start] == 0) {
            return;
        }
        const int faster = (c.gain * std::clamp(slabs_[start] - c.mean, -16384, 16384)) >> 8;
        const int reach = std::clamp(256 + faster, 64, 1024);
        int x = from % side_;
        int y = from / side_;
        for (uint32_t hop = 0; hop < 32; ++hop) {
            bits = slab_glsl::hash(bits + hop);
            x += (c.hop_x * reach + static_cast<int>(bits & 0xFFFFU)) >> 16;
            y += (c.hop_y * reach + static_cast<int>(bits >> 16U)) >> 16;
            bits = slab_glsl::hash(bits);
            const size_t there = cell(x, y);
            const uint32_t stays = slabs_[there] > 0 ? c.on_sand : c.on_rock;
            if (lee[there] || bits >> 16U < stays) {
                break;
            }
        }
        --next[start];
        ++next[cell(x, y)];
    }

    void slide(const shared::SlideConstants& c)
    {
        const auto even_out = [&](size_t a, size_t b, int most) {
            const size_t high = slabs_[a] >= slabs_[b] ? a : b;
            const size_t low = high == a ? b : a;
            const int too_much = slabs_[high] - slabs_[low] - most;
            if (too_much > 0) {
                slabs_[high] -= (too_much + 1) / 2;
                slabs_[low] += (too_much + 1) / 2;
            }
        };
        for (int y = static_cast<int>(c.first_y); y < side_ + static_cast<int>(c.first_y); y += 2) {
            for (int x = static_cast<int>(c.first_x); x < side_ + static_cast<int>(c.first_x); x += 2) {
                even_out(cell(x, y), cell(x + 1, y + 1), c.aslant);
                even_out(cell(x + 1, y), cell(x, y + 1), c.aslant);
                even_out(cell(x, y), cell(x + 1, y), c.beside);
                even_out(cell(x, y + 1), cell(x + 1, y + 1), c.beside);
                even_out(cell(x, y), cell(x, y + 1), c.beside);
                even_out(cell(x + 1, y), cell(x + 1, y + 1), c.beside);
            }
        }
    }

    int side_;
    std::vector<int> slabs_;
};

/// Hills that are too steep for sand, with bare rock between them, and a column with a long lee.
std::vector<float> rough_start(uint32_t side)
{
    std::vector<float> heights;
    for (uint32_t i = 0; i < side * side; ++i) {
        const auto x = static_cast<float>(i % side);
        const auto y = static_cast<float>(i / side);
        const bool tower = i % side == 9 && i / side == 20;
        heights.push_back(tower ? 30.0F : 4.0F * std::sin(0.4F * x + 0.1F * y) * std::cos(0.3F * y));
    }
    return heights;
}

TEST(Slabs, AStepIsThatOfPlainLoopsSlabBySlab)
{
    constexpr uint32_t side = 64;
    std::vector<SlabStyle> styles(5);
    styles[0].wind_spread_deg = 0.0F;
    styles[1] = {.wind_deg = 37.0F, .stay_on_rock = 0.05F};
    styles[2] = {.depth_m = 1.0F, .wind_deg = 200.0F, .hop_cells = 9.5F, .speedup_per_m = 0.5F, .seed = 77};
    styles[3] = {.slab_m = 0.33F, .wind_deg = 112.0F, .lift_share = 1.0F, .slides = 3};
    styles[4] = {.wind_deg = -90.0F, .wind_spread_deg = 50.0F, .lee_deg = 40.0F, .repose_deg = 20.0F};
    for (const SlabStyle& style : styles) {
        SlabField field(test::shared_device(), style, side, rough_start(side));
        Reference reference(side, slabs_of(field));
        for (uint64_t step = 0; step < 6; ++step) {
            reference.step(style, step);
            const Slabs slabs = slabs_after(field, style, 1);
            ASSERT_EQ(slabs, reference.slabs()) << style.wind_deg << " degrees, step " << step;
        }
    }
}

TEST(Slabs, NoneIsLostOrMadeInTenThousandSteps)
{
    constexpr SlabStyle style{.depth_m = 2.0F, .wind_deg = 25.0F, .slides = 2};
    SlabField field(test::shared_device(), style, 64);
    const uint64_t before = sum_of_slabs(slabs_of(field));
    EXPECT_NEAR(static_cast<double>(before) * 0.1 / (64 * 64), 2.0, 0.05);
    for (int i = 0; i < 4; ++i) {
        const Slabs slabs = slabs_after(field, style, 2500, 48);
        ASSERT_EQ(sum_of_slabs(slabs), before);
        ASSERT_LT(*std::max_element(slabs.begin(), slabs.end()), before) << "below nothing";
    }
    EXPECT_EQ(field.steps(), 10000U);
}

TEST(Slabs, GraphsOfManyStepsAndOfFewGiveTheSameSlabs)
{
    constexpr SlabStyle style{.wind_deg = 10.0F};
    SlabField many(test::shared_device(), style, 64);
    SlabField few(test::shared_device(), style, 64);
    EXPECT_EQ(slabs_after(many, style, 21, 21), slabs_after(few, style, 21, 4));
    SlabField other(test::shared_device(), {.seed = 2}, 64);
    EXPECT_NE(slabs_after(other, {.wind_deg = 10.0F, .seed = 2}, 21), slabs_of(few));
}

TEST(Slabs, HeightsHoldTheSandAndRepeat)
{
    constexpr uint32_t side = 64;
    for (const int smooth : {0, 1, 2, 5, 8}) {
        const SlabStyle style{.smooth_cells = smooth};
        SlabField field(test::shared_device(), style, side, rough_start(side));
        const double sand_m = 0.1 * static_cast<double>(sum_of_slabs(slabs_of(field)));
        const std::vector<float> heights = heights_after(field, style, 0);
        EXPECT_NEAR(std::accumulate(heights.begin(), heights.end(), 0.0) / sand_m, 1.0, 1e-6) << smooth;
        // A start that is shifted around the field gives a result that is shifted equally.
        const std::vector<float> start = rough_start(side);
        std::vector<float> moved_start(start.size());
        const auto moved = [&](size_t i) { return (i / side + 50) % side * side + (i + 9) % side; };
        for (size_t i = 0; i < start.size(); ++i) {
            moved_start[moved(i)] = start[i];
        }
        SlabField moved_field(test::shared_device(), style, side, moved_start);
        const std::vector<float> moved_heights = heights_after(moved_field, style, 0);
        for (size_t i = 0; i < start.size(); ++i) {
            ASSERT_EQ(moved_heights[moved(i)], heights[i]) << i;
        }
        if (smooth == 0) {
            EXPECT_EQ(heights[20 * side + 9], 0.1F * 300.0F);
        }
    }
}

TEST(Slabs, FractionsLieBetweenTwoSteps)
{
    constexpr SlabStyle style{};
    SlabField field(test::shared_device(), style, 64, rough_start(64));
    const std::vector<float> first = heights_after(field, style, 3);
    const std::vector<float> second = heights_after(field, style, 1);
    EXPECT_EQ(heights_after(field, style, 0, 1, 0.0F), first);
    const std::vector<float> between = heights_after(field, style, 0, 1, 0.25F);
    for (size_t i = 0; i < first.size(); ++i) {
        ASSERT_NEAR(between[i], 0.75F * first[i] + 0.25F * second[i], 1e-5F);
    }
}

TEST(Slabs, MomentsCatchUpAndDoNotGoBack)
{
    constexpr SlabStyle style{};
    const std::vector<float> start = rough_start(64);
    SlabField asked(test::shared_device(), style, 64, start);
    SlabField stepped(test::shared_device(), style, 64, start);
    const auto at = [&](double moment, uint32_t most) {
        gpu::Graph graph;
        return test::run_and_read_as<float>(graph, asked.add_moment(graph, style, moment, most));
    };
    EXPECT_EQ(at(0.0, 4), heights_after(stepped, style, 0));
    EXPECT_EQ(at(2.25, 4), heights_after(stepped, style, 3, 3, 0.25F));
    EXPECT_EQ(asked.steps(), 3U);
    EXPECT_EQ(at(2.75, 4), heights_after(stepped, style, 0, 1, 0.75F));
    EXPECT_EQ(asked.steps(), 3U);
    EXPECT_EQ(at(9.5, 4), heights_after(stepped, style, 4)) << "as far as it may";
    EXPECT_EQ(asked.steps(), 7U);
    EXPECT_EQ(at(1.0, 4), heights_after(stepped, style, 0, 1, 0.0F));
    EXPECT_EQ(at(std::numeric_limits<double>::quiet_NaN(), 4), heights_after(stepped, style, 0, 1, 0.0F));
    EXPECT_EQ(asked.steps(), 7U);
}

TEST(Slabs, StartsAreMetresAndWhatIsNoHeightIsRock)
{
    std::vector<float> start(64 * 64, 1.26F);
    start[1] = -3.0F;
    start[2] = std::numeric_limits<float>::quiet_NaN();
    start[3] = std::numeric_limits<float>::infinity();
    SlabField field(test::shared_device(), {}, 64, start);
    const Slabs slabs = slabs_of(field);
    EXPECT_EQ(slabs[0], 13U);
    EXPECT_EQ(slabs[1], 0U);
    EXPECT_EQ(slabs[2], 0U);
    EXPECT_EQ(slabs[3], 1U << 20U);
    for (const uint32_t side : {0U, 32U, 100U, 2048U}) {
        EXPECT_THROW(SlabField(test::shared_device(), {}, side), std::logic_error) << side;
    }
    EXPECT_THROW(SlabField(test::shared_device(), {}, 128, start), std::logic_error);
    gpu::Graph graph;
    EXPECT_THROW(static_cast<void>(field.add_steps(graph, {}, 1000)), std::logic_error);
    EXPECT_EQ(field.steps(), 0U);
}

} // namespace
} // namespace estampe::terrain
