// SPDX-License-Identifier: MIT
#include "gpu/graph/compile.hpp"

#include <gtest/gtest.h>

#include "gpu/graph/graph_test_support.hpp"

namespace estampe::gpu {
namespace {

ImageId made_image(Graph& graph, const std::string& name, const ImageDesc& desc = small_image)
{
    return graph.compute("make " + name, fake_shader).write(graph.image(name, desc));
}

/// Adds a pass that reads `image` and is never culled.
void show(Graph& graph, const std::string& name, ImageId image)
{
    graph.compute(name, fake_shader).sample(image).keep();
}

/// Like made_image(), but the pass has a side effect, so it stays after earlier passes with side effects.
ImageId made_after(Graph& graph, const std::string& name, ImageDesc desc = small_image)
{
    return graph.compute("make " + name, fake_shader).keep().write(graph.image(name, desc));
}

TEST(CompileTest, WithinALevelOrderIsThatOfDeclaration)
{
    Graph graph;
    const ImageId a = made_image(graph, "a");
    const ImageId b = made_image(graph, "b");
    graph.compute("join", fake_shader).sample(b).sample(a).keep();
    EXPECT_EQ(kept_names(graph, compile(graph)), (Names{"make a", "make b", "join"}));
}

TEST(CompileTest, AnEmptyGraphCompiles)
{
    const CompiledGraph compiled = compile(Graph());
    EXPECT_TRUE(compiled.passes.empty());
    EXPECT_TRUE(compiled.slots.empty());
}

TEST(CullingTest, AChainNobodyReadsGoesAsAWhole)
{
    Graph graph;
    const ImageId a = made_image(graph, "a");
    auto next = graph.compute("next", fake_shader);
    next.sample(a);
    (void)next.write(graph.image("b", small_image));
    const CompiledGraph compiled = compile(graph);
    EXPECT_TRUE(compiled.passes.empty());
    EXPECT_EQ(compiled.slot_of_resource, (std::vector<uint32_t>{UINT32_MAX, UINT32_MAX}));
}

TEST(CullingTest, ASideEffectKeepsAllItStandsOn)
{
    Graph graph;
    const ImageId a = made_image(graph, "a");
    auto next = graph.compute("next", fake_shader);
    next.sample(a);
    const ImageId b = next.write(graph.image("b", small_image));
    (void)made_image(graph, "unwanted");
    show(graph, "show", b);
    EXPECT_EQ(kept_names(graph, compile(graph)), (Names{"make a", "next", "show"}));
}

TEST(CullingTest, OneArmOfADiamondIsEnough)
{
    Graph graph;
    const ImageId top = made_image(graph, "top");
    std::vector<ImageId> arms;
    for (const char* name : {"left", "right"}) {
        auto pass = graph.compute(name, fake_shader);
        pass.sample(top);
        arms.push_back(pass.write(graph.image(name, small_image)));
    }
    auto bottom = graph.compute("bottom", fake_shader);
    bottom.sample(arms[0]).sample(arms[1]);
    graph.export_image(bottom.write(graph.image("bottom", small_image)));
    EXPECT_EQ(kept_names(graph, compile(graph)), (Names{"make top", "left", "right", "bottom"}));

    Graph half;
    const ImageId again = made_image(half, "top");
    half.compute("left", fake_shader).sample(again).keep();
    auto right = half.compute("right", fake_shader);
    right.sample(again);
    (void)right.write(half.image("right", small_image));
    EXPECT_EQ(kept_names(half, compile(half)), (Names{"make top", "left"}));
}

TEST(CullingTest, AnOverwriteCutsTheChainAndAModificationDoesNot)
{
    for (const bool modifies : {false, true}) {
        Graph graph;
        const ImageId first = made_image(graph, "a");
        auto second = graph.compute("second", fake_shader);
        show(graph, "show", modifies ? second.modify(first) : second.write(first));
        const Names expected = modifies ? Names{"make a", "second", "show"} : Names{"second", "show"};
        EXPECT_EQ(kept_names(graph, compile(graph)), expected);
    }
}

TEST(CullingTest, AnUnreadModificationGoesWhileItsSourceStays)
{
    Graph graph;
    const ImageId first = made_image(graph, "a");
    show(graph, "show", first);
    (void)graph.compute("retouch", fake_shader).modify(first);
    EXPECT_EQ(kept_names(graph, compile(graph)), (Names{"make a", "show"}));
}

TEST(CullingTest, ImportedExportedAndHostReadAreWanted)
{
    Graph graph;
    const ImageId history = graph.import_image("history", fake_image(), small_image, Layout::general);
    (void)graph.compute("remember", fake_shader).write(history);
    graph.export_image(made_image(graph, "picture"));
    const BufferId count =
        graph.custom("count").touch_write(graph.buffer("count", {.size_bytes = 4}), Access::transfer_write);
    graph.custom("read back").touch(count, Access::host_read);
    EXPECT_EQ(kept_names(graph, compile(graph)), (Names{"remember", "make picture", "count", "read back"}));
}

TEST(CullingTest, CulledPassesLeaveNoBarriersAndNoLifetimes)
{
    Graph graph;
    const ImageId a = made_image(graph, "a");
    show(graph, "show a", a);
    const ImageId b = made_after(graph, "b");
    // If the pass "culled" were kept, it would extend the lifetime of `a` beyond the creation of `b`, and
    // change the layout of `a`.
    auto culled = graph.custom("culled");
    culled.touch(a, Access::transfer_read);
    (void)culled.touch_write(graph.image("c", small_image), Access::transfer_write);
    show(graph, "show b", b);
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.slots.size(), 1u);
    EXPECT_EQ(compiled.final_layout[a.resource], Layout::shader_read);
    EXPECT_EQ(compiled.final_layout[2], Layout::undefined);
    EXPECT_EQ(barriers_of(graph, compiled, "make b"),
              (std::vector<Barrier>{{.resource = b.resource,
                                     .before = Access::compute_sampled,
                                     .after = Access::compute_storage_write,
                                     .new_layout = Layout::general}}));
}

TEST(SlotTest, LifetimesThatTouchDoNotShareAndDisjointOnesDo)
{
    Graph graph;
    std::vector<ImageId> chain{made_image(graph, "0")};
    for (int i = 1; i < 4; ++i) {
        auto pass = graph.compute("step", fake_shader);
        pass.sample(chain.back());
        chain.push_back(pass.write(graph.image(std::to_string(i), small_image)));
    }
    show(graph, "show", chain.back());
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.slot_of_resource, (std::vector<uint32_t>{0, 1, 0, 1}));
    EXPECT_EQ(compiled.slots[0].accesses, Access::compute_sampled | Access::compute_storage_write);
}

