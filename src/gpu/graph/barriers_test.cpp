// SPDX-License-Identifier: MIT
// Tests the exact barrier lists for every kind of hazard, and the errors for handles that are used in the
// wrong order.
#include <gtest/gtest.h>

#include "gpu/graph/compile.hpp"
#include "gpu/graph/graph_test_support.hpp"

namespace estampe::gpu {
namespace {

using enum Access;

struct Frame {
    Graph graph;
    BufferId buffer = graph.buffer("points", small_buffer);
    ImageId image = graph.image("tone", small_image);

    void read(const char* pass, Access access) { graph.custom(pass).touch(buffer, access).keep(); }

    void read_image(const char* pass, Access access) { graph.custom(pass).touch(image, access).keep(); }

    void write(const char* pass, Access access)
    {
        buffer = graph.custom(pass).keep().touch_write(buffer, access);
    }

    void write_image(const char* pass, Access access)
    {
        image = graph.custom(pass).keep().touch_write(image, access);
    }

    [[nodiscard]] Barriers before(const char* pass) const { return barriers_of(graph, compile(graph), pass); }

    [[nodiscard]] Barrier between(AccessSet earlier, AccessSet later) const
    {
        return {.resource = buffer.resource, .before = earlier, .after = later};
    }

    [[nodiscard]] Barrier between(AccessSet earlier, AccessSet later, Layout from, Layout to) const
    {
        return {.resource = image.resource,
                .before = earlier,
                .after = later,
                .old_layout = from,
                .new_layout = to};
    }
};

TEST(BarrierTest, TheFirstUseOfABufferNeedsNone)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    EXPECT_EQ(frame.before("w"), Barriers{});
}

TEST(BarrierTest, ReadAfterWrite)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    frame.read("r", compute_storage_read);
    EXPECT_EQ(frame.before("r"), Barriers{frame.between(compute_storage_write, compute_storage_read)});
}

TEST(BarrierTest, EveryKindOfReaderWaitsForTheWriteOnce)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    frame.read("r", compute_storage_read);
    frame.read("indirect", indirect);
    frame.read("copy", transfer_read);
    frame.read("r again", compute_storage_read);
    frame.read("indirect again", indirect);
    EXPECT_EQ(frame.before("indirect"), Barriers{frame.between(compute_storage_write, indirect)});
    EXPECT_EQ(frame.before("copy"), Barriers{frame.between(compute_storage_write, transfer_read)});
    EXPECT_EQ(frame.before("r again"), Barriers{});
    EXPECT_EQ(frame.before("indirect again"), Barriers{});
}

TEST(BarrierTest, WriteAfterReadCoversEveryReader)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    frame.read("r", compute_uniform);
    frame.read("indirect", indirect);
    frame.read("copy", transfer_read);
    frame.write("w again", compute_storage_write);
    EXPECT_EQ(frame.before("w again"),
              Barriers{frame.between(compute_uniform | indirect | transfer_read, compute_storage_write)});
}

TEST(BarrierTest, ReadersBeforeTheLastWriteAreForgotten)
{
    Frame frame;
    frame.write("1", transfer_write);
    frame.read("r", indirect);
    frame.write("2", transfer_write);
    frame.write("3", transfer_write);
    EXPECT_EQ(frame.before("3"), Barriers{frame.between(transfer_write, transfer_write)});
}

TEST(BarrierTest, WriteAfterWrite)
{
    Frame frame;
    frame.write("clear", transfer_write);
    frame.write("w", compute_storage_write);
    EXPECT_EQ(frame.before("w"), Barriers{frame.between(transfer_write, compute_storage_write)});
}

TEST(BarrierTest, ModifyAfterModify)
{
    Frame frame;
    frame.write("clear", transfer_write);
    frame.write("1", compute_storage_modify);
    frame.write("2", compute_storage_modify);
    EXPECT_EQ(frame.before("1"), Barriers{frame.between(transfer_write, compute_storage_modify)});
    EXPECT_EQ(frame.before("2"), Barriers{frame.between(compute_storage_modify, compute_storage_modify)});
}

