// SPDX-License-Identifier: MIT
// Culling by cells and portals changes no pixel, and hidden rooms still cast shadows.
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "features/culling/culling.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// Two rooms behind each other along -z, with a ball of many triangles in each. A wall with a door between
/// them is drawn only if `has_wall`.
Scene two_rooms(bool has_wall)
{
    Scene scene = test::scene_of(shapes::plane(8.0F, 20.0F));
    const auto wall = [&](const glm::vec3& size, const glm::dvec3& place) {
        test::add_object(scene, shapes::box(size), glm::vec3(0.8F), place);
    };
    if (has_wall) {
        wall({3.5F, 3.0F, 0.2F}, {-2.25, 0.0, 0.0});
        wall({3.5F, 3.0F, 0.2F}, {2.25, 0.0, 0.0});
        wall({1.0F, 1.0F, 0.2F}, {0.0, 2.0, 0.0});
    }
    for (const double z : {3.0, -3.0}) {
        test::add_object(scene, shapes::sphere(0.8F, 160, 80), {0.9F, 0.3F, 0.2F}, {1.2, 0.9, z});
    }
    test::add_sun(scene, {0.3, 0.7, -1.0});
    scene.cells = {{"front", {-4, -1, 0}, {4, 3, 10}}, {"back", {-4, -1, -10}, {4, 3, 0}}};
    scene.portals = {
        {.corners_m = {{-0.5, -1, 0}, {0.5, -1, 0}, {0.5, 2, 0}, {-0.5, 2, 0}}, .from = 0, .to = 1}};
    return scene;
}

class CellCulling : public testing::TestWithParam<RasterPath> {
protected:
    CellCulling() : renderer_(options()) {}

    Image draw(const Scene& scene, bool culls, uint32_t samples = 1, uint32_t tile_px = 0)
    {
        Style style;
        style.set(culls ? "culling.cells=portals" : "culling.cells=off");
        style.set("paper.grain=0");
        renderer_.set_scene(scene);
        return renderer_.render({.eye = {0.2, 1.4, 7.0}, .target = {0.4, 1.0, 0.0}}, style,
                                {.width = 160, .height = 120, .samples = samples, .tile_px = tile_px});
    }

    Renderer renderer_;

private:
    static RendererOptions options()
    {
        RendererOptions options = test::validated();
        options.raster = GetParam();
        return options;
    }
};

TEST_P(CellCulling, ChangesNoPixel)
{
    const Scene scene = two_rooms(true);
    EXPECT_EQ(draw(scene, true), draw(scene, false));
    EXPECT_EQ(draw(scene, true, 3), draw(scene, false, 3)) << "samples see the rooms from shifted pages";
    EXPECT_EQ(draw(scene, true, 1, 64), draw(scene, false, 1, 64)) << "in tiles";
}

TEST_P(CellCulling, ChangesNoPixelOfBlurredMotion)
{
    // The eye passes the door sideways, so the balls are drawn out along the page.
    renderer_.set_scene(two_rooms(true));
    const auto draw_blurred = [&](const char* cells) {
        Style style;
        for (const char* const value : {"motion_blur.enabled=true", "motion_blur.mode=stretched",
                                        "motion_blur.shutter_deg=360", cells}) {
            style.set(value);
        }
        const Camera before{.eye = {-1.0, 1.4, 3.0}, .target = {-0.6, 1.0, 0.0}};
        const Camera after{.eye = {0.6, 1.4, 3.0}, .target = {1.0, 1.0, 0.0}};
        return renderer_.render(
            before, style,
            {.width = 160, .height = 120, .exposure_end = Moment{.camera = after, .time_s = 0.1}});
    };
    EXPECT_EQ(draw_blurred("culling.cells=portals"), draw_blurred("culling.cells=off"));
}

TEST_P(CellCulling, DrawsNothingOfARoomWithoutPortals)
{
    // Without the wall, the ball in the back room is visible, but no portal says so.
    const Scene open = two_rooms(false);
    Scene shut = open;
    shut.portals.clear();
    const Image whole = draw(open, false);
    const Image without = draw(shut, true);
    EXPECT_NE(without, whole) << "the ball in the back room is left out";
    // The sun shines from the back room into the front room.
    Scene bare = shut;
    bare.nodes[2].visible = false;
    EXPECT_NE(without, draw(bare, true)) << "and still throws its shadow";
}

TEST_P(CellCulling, FollowsTheScene)
{
    const Scene scene = two_rooms(true);
    const Image wanted = draw(scene, false);
    Scene other = two_rooms(false);
    other.portals.clear();
    static_cast<void>(draw(other, true));
    EXPECT_EQ(draw(scene, true), wanted) << "the clusters of another scene are forgotten";
}

TEST_P(CellCulling, TakesCellsFromNames)
{
    Scene named = two_rooms(false);
    named.portals.clear();
    const Image without = draw(named, true);
    for (const SceneCell& cell : std::exchange(named.cells, {})) {
        Node node{.name = "cell " + cell.name};
        node.transform.translation = 0.5 * (cell.low_m + cell.high_m);
        node.transform.scale = 0.5 * (cell.high_m - cell.low_m);
        named.roots.push_back(static_cast<Index>(named.nodes.size()));
        named.nodes.push_back(node);
    }
    EXPECT_EQ(draw(named, true), without);
}

INSTANTIATE_TEST_SUITE_P(Paths, CellCulling, testing::Values(RasterPath::compute, RasterPath::hardware),
                         [](const auto& path) { return name_of(path.param); });

TEST(CullingNotes, SayThatASceneHasNoCells)
{
    Renderer& renderer = test::shared_renderer();
    Style style;
    style.set("culling.cells=portals");
    renderer.set_scene(test::scene_of(shapes::box(glm::vec3(1.0F))));
    static_cast<void>(renderer.render(test::corner_camera, style, {.width = 32, .height = 24}));
    const auto notes = renderer.notes();
    EXPECT_TRUE(std::ranges::any_of(
        notes, [](const std::string& note) { return note.find("no cells") != std::string::npos; }));
}

} // namespace
} // namespace estampe
