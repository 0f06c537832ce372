// SPDX-License-Identifier: MIT
#include "gpu/graph/graph.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "gpu/graph/graph_test_support.hpp"

namespace estampe::gpu {
namespace {

TEST(GraphTest, WritingGivesTheNextVersion)
{
    Graph graph;
    const ImageId before = graph.image("tone", small_image);
    auto pass = graph.compute("write", fake_shader);
    const ImageId after = pass.write(before);
    EXPECT_EQ(after.resource, before.resource);
    EXPECT_EQ(after.version, before.version + 1);
    EXPECT_EQ(graph.resources()[before.resource].newest_version, 1u);

    auto next = graph.compute("modify", fake_shader);
    EXPECT_EQ(next.modify(after).version, 2u);
}

TEST(GraphTest, DescribesWhatWasDeclared)
{
    Graph graph;
    const ImageId image = graph.image("a", {.width = 5, .height = 7, .format = Format::r16f, .layers = 3});
    const BufferId buffer = graph.buffer("b", {.size_bytes = 96});
    EXPECT_EQ(graph.describe(image),
              (ImageDesc{.width = 5, .height = 7, .format = Format::r16f, .layers = 3}));
    EXPECT_EQ(graph.describe(buffer).size_bytes, 96u);
}

TEST(GraphTest, ANewResourceMayBeDescribedAsAnotherOne)
{
    Graph graph;
    ImageId image = graph.image("first", {.width = 5, .height = 7, .format = Format::r16f, .layers = 3});
    BufferId buffer = graph.buffer("first", {.size_bytes = 96});
    for (int i = 0; i < 100; ++i) { // more than fit into the memory of an empty graph
        image = graph.image("next", graph.describe(image));
        buffer = graph.buffer("next", graph.describe(buffer));
        ASSERT_EQ(graph.describe(image).height, 7U) << i;
        ASSERT_EQ(graph.describe(image).layers, 3U) << i;
        ASSERT_EQ(graph.describe(buffer).size_bytes, 96U) << i;
    }
}

TEST(GraphTest, BindingsFollowTheOrderOfCalls)
{
    Graph graph;
    const ImageId a = graph.image("a", small_image);
    const BufferId b = graph.buffer("b", {.size_bytes = 4});
    const BufferId c = graph.buffer("c", {.size_bytes = 12});
    auto pass = graph.compute("p", fake_shader);
    pass.sample(a, Sampling::linear).uniform(b).dispatch_indirect(c, 8);

    const std::vector<Use>& uses = graph.passes()[0].uses;
    ASSERT_EQ(uses.size(), 3u);
    EXPECT_EQ(uses[0].access, Access::compute_sampled);
    EXPECT_EQ(uses[0].sampling, Sampling::linear);
    EXPECT_TRUE(uses[0].bound);
    EXPECT_EQ(uses[1].access, Access::compute_uniform);
    EXPECT_TRUE(uses[1].bound);
    EXPECT_EQ(uses[2].access, Access::indirect);
    EXPECT_FALSE(uses[2].bound);
    EXPECT_EQ(graph.passes()[0].dispatch.indirect_resource, c.resource);
    EXPECT_EQ(graph.passes()[0].dispatch.indirect_offset_bytes, 8u);
}

TEST(GraphTest, PushKeepsSizeAndBytes)
{
    struct Params {
        float tone;
        uint32_t levels;
        float spacing_px;
    };

    Graph graph;
    auto pass = graph.compute("p", fake_shader);
    pass.push(Params{.tone = 0.5f, .levels = 6, .spacing_px = 3.0f});
    const std::vector<std::byte>& bytes = graph.passes()[0].push;
    ASSERT_EQ(bytes.size(), sizeof(Params));
    Params back{};
    std::memcpy(&back, bytes.data(), sizeof back);
    EXPECT_EQ(back.levels, 6u);
    EXPECT_EQ(back.spacing_px, 3.0f);
}

template <class T>
concept Pushable = requires(Pass& pass, T constants)
{
    pass.push(constants);
};

struct Bytes128 {
    std::byte bytes[128];
};

struct Bytes129 {
    std::byte bytes[129];
};

static_assert(Pushable<Bytes128>);
static_assert(!Pushable<Bytes129>, "128 bytes are all that every device has");
static_assert(!Pushable<std::string>);
static_assert(!std::is_default_constructible_v<Pass>);

struct Inputs {
    ImageId light;
    BufferId frame;
};

template <class... Handles>
concept MakesInputs = requires(Handles... handles)
{
    Inputs{handles...};
};

static_assert(MakesInputs<ImageId, BufferId>);
static_assert(!MakesInputs<ImageId>, "a forgotten input does not compile");
static_assert(!MakesInputs<>);

TEST(GraphTest, DispatchOverRoundsUpToWholeGroups)
{
    Graph graph;
    graph.compute("exact", fake_shader).dispatch_over(64, 8);
    graph.compute("one more", fake_shader).dispatch_over(65, 9);
    graph.compute("small", fake_shader).dispatch_over(1, 7);
    graph.compute("nothing", fake_shader).dispatch_over(0, 0);
    graph.compute("largest", fake_shader).dispatch_over(UINT32_MAX, 1);
    const auto groups = [&](size_t i) {
        const Dispatch& d = graph.passes()[i].dispatch;
        return std::vector<uint32_t>{d.groups_x, d.groups_y, d.groups_z};
    };
    EXPECT_EQ(groups(0), (std::vector<uint32_t>{8, 1, 1}));
    EXPECT_EQ(groups(1), (std::vector<uint32_t>{9, 2, 1}));
    EXPECT_EQ(groups(2), (std::vector<uint32_t>{1, 1, 1}));
    EXPECT_EQ(groups(3), (std::vector<uint32_t>{0, 0, 1}));
    EXPECT_EQ(groups(4), (std::vector<uint32_t>{1u << 29, 1, 1}));
}

TEST(GraphTest, TouchRefusesTheWrongKindOfAccess)
{
    Graph graph;
    const ImageId image = graph.image("tone", small_image);
    const BufferId buffer = graph.buffer("args", {.size_bytes = 4});
    auto pass = graph.custom("copy");
    EXPECT_EQ(logic_error_of([&] { pass.touch(image, Access::transfer_write); }),
              "pass 'copy': transfer_write is a write: use touch_write");
    EXPECT_EQ(logic_error_of([&] { (void)pass.touch_write(buffer, Access::transfer_read); }),
              "pass 'copy': transfer_read is a read: use touch");
    EXPECT_EQ(logic_error_of([&] { pass.touch(image, Access::indirect); }),
              "pass 'copy': 'tone' is an image, which has no access indirect");
    EXPECT_EQ(logic_error_of([&] { (void)pass.touch_write(buffer, Access::color_attachment); }),
              "pass 'copy': 'args' is a buffer, which has no access color_attachment");
}

TEST(GraphTest, HandlesOfAnotherGraphAreRefused)
{
    Graph graph;
    Graph other;
    const BufferId buffer = graph.buffer("points", {.size_bytes = 4});
    const ImageId foreign = other.image("tone", small_image);
    auto pass = graph.compute("p", fake_shader);
    EXPECT_NE(logic_error_of([&] { pass.sample(foreign); }).find("'p': "), std::string::npos);
    EXPECT_NE(logic_error_of([&] { pass.read(BufferId{7, 0}); }).find("resource 7"), std::string::npos);
    EXPECT_NE(logic_error_of([&] { (void)other.describe(buffer); }).find("'tone'"), std::string::npos);
}

TEST(GraphTest, OnlyTheNewestVersionIsExported)
{
    Graph graph;
    const ImageId first = graph.compute("a", fake_shader).write(graph.image("tone", small_image));
    const ImageId second = graph.compute("b", fake_shader).modify(first);
    EXPECT_NE(logic_error_of([&] { graph.export_image(first); }).find("'tone'"), std::string::npos);
    EXPECT_FALSE(graph.resources()[first.resource].exported);
    graph.export_image(second);
    EXPECT_TRUE(graph.resources()[first.resource].exported);
}

TEST(GraphTest, CustomPassesKeepTheirRecorder)
{
    Graph graph;
    auto pass = graph.custom("clear");
    pass.keep().execute([](Recorder&) {});
    EXPECT_TRUE(graph.passes()[0].has_side_effect);
    EXPECT_TRUE(static_cast<bool>(graph.passes()[0].record));
    EXPECT_EQ(graph.passes()[0].shader, nullptr);
}

TEST(Graph, ForgetsAllThatWasDeclaredWhenItIsCleared)
{
    const Shader shader{"shader", {}};
    Graph graph;
    auto old = graph.compute("a name that does not fit into the string itself", shader);
    static_cast<void>(old.write(graph.image("old", {.width = 4, .height = 4})));
    old.keep().variant(7).push(uint32_t{5});
    graph.custom("records").execute([](Recorder&) {});
    graph.clear();
    EXPECT_TRUE(graph.passes().empty());
    EXPECT_TRUE(graph.resources().empty());
    graph.raster("new", shader).draw(3);
    static_cast<void>(graph.custom("too"));
    const BufferId list = graph.buffer("list", {.size_bytes = 8});
    EXPECT_EQ(list, BufferId(0, 0));
    ASSERT_EQ(graph.passes().size(), 2U);
    const PassRecord& pass = graph.passes()[0];
    EXPECT_EQ(pass.name, "new");
    EXPECT_EQ(pass.shader, nullptr);
    EXPECT_TRUE(pass.is_raster());
    EXPECT_TRUE(pass.uses.empty());
    EXPECT_TRUE(pass.push.empty());
    EXPECT_EQ(pass.variant, 0U);
    EXPECT_FALSE(pass.has_side_effect);
    EXPECT_FALSE(static_cast<bool>(graph.passes()[1].record));
    EXPECT_FALSE(graph.resources()[0].is_image);
    EXPECT_EQ(graph.resources()[0].newest_version, 0U);
}

TEST(Graph, RecordingsAreCopiedWithWhatTheyHoldOnTo)
{
    const auto held = std::make_shared<int>(3);
    Recording first = [held](Recorder&) {};
    EXPECT_EQ(held.use_count(), 2);
    {
        Recording second = first;
        EXPECT_EQ(held.use_count(), 3);
        Recording third;
        third = second;
        EXPECT_EQ(held.use_count(), 4);
        second.clear();
        EXPECT_FALSE(static_cast<bool>(second));
        EXPECT_EQ(held.use_count(), 3);
    }
    EXPECT_EQ(held.use_count(), 2);
    first.clear();
    EXPECT_EQ(held.use_count(), 1);
}

TEST(Graph, NamesAreCutWhereTheyAreTooLong)
{
    const Name name = Name("page") + "/" + std::string("part");
    EXPECT_EQ(name.view(), "page/part");
    EXPECT_EQ((Name(std::string(100, 'a')) + std::string(100, 'b')).view(),
              std::string(100, 'a') + std::string(19, 'b'));
}

} // namespace
} // namespace estampe::gpu