TEST(BarrierTest, TwoReadsInOnePassShareABarrier)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    auto pass = frame.graph.compute("r", fake_shader);
    pass.read(frame.buffer).keep().dispatch_indirect(frame.buffer);
    frame.write("w again", transfer_write);
    EXPECT_EQ(frame.before("r"),
              Barriers{frame.between(compute_storage_write, compute_storage_read | indirect)});
    EXPECT_EQ(frame.before("w again"),
              Barriers{frame.between(compute_storage_read | indirect, transfer_write)});
}

TEST(BarrierTest, AnImageStartsUndefinedAndChangesLayout)
{
    Frame frame;
    frame.write_image("w", compute_storage_write);
    frame.read_image("s", compute_sampled);
    frame.read_image("s again", compute_sampled);
    frame.read_image("copy", transfer_read);
    frame.read_image("s at last", compute_sampled);
    EXPECT_EQ(frame.before("w"),
              Barriers{frame.between({}, compute_storage_write, Layout::undefined, Layout::general)});
    EXPECT_TRUE(frame.before("w")[0].first_use());
    EXPECT_EQ(frame.before("s"), Barriers{frame.between(compute_storage_write, compute_sampled,
                                                        Layout::general, Layout::shader_read)});
    EXPECT_EQ(frame.before("s again"), Barriers{});
    // A layout change counts as a write. Therefore the change waits for the passes that read in the old
    // layout.
    EXPECT_EQ(frame.before("copy"), Barriers{frame.between(compute_sampled, transfer_read,
                                                           Layout::shader_read, Layout::transfer_source)});
    EXPECT_EQ(frame.before("s at last"),
              Barriers{frame.between(transfer_read, compute_sampled, Layout::transfer_source,
                                     Layout::shader_read)});
    EXPECT_EQ(compile(frame.graph).final_layout[frame.image.resource], Layout::shader_read);
}

TEST(BarrierTest, ReadThenModifyInOneLayout)
{
    Frame frame;
    frame.write_image("clear", transfer_write);
    frame.read_image("r", compute_storage_read);
    frame.read_image("r again", compute_storage_read);
    frame.write_image("m", compute_storage_modify);
    frame.write_image("m again", compute_storage_modify);
    EXPECT_EQ(frame.before("r"), Barriers{frame.between(transfer_write, compute_storage_read,
                                                        Layout::transfer_target, Layout::general)});
    EXPECT_EQ(frame.before("r again"), Barriers{});
    EXPECT_EQ(frame.before("m"), Barriers{frame.between(compute_storage_read, compute_storage_modify,
                                                        Layout::general, Layout::general)});
    EXPECT_EQ(frame.before("m again"), Barriers{frame.between(compute_storage_modify, compute_storage_modify,
                                                              Layout::general, Layout::general)});
}

TEST(BarrierTest, AttachmentsThenSampling)
{
    Frame frame;
    const ImageId depth_image =
        frame.graph.image("depth", {.width = 32, .height = 16, .format = Format::depth32f});
    auto raster = frame.graph.custom("raster");
    frame.image = raster.touch_write(frame.image, color_attachment);
    const ImageId depth = raster.touch_write(depth_image, depth_attachment);
    frame.graph.compute("resolve", fake_shader).sample(depth).sample(frame.image).keep();
    EXPECT_EQ(frame.before("raster"),
              (Barriers{{.resource = 1, .after = color_attachment, .new_layout = Layout::color},
                        {.resource = 2, .after = depth_attachment, .new_layout = Layout::depth}}));
    EXPECT_EQ(frame.before("resolve"), (Barriers{{.resource = 2,
                                                  .before = depth_attachment,
                                                  .after = compute_sampled,
                                                  .old_layout = Layout::depth,
                                                  .new_layout = Layout::shader_read},
                                                 {.resource = 1,
                                                  .before = color_attachment,
                                                  .after = compute_sampled,
                                                  .old_layout = Layout::color,
                                                  .new_layout = Layout::shader_read}}));
}

TEST(BarrierTest, TheNextHolderOfASlotWaitsForTheLast)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    frame.read("r", compute_storage_read);
    frame.read("indirect", indirect);
    const BufferId next = frame.graph.buffer("next", small_buffer);
    (void)frame.graph.custom("reuse").keep().touch_write(next, transfer_write);
    EXPECT_EQ(frame.before("reuse"), (Barriers{{.resource = next.resource,
                                                .before = compute_storage_read | indirect,
                                                .after = transfer_write}}));
}

