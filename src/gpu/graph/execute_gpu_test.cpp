// SPDX-License-Identifier: MIT
#include "gpu/graph/execute.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/validation_gate.hpp"

namespace estampe::gpu {
namespace {

using test::run_and_read_as;

auto fill_with(BufferId buffer, uint32_t value)
{
    return [buffer, value](Recorder& recorder) {
        vkCmdFillBuffer(recorder.commands(), recorder.buffer(buffer).handle(), 0, VK_WHOLE_SIZE, value);
    };
}

TEST(Execute, RunsPassesInOrderWithBarriersBetween)
{
    Graph graph;
    auto fill = graph.custom("fill");
    const BufferId filled = fill.touch_write(graph.buffer("a", {.size_bytes = 64}), Access::transfer_write);
    fill.execute(fill_with(filled, 7));
    auto copy = graph.custom("copy");
    copy.touch(filled, Access::transfer_read);
    const BufferId copied = copy.touch_write(graph.buffer("b", {.size_bytes = 64}), Access::transfer_write);
    copy.execute([filled, copied](Recorder& recorder) {
        const VkBufferCopy region{.size = 64};
        vkCmdCopyBuffer(recorder.commands(), recorder.buffer(filled).handle(),
                        recorder.buffer(copied).handle(), 1, &region);
    });
    EXPECT_EQ(run_and_read_as<uint32_t>(graph, copied), std::vector<uint32_t>(16, 7U));
    EXPECT_TRUE(test::take_validation_messages().empty());
}

// Tests that validation is active: it must report a hazard inside one pass, which the graph cannot detect.
TEST(Execute, ValidationSeesAPlantedHazard)
{
    Graph graph;
    auto planted = graph.custom("planted");
    const BufferId from = planted.touch_write(graph.buffer("a", {.size_bytes = 64}), Access::transfer_write);
    const BufferId to = planted.touch_write(graph.buffer("b", {.size_bytes = 64}), Access::transfer_write);
    planted.execute([from, to](Recorder& recorder) {
        fill_with(from, 1)(recorder);
        const VkBufferCopy region{.size = 64};
        vkCmdCopyBuffer(recorder.commands(), recorder.buffer(from).handle(), recorder.buffer(to).handle(), 1,
                        &region);
    });
    std::ignore = run_and_read_as<uint32_t>(graph, to);
    const std::vector<std::string> messages = test::take_validation_messages();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_NE(messages.front().find("READ_AFTER_WRITE"), std::string::npos) << messages.front();
}

TEST(Execute, TheGateFailsATestThatLeavesAMessage)
{
    const auto gate = [] {
        test::ValidationGate().OnTestEnd(*testing::UnitTest::GetInstance()->current_test_info());
    };
    test::validated().on_validation_message("planted");
    EXPECT_NONFATAL_FAILURE(gate(), "validation: planted");
    gate(); // The test has already consumed all messages
}

TEST(Execute, TimesEachPass)
{
    Executor executor(test::shared_device());
    Graph graph;
    Buffer target(test::shared_device(), "target", 64, MemoryUse::device);
    auto fill = graph.custom("fill");
    const BufferId filled =
        fill.touch_write(graph.import_buffer("target", target, {.size_bytes = 64}), Access::transfer_write);
    fill.execute(fill_with(filled, 1));
    executor.run(graph);
    ASSERT_EQ(executor.timings().size(), 1U);
    EXPECT_EQ(executor.timings().front().name, "fill");
    EXPECT_GE(executor.timings().front().gpu_ms, 0.0);
    executor.add_timings();
    executor.run(graph);
    executor.run(graph);
    EXPECT_EQ(executor.timings().size(), 2U);
    executor.replace_timings();
    executor.run(graph);
    EXPECT_EQ(executor.timings().size(), 1U);
}

TEST(Execute, TimesTheWholeWhenPassesAreNotTimed)
{
    Executor executor(test::shared_device());
    Graph graph;
    constexpr uint64_t size_bytes = 4 << 20;
    Buffer target(test::shared_device(), "target", size_bytes, MemoryUse::device);
    BufferId filled = graph.import_buffer("target", target, {.size_bytes = size_bytes});
    for (uint32_t i = 0; i < 3; ++i) {
        auto fill = graph.custom("fill");
        filled = fill.touch_write(filled, Access::transfer_write);
        fill.execute(fill_with(filled, i));
    }
    executor.run(graph);
    double sum_ms = 0.0;
    for (const PassTiming& pass : executor.timings()) {
        sum_ms += pass.gpu_ms;
    }
    EXPECT_DOUBLE_EQ(executor.gpu_ms(), sum_ms);
    executor.time_passes(false);
    executor.run(graph);
    EXPECT_GT(executor.gpu_ms(), 0.0);
    ASSERT_EQ(executor.timings().size(), 3U);
    for (const PassTiming& pass : executor.timings()) {
        EXPECT_EQ(pass.gpu_ms, 0.0);
    }
    executor.add_timings();
    executor.run(graph);
    EXPECT_GT(executor.gpu_ms(), 0.0);
    const double first_ms = executor.gpu_ms();
    executor.run(graph);
    EXPECT_GT(executor.gpu_ms(), first_ms);
    executor.replace_timings();
    executor.run(Graph());
    EXPECT_EQ(executor.gpu_ms(), 0.0);
}

/// Two graphs that run alternately keep their transient images and buffers.
TEST(Execute, KeepsTransientMemoryWhileOtherGraphsRun)
{
    Device& device = test::shared_device();
    Executor executor(device);
    const auto run = [&](uint64_t bytes) {
        Graph graph;
        Buffer target(device, "target", bytes, MemoryUse::device);
        auto fill = graph.custom("fill");
        const BufferId passed =
            fill.touch_write(graph.buffer("passed", {.size_bytes = bytes}), Access::transfer_write);
        fill.execute(fill_with(passed, 1));
        auto copy = graph.custom("copy");
        copy.touch(passed, Access::transfer_read);
        const BufferId copied = copy.touch_write(graph.import_buffer("target", target, {.size_bytes = bytes}),
                                                 Access::transfer_write);
        copy.execute(fill_with(copied, 2));
        executor.run(graph);
    };
    constexpr uint64_t mib = 1U << 20U;
    run(32 * mib);
    const uint64_t alone = device.memory().used_bytes();
    run(20 * mib);
    run(17 * mib);
    const uint64_t all = device.memory().used_bytes();
    EXPECT_EQ((all - alone) / mib, 37U);
    run(32 * mib);
    EXPECT_EQ(device.memory().used_bytes(), all) << "nothing was made anew";
    for (int i = 0; i < 10; ++i) {
        run(20 * mib);
    }
    EXPECT_EQ((all - device.memory().used_bytes()) / mib, 49U) << "what is long unused is given back";
}

TEST(Memory, ReusesWhatIsFreed)
{
    Device& device = test::shared_device();
    VkDeviceMemory first = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    const VkMemoryRequirements needs{.size = 4096, .alignment = 256, .memoryTypeBits = ~0U};
    const Allocation keep = device.memory().allocate(needs, MemoryUse::device, false);
    const Allocation a = device.memory().allocate(needs, MemoryUse::device, false);
    first = a.memory;
    offset = a.offset;
    EXPECT_EQ(a.offset % 256, 0U);
    device.memory().free(a);
    const Allocation b = device.memory().allocate(needs, MemoryUse::device, false);
    EXPECT_EQ(b.memory, first);
    EXPECT_EQ(b.offset, offset);
    device.memory().free(b);
    device.memory().free(keep);
}

TEST(Memory, NeverOverlapsAndAlwaysMerges)
{
    Device& device = test::shared_device();
    uint32_t random = 12345;
    const auto next = [&random] { return random = random * 1664525U + 1013904223U, random >> 8U; };
    std::vector<Allocation> held;
    for (int step = 0; step < 2000; ++step) {
        if (held.size() > 60 || (!held.empty() && next() % 3 == 0)) {
            const size_t victim = next() % held.size();
            device.memory().free(held[victim]);
            held.erase(held.begin() + static_cast<std::ptrdiff_t>(victim));
            continue;
        }
        const VkDeviceSize alignment = 16ULL << (next() % 6);
        const VkMemoryRequirements needs{
            .size = 1 + next() % 500000, .alignment = alignment, .memoryTypeBits = ~0U};
        held.push_back(device.memory().allocate(needs, MemoryUse::device, true));
        const Allocation& made = held.back();
        EXPECT_EQ(made.offset % alignment, 0U);
        for (size_t i = 0; i + 1 < held.size(); ++i) {
            const bool apart = held[i].memory != made.memory ||
                               held[i].offset + held[i].size <= made.offset ||
                               made.offset + made.size <= held[i].offset;
            ASSERT_TRUE(apart);
        }
    }
    for (const Allocation& allocation : held) {
        device.memory().free(allocation);
    }
}

} // namespace
} // namespace estampe::gpu
