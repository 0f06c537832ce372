// SPDX-License-Identifier: MIT
// Tests which passes are scheduled on one level, so that they may overlap. compile_property_test.cpp checks
// that the barriers between the levels are sufficient.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/graph/graph_test_support.hpp"
#include "gpu/graph/schedule.hpp"

namespace estampe::gpu {
namespace {

Schedule schedule_of(const Graph& graph)
{
    Schedule schedule;
    Scheduler().run(graph, schedule);
    return schedule;
}

ImageId made(Graph& graph, const std::string& name)
{
    auto pass = graph.compute("make " + name, fake_shader);
    return pass.write(graph.image(name, small_image));
}

ImageId next(Graph& graph, const std::string& name, ImageId before)
{
    auto pass = graph.compute(name, fake_shader);
    pass.sample(before);
    return pass.write(graph.image(name + " of it", small_image));
}

TEST(ScheduleTest, TwoChainsGoSideBySideAndShareTheirBarriers)
{
    Graph graph;
    const ImageId a = next(graph, "a2", next(graph, "a1", made(graph, "a")));
    const ImageId b = next(graph, "b2", next(graph, "b1", made(graph, "b")));
    graph.compute("join", fake_shader).sample(a).sample(b).keep();
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(kept_names(graph, compiled), (Names{"make a", "make b", "a1", "b1", "a2", "b2", "join"}));
    for (const std::string chain : {"make a", "a1", "a2"}) {
        EXPECT_FALSE(barriers_of(graph, compiled, chain).empty()) << chain;
    }
    for (const std::string chain : {"make b", "b1", "b2"}) {
        EXPECT_TRUE(barriers_of(graph, compiled, chain).empty()) << chain;
    }
}

TEST(ScheduleTest, WhatFillsNoDeviceIsMadeAsEarlyAsItCanBe)
{
    Graph graph;
    const ImageId end = next(graph, "second", next(graph, "first", made(graph, "chain")));
    const ImageId alone = made(graph, "alone");
    graph.compute("join", fake_shader).sample(alone).sample(end).keep();
    EXPECT_EQ(kept_names(graph, compile(graph)),
              (Names{"make chain", "make alone", "first", "second", "join"}));
    EXPECT_EQ(schedule_of(graph).levels, (std::vector<uint32_t>{0, 0, 1, 2, 3}));
}

ImageId filled(Graph& graph, const std::string& name, uint32_t groups = 1024)
{
    auto pass = graph.compute(name, fake_shader);
    const ImageId image = pass.write(graph.image(name, small_image));
    pass.dispatch(groups);
    return image;
}

TEST(ScheduleTest, WhatFillsADeviceGoesWhereNothingElseDoesAndStandsBehindInItsLevel)
{
    Graph graph;
    const std::vector<ImageId> wide{filled(graph, "a"), filled(graph, "b"), filled(graph, "c"),
                                    filled(graph, "not as wide", 1023)};
    const ImageId end = next(graph, "third", next(graph, "second", made(graph, "first")));
    auto join = graph.compute("join", fake_shader);
    for (const ImageId image : wide) {
        join.sample(image);
    }
    join.sample(end).keep();
    // The three wide passes could all be in the last level. The scheduler assigns each to the level with the
    // fewest wide passes.
    EXPECT_EQ(kept_names(graph, compile(graph)),
              (Names{"not as wide", "make first", "a", "second", "b", "third", "c", "join"}));
    EXPECT_EQ(schedule_of(graph).levels, (std::vector<uint32_t>{0, 0, 0, 1, 1, 2, 2, 3}));
}

TEST(ScheduleTest, WhatWaitsGoesBesideWhatWaitsAsLong)
{
    Graph graph;
    const ImageId few = made(graph, "few");
    const auto waiting = [&](const std::string& name, uint32_t us, uint32_t groups, ImageId after) {
        auto pass = graph.compute(name, fake_shader);
        pass.sample(after);
        const ImageId image = pass.write(graph.image(name, small_image));
        pass.estimated_duration_us(us).dispatch(groups);
        return image;
    };
    const ImageId source = made(graph, "source");
    const ImageId early = waiting("waits a little, few", 40, 64, source);
    const ImageId wide = waiting("waits a little, many", 40, 4096, source);
    const ImageId longer = waiting("waits longer", 200, 64, source);
    const ImageId end = next(graph, "third", waiting("second", 100, 12, next(graph, "first", few)));
    auto join = graph.compute("join", fake_shader);
    join.sample(early).sample(wide).sample(longer).sample(end).keep();
    // All long passes could overlap "first". Beside a pass of 100 us, a pass of 40 us costs nothing, and a
    // pass of 200 us costs least.
    EXPECT_EQ(kept_names(graph, compile(graph)),
              (Names{"make few", "make source", "first", "waits a little, few", "waits longer", "second",
                     "waits a little, many", "third", "join"}));
    EXPECT_EQ(schedule_of(graph).levels, (std::vector<uint32_t>{0, 0, 1, 2, 2, 2, 2, 3, 4}));
}

TEST(ScheduleTest, WhatATakenPassWasToldIsForgottenWithTheGraph)
{
    Graph graph;
    graph.compute("long", fake_shader).estimated_duration_us(100).keep();
    graph.clear();
    graph.compute("other", fake_shader).keep();
    EXPECT_EQ(graph.passes()[0].estimated_duration_us, 0U);
}

TEST(ScheduleTest, SideEffectsKeepTheirOrder)
{
    Graph graph;
    graph.custom("1").keep();
    graph.custom("2").keep();
    graph.custom("3").keep();
    EXPECT_EQ(kept_names(graph, compile(graph)), (Names{"1", "2", "3"}));
    EXPECT_EQ(schedule_of(graph).levels, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(ScheduleTest, ReadersInOneLayoutGoSideBySideAndThoseInTwoDoNot)
{
    Graph graph;
    const ImageId image = made(graph, "image");
    std::vector<ImageId> read;
    const auto reader = [&](const std::string& name, Access access) {
        auto pass = graph.custom(name);
        pass.touch(image, access);
        read.push_back(pass.touch_write(graph.image(name, small_image), Access::compute_storage_write));
    };
    reader("sampled", Access::compute_sampled);
    reader("sampled too", Access::raster_sampled);
    reader("copied", Access::transfer_read);
    auto join = graph.compute("join", fake_shader);
    for (const ImageId made_of_it : read) {
        join.sample(made_of_it);
    }
    join.keep();
    EXPECT_EQ(schedule_of(graph).levels, (std::vector<uint32_t>{0, 1, 1, 2, 3}));
}

/// Builds a graph of random passes; each pass reads some buffers and images and writes others.
Graph random_graph(uint32_t seed)
{
    std::mt19937 random(seed);
    const auto below = [&](uint32_t limit) { return static_cast<uint32_t>(random() % limit); };
    Graph graph;
    std::vector<ImageId> images;
    for (uint32_t i = 0; i < 8; ++i) {
        images.push_back(made(graph, "image " + std::to_string(i)));
    }
    const uint32_t count = 5 + below(20);
    for (uint32_t i = 0; i < count; ++i) {
        auto pass = graph.custom("pass " + std::to_string(i));
        for (ImageId& image : images) {
            const uint32_t what = below(10);
            if (what < 2) {
                pass.touch(image, what == 0 ? Access::compute_sampled : Access::transfer_read);
            } else if (what == 2) {
                image = pass.touch_write(image, Access::compute_storage_modify);
            }
        }
        if (below(4) == 0) {
            pass.keep();
        }
        if (below(2) == 0) {
            pass.dispatch(2048);
        }
    }
    for (const ImageId image : images) {
        graph.export_image(image);
    }
    return graph;
}

bool hang_together(const Graph& graph, const PassRecord& a, const PassRecord& b)
{
    if (a.has_side_effect && b.has_side_effect) {
        return true;
    }
    return std::ranges::any_of(a.uses, [&](const Use& one) {
        return std::ranges::any_of(b.uses, [&](const Use& other) {
            const bool are_images = graph.resources()[one.resource].is_image;
            const bool clash = is_write(one.access) || is_write(other.access) ||
                               (are_images && layout_for(one.access) != layout_for(other.access));
            return one.resource == other.resource && clash;
        });
    });
}

TEST(ScheduleTest, EachPassIsAfterThoseItHangsOnInNoMoreLevelsThanTheLongestChainHas)
{
    constexpr uint32_t graph_count = 500;
    uint32_t side_by_side = 0;
    for (uint32_t seed = 0; seed < graph_count; ++seed) {
        const Graph graph = random_graph(seed);
        const Schedule schedule = schedule_of(graph);
        const size_t count = schedule.passes.size();
        ASSERT_TRUE(std::ranges::is_sorted(schedule.levels)) << "seed " << seed;
        std::vector<uint32_t> level_of_pass(graph.passes().size(), 0);
        for (size_t i = 0; i < count; ++i) {
            level_of_pass[schedule.passes[i]] = schedule.levels[i];
            side_by_side += i > 0 && schedule.levels[i] == schedule.levels[i - 1] ? 1 : 0;
        }
        std::vector<uint32_t> in_declared_order = schedule.passes;
        std::ranges::sort(in_declared_order);
        // For each pass, the length of the longest dependency chain that ends with this pass.
        std::vector<uint32_t> chain(graph.passes().size(), 1);
        uint32_t longest = 0;
        for (const uint32_t later : in_declared_order) {
            for (const uint32_t pass : in_declared_order) {
                if (pass < later && hang_together(graph, graph.passes()[pass], graph.passes()[later])) {
                    ASSERT_LT(level_of_pass[pass], level_of_pass[later])
                        << "seed " << seed << ", " << graph.passes()[later].name;
                    chain[later] = std::max(chain[later], chain[pass] + 1);
                }
            }
            longest = std::max(longest, chain[later]);
        }
        EXPECT_EQ(schedule.levels.back() + 1, longest) << "seed " << seed;
    }
    EXPECT_GT(side_by_side, graph_count); // The random graphs must contain enough parallel passes
}

} // namespace
} // namespace estampe::gpu