TEST(BarrierTest, TheNextHolderOfAnImageSlotStartsUndefined)
{
    Frame frame;
    // No pass reads the image "w", so the next access waits for the write itself.
    frame.write_image("w", compute_storage_write);
    const ImageId next = frame.graph.image("next", small_image);
    (void)frame.graph.custom("reuse").keep().touch_write(next, compute_storage_write);
    EXPECT_EQ(frame.before("reuse"), (Barriers{{.resource = next.resource,
                                                .before = compute_storage_write,
                                                .after = compute_storage_write,
                                                .old_layout = Layout::undefined,
                                                .new_layout = Layout::general}}));
}

TEST(BarrierTest, ImportedImagesStartFromTheirLayout)
{
    Graph graph;
    const ImageId albedo = graph.import_image("albedo", fake_image(), small_image, Layout::shader_read);
    const ImageId target = graph.import_image("target", fake_image(1), small_image, Layout::shader_read);
    graph.compute("r", fake_shader).sample(albedo).keep();
    auto pass = graph.compute("w", fake_shader);
    pass.sample(albedo);
    (void)pass.write(target);
    (void)graph.custom("overwrite").touch_write(albedo, transfer_write);
    const CompiledGraph compiled = compile(graph);
    // The one barrier is recorded before both passes, so that these passes may overlap.
    EXPECT_EQ(barriers_of(graph, compiled, "r"), (Barriers{{.resource = target.resource,
                                                            .after = compute_storage_write,
                                                            .old_layout = Layout::shader_read,
                                                            .new_layout = Layout::general}}));
    EXPECT_EQ(barriers_of(graph, compiled, "w"), Barriers{});
    EXPECT_EQ(barriers_of(graph, compiled, "overwrite"), (Barriers{{.resource = albedo.resource,
                                                                    .before = compute_sampled,
                                                                    .after = transfer_write,
                                                                    .old_layout = Layout::shader_read,
                                                                    .new_layout = Layout::transfer_target}}));
}

TEST(BarrierTest, WhatIsImportedTwiceIsOneResource)
{
    Graph graph;
    const BufferId points = graph.import_buffer("points", fake_buffer(), small_buffer);
    const BufferId again = graph.import_buffer("points again", fake_buffer(), small_buffer);
    EXPECT_EQ(again, points);
    const ImageId tone = graph.import_image("tone", fake_image(), small_image, Layout::general);
    EXPECT_EQ(graph.import_image("tone again", fake_image(), small_image, Layout::general), tone);

    graph.compute("r", fake_shader).read(again).keep();
    (void)graph.compute("w", fake_shader).write(points);
    EXPECT_EQ(barriers_of(graph, compile(graph), "w"), (Barriers{{.resource = points.resource,
                                                                  .before = compute_storage_read,
                                                                  .after = compute_storage_write}}));
}

TEST(BarrierTest, TheHostWaitsForTheCopy)
{
    Frame frame;
    frame.write("copy", transfer_write);
    frame.graph.export_buffer(frame.buffer);
    frame.graph.custom("read back").touch(frame.buffer, host_read);
    EXPECT_EQ(frame.before("read back"), Barriers{frame.between(transfer_write, host_read)});
}

TEST(BarrierTest, EachAccessHasItsLayout)
{
    EXPECT_EQ(layout_for(compute_sampled), Layout::shader_read);
    EXPECT_EQ(layout_for(compute_storage_read), Layout::general);
    EXPECT_EQ(layout_for(compute_storage_write), Layout::general);
    EXPECT_EQ(layout_for(compute_storage_modify), Layout::general);
    EXPECT_EQ(layout_for(transfer_read), Layout::transfer_source);
    EXPECT_EQ(layout_for(transfer_write), Layout::transfer_target);
    EXPECT_EQ(layout_for(color_attachment), Layout::color);
    EXPECT_EQ(layout_for(depth_attachment), Layout::depth);
}

TEST(HandleTest, AStaleReadNamesPassResourceAndWriter)
{
    Frame frame;
    frame.write("first", compute_storage_write);
    const BufferId stale = frame.buffer;
    frame.write("second", compute_storage_modify);
    frame.graph.compute("late", fake_shader).read(stale);
    EXPECT_EQ(logic_error_of([&] { (void)compile(frame.graph); }),
              "pass 'late' reads a version of 'points' that pass 'second' has overwritten");
}

