// SPDX-License-Identifier: MIT
// Tests raster passes without a device: their declarations, the barriers for attachments, and errors for
// misuse.
#include <gtest/gtest.h>

#include "gpu/graph/compile.hpp"
#include "gpu/graph/graph_test_support.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {
namespace {

using enum Access;

constexpr ImageDesc small_ids{.width = 32, .height = 16, .format = Format::r32ui};
constexpr ImageDesc small_depth{.width = 32, .height = 16, .format = Format::depth32f};
constexpr Shader vertex_shader{"fake.vert", {}};
constexpr Shader fragment_shader{"fake.frag", {}};

struct RasterFrame {
    Graph graph;
    BufferId points;
    ImageId ids;
    ImageId depth;

    RasterFrame()
        : points(graph.compute("points", fake_shader).write(graph.buffer("points", small_buffer))),
          ids(graph.image("ids", small_ids)), depth(graph.image("depth", small_depth))
    {
    }

    /// Adds a raster pass that draws `points` into `ids` and `depth`.
    void draw(const char* name)
    {
        auto pass = graph.raster(name, vertex_shader, fragment_shader);
        pass.read(points);
        ids = pass.color(ids);
        depth = pass.depth(depth);
        pass.draw(3);
    }

    void show(const char* name, ImageId image) { graph.compute(name, fake_shader).sample(image).keep(); }

