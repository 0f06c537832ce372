// SPDX-License-Identifier: MIT
// Compares many views drawn at once with the same views drawn one by one.
#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/raster/raster_test_support.hpp"
#include "techniques/raster/views/views.hpp"

namespace estampe::raster {
namespace {

constexpr uint32_t untouched = 0x5a5a5a5aU;

/// A room around the origin with bodies of large and tiny triangles, and a fence with holes.
Scene room()
{
    Scene scene = test::scene_of(shapes::plane(10.0F, 10.0F));
    scene.nodes[0].transform.translation.y = -1.5;
    test::add_object(scene, shapes::sphere(0.4F, 96, 48), glm::vec3(1.0F), {1.2, 0.0, 0.4});
    test::add_object(scene, shapes::torus(0.8F, 0.25F), glm::vec3(1.0F), {-0.9, 0.9, -1.0});
    test::add_object(scene, shapes::box({0.5F, 3.0F, 0.5F}), glm::vec3(1.0F), {-1.5, -1.5, 1.6});
    Image holes{.width = 4, .height = 4, .rgba = std::vector<uint8_t>(64, 255)};
    for (size_t i = 0; i < 16; ++i) {
        holes.rgba[4 * i + 3] = (i / 4 + i) % 2 == 0 ? 255 : 0;
    }
    scene.textures.push_back({.image = holes});
    test::add_object(scene, shapes::quad(3.0F, 1.0F), glm::vec3(1.0F), {0.2, 0.6, 1.9});
    scene.materials.back().alpha_mode = AlphaMode::mask;
    scene.materials.back().base_color_texture.texture = 0;
    return scene;
}

glm::dmat4 looking(const glm::dvec3& eye, const glm::dvec3& along, const glm::dvec3& up)
{
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = 1.0;
    clip_from_view[1][1] = -1.0;
    clip_from_view[2][3] = -1.0;
    clip_from_view[3][2] = 0.01;
    return clip_from_view * glm::lookAt(eye, eye + along, up);
}

/// Views from a place in all six directions, of different sizes, with gaps between their texels.
std::vector<shared::RasterView> six_views(const glm::dvec3& eye, float reach_m, uint32_t first_texel)
{
    std::vector<shared::RasterView> views;
    for (int face = 0; face < 6; ++face) {
        glm::dvec3 along(0.0);
        along[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
        const glm::dvec3 up = face / 2 == 1 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        const uint32_t size = 32U << static_cast<uint32_t>(face % 3);
        views.push_back({.clip_from_anchor = glm::mat4(looking(eye, along, up)),
                         .eye_anchor = glm::vec3(eye),
                         .reach_m = reach_m,
                         .first_texel = first_texel,
                         .size_px = size,
                         .origin_px = glm::uvec2(0),
                         .groups = 1});
        first_texel += size * size + 64;
    }
    place_views(views);
    return views;
}

class RasterViews : public testing::TestWithParam<RasterPath> {
protected:
    [[nodiscard]] static test::Drawing drawing_of(const Scene& scene)
    {
        test::Drawing drawing(scene, test::front_camera(5.0, 0.6), {64, 64});
        drawing.path = GetParam();
        return drawing;
    }

    /// Number of texels of a view that differ from drawing the view alone.
    [[nodiscard]] static size_t differing(test::Drawing& drawing, const shared::RasterView& view,
                                          const std::vector<uint32_t>& maps)
    {
        drawing.globals.clip_from_anchor = view.clip_from_anchor;
        drawing.size_px = glm::uvec2(view.size_px);
        const std::vector<float> alone = drawing.depth_alone();
        size_t count = 0;
        for (size_t i = 0; i < size_t{view.size_px} * view.size_px; ++i) {
            const auto together = std::bit_cast<float>(maps[view.first_texel + i]);
            count += std::abs(together - alone[i]) > 1e-5F * std::max(together, alone[i]) ? 1U : 0U;
        }
        return count;
    }
};

TEST_P(RasterViews, ShowWhatEachShowsAlone)
{
    test::Drawing drawing = drawing_of(room());
    ASSERT_GT(drawing.layout.masked.count, 0U);
    auto views = six_views({0.1, 0.2, 0.3}, 1e6F, 128);
    const auto more = six_views({3.0, 1.0, -2.0}, 1e6F, 60000);
    views.insert(views.end(), more.begin(), more.end());
    place_views(views);
    for (const Tuning tuning : {Tuning{}, Tuning{.small_area_px = 4, .list_groups = 3}}) {
        drawing.tuning = tuning;
        const auto maps = drawing.depth_views(views, 120000, untouched);
        for (const shared::RasterView& view : views) {
            // Hardware clips at the square of a view, which may move an edge by a rounding error.
            const size_t excused = GetParam() == RasterPath::hardware ? view.size_px / 8 : 0;
            EXPECT_LE(differing(drawing, view, maps), excused) << "view of " << view.size_px;
        }
    }
}

TEST_P(RasterViews, LeaveTheirNeighboursAlone)
{
    test::Drawing drawing = drawing_of(room());
    const auto views = six_views({0.1, 0.2, 0.3}, 1e6F, 128);
    auto maps = drawing.depth_views(views, 50000, untouched);
    for (const shared::RasterView& view : views) {
        std::fill_n(maps.begin() + view.first_texel, size_t{view.size_px} * view.size_px, untouched);
    }
    EXPECT_EQ(std::ranges::count(maps, untouched), std::ssize(maps));
}

TEST_P(RasterViews, DrawNothingBeyondTheirReach)
{
    Scene scene;
    test::add_object(scene, shapes::sphere(0.3F, 16, 9), glm::vec3(1.0F), {2.0, 0.0, 0.0});
    test::add_object(scene, shapes::sphere(1.5F, 16, 9), glm::vec3(1.0F), {6.0, 0.0, 0.0});
    test::Drawing drawing = drawing_of(scene);
    const glm::dvec3 eye = glm::dvec3(0.0) - drawing.layout.anchor;
    const auto largest = [&](float reach_m) {
        const auto views = six_views(eye, reach_m, 0);
        const auto maps = drawing.depth_views({views[0]}, 1024, untouched);
        return 0.01F / std::bit_cast<float>(std::ranges::min(
                           maps, {}, [](uint32_t word) { return word == 0 ? UINT32_MAX : word; }));
    };
    EXPECT_GT(largest(10.0F), 4.0F);
    EXPECT_LT(largest(3.0F), 2.4F);
    auto other_group = six_views(eye, 10.0F, 0)[0];
    other_group.groups = 0;
    const auto unwanted = drawing.depth_views({other_group}, 1024, untouched);
    EXPECT_EQ(std::ranges::count(unwanted, 0U), 1024);
    const auto none = drawing.depth_views({six_views(eye, 1.0F, 0)[0]}, 1024, untouched);
    EXPECT_EQ(std::ranges::count(none, 0U), 1024);
}

INSTANTIATE_TEST_SUITE_P(Both, RasterViews, testing::Values(RasterPath::compute, RasterPath::hardware),
                         path_name);

/// Compute only. Words that no depth can exceed mark texels that were not cleared.
TEST(RasterViewTiles, AreClearedAlone)
{
    test::Drawing drawing(room(), test::front_camera(5.0, 0.6), {64, 64});
    auto views = six_views({0.1, 0.2, 0.3}, 1e6F, 128);
    std::erase_if(views, [](const shared::RasterView& view) { return view.size_px < 64; });
    ASSERT_EQ(views.size(), 4U);
    ASSERT_EQ(views[1].size_px, 128U);
    const std::vector<glm::uvec3> tiles{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {3, 1, 1}}; // view, column, row
    std::vector<uint32_t> packed(tiles.size());
    std::ranges::transform(tiles, packed.begin(),
                           [](const glm::uvec3& tile) { return tile.x << 16U | tile.z << 8U | tile.y; });
    const auto whole = drawing.depth_views(views, 70000, untouched);
    const auto some = drawing.depth_views(views, 70000, untouched, packed);
    std::vector<uint32_t> wanted(70000, untouched);
    size_t seen = 0;
    for (const glm::uvec3& tile : tiles) {
        const shared::RasterView& view = views[tile.x];
        for (uint32_t i = 0; i < 64 * 64; ++i) {
            const uint32_t row = 64 * tile.z + i / 64;
            const uint32_t at = view.first_texel + row * view.size_px + 64 * tile.y + i % 64;
            wanted[at] = whole[at];
            seen += whole[at] != 0 ? 1U : 0U;
        }
    }
    EXPECT_GT(seen, 4000U);
    EXPECT_TRUE(some == wanted);
}

TEST(RasterViewPlaces, DoNotOverlap)
{
    std::vector<shared::RasterView> views;
    for (uint32_t i = 0; i < 40; ++i) {
        views.push_back({.size_px = 16U << (i * 7 % 5)});
    }
    place_views(views);
    for (size_t a = 0; a < views.size(); ++a) {
        for (size_t b = 0; b < a; ++b) {
            const glm::uvec2 low = glm::max(views[a].origin_px, views[b].origin_px);
            const glm::uvec2 high =
                glm::min(views[a].origin_px + views[a].size_px, views[b].origin_px + views[b].size_px);
            EXPECT_FALSE(low.x < high.x && low.y < high.y);
        }
    }
}

} // namespace
} // namespace estampe::raster