TEST(HandleTest, AReadDeclaredBeforeTheOverwriteIsFine)
{
    Frame frame;
    frame.write("first", compute_storage_write);
    auto early = frame.graph.compute("early", fake_shader);
    const BufferId old = frame.buffer;
    frame.write("second", compute_storage_modify);
    early.read(old).keep();
    EXPECT_EQ(frame.before("second"), Barriers{frame.between(compute_storage_read, compute_storage_modify)});
}

TEST(HandleTest, TwoWritersOfOneVersionClash)
{
    Frame frame;
    (void)frame.graph.compute("a", fake_shader).write(frame.buffer);
    (void)frame.graph.compute("b", fake_shader).write(frame.buffer);
    EXPECT_EQ(logic_error_of([&] { (void)compile(frame.graph); }),
              "pass 'b' writes a version of 'points' that pass 'a' has overwritten");
}

TEST(HandleTest, AVersionFromTheFutureIsRefused)
{
    Frame frame;
    auto early = frame.graph.compute("early", fake_shader);
    frame.write("w", compute_storage_write);
    early.read(frame.buffer);
    EXPECT_EQ(logic_error_of([&] { (void)compile(frame.graph); }),
              "pass 'early' reads a version of 'points' that is written only by a later pass");
}

TEST(HandleTest, WhatWasWrittenIsNotImportedAgain)
{
    Graph graph;
    const BufferId points = graph.import_buffer("points", fake_buffer(), small_buffer);
    (void)graph.compute("w", fake_shader).write(points);
    EXPECT_EQ(logic_error_of([&] { (void)graph.import_buffer("more points", fake_buffer(), small_buffer); }),
              "'points' is imported again, as 'more points', after a pass has written it: use that pass's "
              "handle");
}

TEST(HandleTest, WhatIsImportedAgainIsDescribedAlike)
{
    Graph graph;
    (void)graph.import_buffer("points", fake_buffer(), small_buffer);
    EXPECT_EQ(logic_error_of([&] { (void)graph.import_buffer("a", fake_buffer(), {.size_bytes = 4}); }),
              "'points' is imported again, as 'a', but described otherwise");
    (void)graph.import_image("tone", fake_image(), small_image, Layout::general);
    EXPECT_EQ(logic_error_of(
                  [&] { (void)graph.import_image("b", fake_image(), small_image, Layout::shader_read); }),
              "'tone' is imported again, as 'b', but described otherwise");
}

TEST(HandleTest, WhatWasNeverWrittenCannotBeRead)
{
    Frame read;
    read.read("r", compute_storage_read);
    EXPECT_EQ(logic_error_of([&] { (void)compile(read.graph); }),
              "pass 'r' reads 'points', which no pass has written");
    Frame modified;
    modified.write_image("m", compute_storage_modify);
    EXPECT_EQ(logic_error_of([&] { (void)compile(modified.graph); }),
              "pass 'm' reads 'tone', which no pass has written");
    Frame exported;
    exported.graph.export_image(exported.image);
    EXPECT_EQ(logic_error_of([&] { (void)compile(exported.graph); }),
              "'tone' is exported, but no pass writes it");
}

TEST(HandleTest, OnePassCannotReadAndWriteOneResource)
{
    Frame frame;
    frame.write("w", compute_storage_write);
    auto pass = frame.graph.compute("both", fake_shader);
    pass.read(frame.buffer);
    (void)pass.write(frame.buffer);
    EXPECT_NE(logic_error_of([&] { (void)compile(frame.graph); }).find("pass 'both' binds 'points' twice"),
              std::string::npos);

    Frame layouts;
    layouts.write_image("w", compute_storage_write);
    layouts.graph.compute("both", fake_shader).sample(layouts.image).read(layouts.image);
    EXPECT_NE(logic_error_of([&] { (void)compile(layouts.graph); }).find("pass 'both' binds 'tone' twice"),
              std::string::npos);
}

TEST(HandleTest, WhatTheHostReadsStaysAsItIs)
{
    Frame frame;
    frame.write("copy", transfer_write);
    frame.graph.custom("read back").touch(frame.buffer, host_read);
    frame.write("late", transfer_write);
    EXPECT_EQ(
        logic_error_of([&] { (void)compile(frame.graph); }),
        "pass 'late' overwrites 'points', which pass 'read back' gives to the host to read after the frame");
}

} // namespace
} // namespace estampe::gpu