    [[nodiscard]] Barriers before(const char* pass) const { return barriers_of(graph, compile(graph), pass); }
};

TEST(RasterPassTest, TheFirstClearsAndTheNextDrawsOver)
{
    RasterFrame frame;
    frame.draw("first");
    frame.draw("next");
    frame.show("show", frame.ids);
    EXPECT_EQ(frame.before("first"),
              (Barriers{{.resource = 0, .before = compute_storage_write, .after = raster_storage_read},
                        {.resource = 1, .after = color_attachment, .new_layout = Layout::color},
                        {.resource = 2, .after = depth_attachment, .new_layout = Layout::depth}}));
    EXPECT_EQ(frame.before("next"), (Barriers{{.resource = 1,
                                               .before = color_attachment,
                                               .after = color_attachment_modify,
                                               .old_layout = Layout::color,
                                               .new_layout = Layout::color},
                                              {.resource = 2,
                                               .before = depth_attachment,
                                               .after = depth_attachment,
                                               .old_layout = Layout::depth,
                                               .new_layout = Layout::depth}}));
    EXPECT_EQ(frame.before("show"), (Barriers{{.resource = 1,
                                               .before = color_attachment_modify,
                                               .after = compute_sampled,
                                               .old_layout = Layout::color,
                                               .new_layout = Layout::shader_read}}));
}

TEST(RasterPassTest, DrawingGoesOnAfterAReadInBetween)
{
    RasterFrame frame;
    frame.draw("first");
    frame.show("look", frame.ids);
    frame.graph.custom("copy").keep().touch(frame.depth, transfer_read);
    frame.draw("next");
    frame.show("show", frame.ids);
    EXPECT_EQ(frame.before("next"), (Barriers{{.resource = 1,
                                               .before = compute_sampled,
                                               .after = color_attachment_modify,
                                               .old_layout = Layout::shader_read,
                                               .new_layout = Layout::color},
                                              {.resource = 2,
                                               .before = transfer_read,
                                               .after = depth_attachment,
                                               .old_layout = Layout::transfer_source,
                                               .new_layout = Layout::depth}}));
}

TEST(RasterPassTest, WritersWaitForItsReads)
{
    RasterFrame frame;
    const ImageId tone =
        frame.graph.compute("tone", fake_shader).write(frame.graph.image("tone", small_image));
    auto pass = frame.graph.raster("draw", vertex_shader, fragment_shader);
    pass.read(frame.points).sample(tone).keep();
    (void)frame.graph.compute("points again", fake_shader).keep().modify(frame.points);
    EXPECT_EQ(frame.before("draw"),
              (Barriers{{.resource = 0, .before = compute_storage_write, .after = raster_storage_read},
                        {.resource = tone.resource,
                         .before = compute_storage_write,
                         .after = raster_sampled,
                         .old_layout = Layout::general,
                         .new_layout = Layout::shader_read}}));
    EXPECT_EQ(frame.before("points again"),
              (Barriers{{.resource = 0, .before = raster_storage_read, .after = compute_storage_modify}}));
}

TEST(RasterPassTest, ComputeAndRasterReadersWaitEachForThemselves)
{
    RasterFrame frame;
    frame.graph.compute("compute", fake_shader).read(frame.points).keep();
    frame.graph.raster("draw", vertex_shader).read(frame.points).keep();
    frame.graph.raster("draw again", vertex_shader).read(frame.points).keep();
    EXPECT_EQ(frame.before("draw"),
              (Barriers{{.resource = 0, .before = compute_storage_write, .after = raster_storage_read}}));
    EXPECT_EQ(frame.before("draw again"), Barriers{});
}

TEST(RasterPassTest, TheNextHolderOfAnAttachmentWaitsForItAndStartsUndefined)
{
    RasterFrame frame;
    frame.draw("first");
    frame.show("show", frame.ids);
    auto pass = frame.graph.raster("reuse", vertex_shader);
    const ImageId next = pass.depth(frame.graph.image("next", small_depth));
    pass.keep();
    EXPECT_EQ(frame.before("reuse"), (Barriers{{.resource = next.resource,
                                                .before = depth_attachment,
                                                .after = depth_attachment,
                                                .old_layout = Layout::undefined,
                                                .new_layout = Layout::depth}}));
}

TEST(RasterPassTest, ImportedImagesAreDrawnOver)
{
    Graph graph;
    const ImageId page = graph.import_image("page", fake_image(), small_image, Layout::shader_read);
    auto pass = graph.raster("draw", vertex_shader, fragment_shader);
    (void)pass.color(page);
    EXPECT_EQ(barriers_of(graph, compile(graph), "draw"), (Barriers{{.resource = 0,
                                                                     .after = color_attachment_modify,
                                                                     .old_layout = Layout::shader_read,
                                                                     .new_layout = Layout::color}}));
}

TEST(RasterPassTest, WhatIsDrawnOverIsKeptAndWhatNobodySeesIsNot)
{
    RasterFrame seen;
    seen.draw("under");
    seen.draw("over");
    seen.show("show", seen.depth);
    EXPECT_EQ(kept_names(seen.graph, compile(seen.graph)),
              (std::vector<std::string>{"points", "under", "over", "show"}));
    RasterFrame unseen;
    unseen.draw("under");
    unseen.draw("over");
    EXPECT_TRUE(compile(unseen.graph).passes.empty());
}

TEST(RasterPassTest, StagesAndMasksOfItsAccesses)
{
    constexpr VkPipelineStageFlags2 shaders =
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    for (const Access access : {raster_sampled, raster_storage_read, raster_uniform}) {
        EXPECT_EQ(stage_access(access).stage, shaders) << name_of(access);
        EXPECT_FALSE(is_write(access)) << name_of(access);
    }
    EXPECT_EQ(stage_access(raster_sampled).access, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
    EXPECT_EQ(stage_access(raster_storage_read).access, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    EXPECT_EQ(stage_access(raster_uniform).access, VK_ACCESS_2_UNIFORM_READ_BIT);

    const StageAccess over = stage_access(color_attachment_modify);
    EXPECT_EQ(over.stage, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
    EXPECT_EQ(over.access, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
    EXPECT_TRUE(is_write(color_attachment_modify) && is_read(color_attachment_modify));
    const StageAccess depth = stage_access(depth_attachment);
    EXPECT_EQ(depth.stage,
              VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT);
    EXPECT_EQ(depth.access,
              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
    EXPECT_EQ(vulkan_layout(Layout::depth), VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    EXPECT_EQ(layout_for(color_attachment_modify), Layout::color);
    EXPECT_EQ(layout_for(raster_sampled), Layout::shader_read);
    EXPECT_EQ(layout_for(raster_storage_read), Layout::general);
}

TEST(RasterPassTest, MisuseNamesPassAndResource)
{
    RasterFrame frame;
    auto raster = frame.graph.raster("draw", vertex_shader, fragment_shader);
    EXPECT_EQ(logic_error_of([&] { (void)raster.write(frame.ids); }),
              "pass 'draw': a raster pass writes attachments only: use color or depth for 'ids'");
    EXPECT_EQ(logic_error_of([&] { (void)raster.modify(frame.points); }),
              "pass 'draw': a raster pass writes attachments only: use color or depth for 'points'");
    EXPECT_EQ(logic_error_of([&] { (void)raster.depth(frame.ids); }), "pass 'draw': 'ids' is no depth image");
    EXPECT_EQ(logic_error_of([&] { (void)raster.color(frame.depth); }),
              "pass 'draw': 'depth' is no colour image");
    auto compute = frame.graph.compute("shade", fake_shader);
    EXPECT_EQ(logic_error_of([&] { (void)compute.color(frame.ids); }),
              "pass 'shade': color is for raster passes");
    EXPECT_EQ(logic_error_of([&] { compute.draw(3); }), "pass 'shade': drawing is for raster passes");
}

TEST(RasterPassTest, HasItsPlaceInThePicture)
{
    RasterFrame frame;
    frame.draw("draw helmet");
    frame.show("show", frame.ids);
    const std::string dot = to_dot(frame.graph, compile(frame.graph));
    EXPECT_NE(dot.find("label=\"draw helmet\\n3 barriers\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("label=\"color_attachment\""), std::string::npos) << dot;
    EXPECT_NE(dot.find("label=\"raster_storage_read\""), std::string::npos) << dot;
}

} // namespace
} // namespace estampe::gpu
