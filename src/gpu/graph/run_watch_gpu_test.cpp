// SPDX-License-Identifier: MIT
#include "gpu/pass_costs.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "gpu/graph/execute.hpp"
#include "gpu/transfers.hpp"
#include "support/gpu_device.hpp"
#include "support/validation_gate.hpp"

namespace estampe::gpu {
namespace {

/// Adds a pass that fills a buffer with zeros, and a pass that copies the buffer to `back`.
void declare_copy(Graph& graph, Buffer& back)
{
    add_read_back(graph, "back", add_zeros(graph, "zeros", 64), back);
}

TEST(RunWatch, TellsEachPassOfARunThatDoesTheSame)
{
    Device& device = test::shared_device();
    Executor executor(device);
    Buffer back(device, "back", 64, MemoryUse::readback);
    std::ranges::fill(back.mapped(), std::byte{1});
    std::vector<PassWork> told;
    watch_runs([&](std::span<const PassWork> passes) { told.assign(passes.begin(), passes.end()); });
    Graph graph;
    declare_copy(graph, back);
    executor.run(graph);
    watch_runs({});
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[0].name, "zeros");
    EXPECT_EQ(told[0].bytes, 64U);
    EXPECT_EQ(told[1].name, "back");
    EXPECT_EQ(told[1].bytes, 128U); // 64 bytes read and 64 written
    EXPECT_EQ(told[2].name, "back/host");
    for (const PassWork& pass : told) {
        EXPECT_FALSE(pass.operations.has_value()) << pass.name;
        EXPECT_GE(pass.ms, 0.0);
    }
    EXPECT_EQ(back.mapped()[0], std::byte{0});
    EXPECT_EQ(executor.timings().size(), 3U);
    told.clear();
    executor.run(graph);
    EXPECT_TRUE(told.empty()); // The empty watch function has ended the watching
    EXPECT_TRUE(test::take_validation_messages().empty());
}

TEST(RunWatch, CountsBytesThatAreReadAndWrittenTwice)
{
    const Shader shader{"none", {}};
    Graph graph;
    auto first = graph.compute("first", shader);
    BufferId list = first.write(graph.buffer("list", {.size_bytes = 100}));
    auto second = graph.compute("second", shader);
    list = second.modify(list);
    second.sample(graph.image("page", {.width = 10, .height = 5, .format = Format::rgba16f}));
    second.dispatch_indirect(list);
    EXPECT_EQ(bytes_of(graph, graph.passes()[0]), 100U);
    EXPECT_EQ(bytes_of(graph, graph.passes()[1]), 2U * 100U + 10U * 5U * 8U);
    // The number of threads is in a buffer, so only the device knows this number.
    EXPECT_FALSE(operations_of(graph, graph.passes()[1]).has_value());
}

} // namespace
} // namespace estampe::gpu