TEST(SlotTest, DescriptionsMustBeEqual)
{
    const std::vector<ImageDesc> others{{.width = 33, .height = 16},
                                        {.width = 32, .height = 17},
                                        {.width = 32, .height = 16, .format = Format::r32f},
                                        {.width = 32, .height = 16, .layers = 2},
                                        {.width = 32, .height = 16, .mips = 2}};
    for (const ImageDesc& other : others) {
        Graph graph;
        show(graph, "show a", made_image(graph, "a"));
        show(graph, "show b", made_after(graph, "b", other));
        EXPECT_EQ(compile(graph).slots.size(), 2u);
    }
    for (const uint64_t size_bytes : {64u, 65u}) {
        Graph graph;
        for (const BufferDesc desc : {BufferDesc{64}, BufferDesc{size_bytes}}) {
            const BufferId buffer = graph.compute("w", fake_shader).keep().write(graph.buffer("b", desc));
            graph.compute("r", fake_shader).read(buffer).keep();
        }
        EXPECT_EQ(compile(graph).slots.size(), size_bytes == 64 ? 1u : 2u);
    }
}

TEST(SlotTest, ExportedAndHostReadMemoryIsNeverShared)
{
    Graph graph;
    show(graph, "show a", made_image(graph, "a"));
    const ImageId kept = made_image(graph, "b");
    graph.export_image(kept);
    show(graph, "show c", made_after(graph, "c"));
    EXPECT_EQ(compile(graph).slot_of_resource, (std::vector<uint32_t>{0, 1, 0}));

    Graph buffers;
    for (int i = 0; i < 2; ++i) {
        const BufferId buffer =
            buffers.compute("w", fake_shader).write(buffers.buffer("b", {.size_bytes = 4}));
        buffers.custom("host").touch(buffer, Access::host_read);
    }
    EXPECT_EQ(compile(buffers).slots.size(), 2u);
}

TEST(SlotTest, ImportedResourcesHaveNone)
{
    Graph graph;
    graph.compute("r", fake_shader).read(graph.import_buffer("b", fake_buffer(), {.size_bytes = 4})).keep();
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.slot_of_resource[0], UINT32_MAX);
    EXPECT_TRUE(compiled.slots.empty());
}

TEST(DotTest, NamesEverythingAndDashesWhatIsCulled)
{
    Graph graph;
    const ImageId a = made_image(graph, "tone \"raw\"");
    show(graph, "show", graph.compute("soften", fake_shader).modify(a));
    graph.compute("unread", fake_shader)
        .sample(graph.import_image("paper", fake_image(), small_image, Layout::general));
    const std::string dot = to_dot(graph, compile(graph));
    for (const char* text :
         {"digraph", "make tone \\\"raw\\\"", "tone \\\"raw\\\" v1", "v2", "show", "soften", "paper",
          "32 x 16", "slot 0", "p0 -> r0_1", "r0_1 -> p1", "p1 -> r0_2", "r0_2 -> p2"})
        EXPECT_NE(dot.find(text), std::string::npos) << text << " is not in\n" << dot;
    EXPECT_NE(dot.find("p3 [shape=box, style=dashed, label=\"unread\"]"), std::string::npos) << dot;
    EXPECT_EQ(dot.find("p0 [shape=box, style=dashed"), std::string::npos);
}

} // namespace
} // namespace estampe::gpu
