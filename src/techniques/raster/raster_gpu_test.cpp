// SPDX-License-Identifier: MIT
// Compares the rasteriser with a very simple reference, pixel by pixel.
#include <algorithm>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/raster/paths.hpp"
#include "techniques/raster/raster_test_support.hpp"

namespace estampe::raster {
namespace {

/// Properties that both paths must have.
class RasterPaths : public testing::TestWithParam<RasterPath> {
protected:
    /// Compute with six tunings, bit-exact; hardware with the tolerance that lavapipe needs.
    [[nodiscard]] static std::vector<Way> ways()
    {
        if (GetParam() == RasterPath::hardware) {
            return {{RasterPath::hardware, 1}, {RasterPath::hardware, 1, {.culled_from = 1}}};
        }
        return {{},
                {.tuning = {0, 3}},
                {.tuning = {64, 1}},
                {.tuning = {2048, 32}},
                {.tuning = {.small_area_px = 64, .threads_list_tiles = false}},
                {.tuning = {.clusters_from = 1}}};
    }
};

TEST_P(RasterPaths, DrawsTrianglesOfEverySize)
{
    Soup random(1);
    expect_soup(many(900, [&] { return random.around(1.1F, 0.02F); }), {160, 90}, "tiny", ways());
    expect_soup(many(300, [&] { return random.around(1.1F, 0.3F); }), {160, 90}, "middling", ways());
    expect_soup(many(60, [&] { return random.around(4.0F, 20.0F); }), {161, 89}, "huge", ways());
    expect_soup(many(300, [&] { return random.sliver(); }), {127, 93}, "slivers", ways());
}

TEST_P(RasterPaths, SharesOutPixelCentresOnEdges)
{
    // Corners on pixel centres, so that many edges, also horizontal and vertical ones, pass through centres.
    Soup random(8);
    const auto centre = [&] { return (std::floor(random.between(0.0F, 12.0F)) + 26.5F) / 32.0F - 1.0F; };
    expect_soup(many(300,
                     [&] {
                         ClipTriangle triangle{};
                         const float w = random.between(1.0F, 2.0F) > 1.5F ? 1.0F : 2.0F;
                         for (glm::vec4& corner : triangle.corner) {
                             corner = Soup::at({centre(), centre()}, w);
                         }
                         return triangle;
                     }),
                {64, 64}, "pixel centres", ways());
    for (int i = 0; i < 4; ++i) {
        expect_soup({{{Soup::at({-0.609375F, -0.609375F}, 1), Soup::at({0.234375F, -0.609375F}, 1),
                       Soup::at({centre(), 0.171875F}, 1)}}},
                    {64, 64}, "level edge on top", ways());
        expect_soup({{{Soup::at({-0.609375F, 0.171875F}, 1), Soup::at({0.234375F, 0.171875F}, 1),
                       Soup::at({centre(), -0.609375F}, 1)}}},
                    {64, 64}, "level edge below", ways());
    }
}

TEST_P(RasterPaths, ClipsAtTheNearPlane)
{
    Soup random(2);
    expect_soup(many(120, [&] { return random.through_the_eye(); }), {160, 90}, "through the eye", ways());
}

TEST_P(RasterPaths, DrawsTrianglesThatReachFarBeyondThePage)
{
    // Compute clamps extremely distant corners to 2^21 pixels, and so does the reference. Hardware clips at
    // the page in floats: at 10^3 page sizes these have a resolution of 1/64 pixel.
    const bool hardware = GetParam() == RasterPath::hardware;
    auto far_ways = ways();
    far_ways.front().slack = hardware ? 4 : 0;
    Soup random(3);
    for (int i = 0; i < 12; ++i) {
        expect_soup({random.endless(hardware ? 3.0F : 9.0F)}, {96, 64}, "endless " + std::to_string(i),
                    far_ways);
    }
}

TEST_P(RasterPaths, DrawsNothingOfWhatIsBehindOrBeside)
{
    Soup random(4);
    std::vector<ClipTriangle> soup;
    for (int i = 0; i < 200; ++i) {
        ClipTriangle triangle = random.around(1.0F, 0.5F);
        for (glm::vec4& corner : triangle.corner) {
            if (i % 2 == 0) {
                corner.w = -corner.w;
            } else {
                corner.x += 3.0F * corner.w;
            }
        }
        soup.push_back(triangle);
    }
    const auto page = draw_all(soup, {64, 64}, ways().front());
    EXPECT_TRUE(std::ranges::all_of(page, [](uint64_t word) { return word == 0; }));
}

TEST(Raster, IsTheSameForEveryTuning)
{
    Soup random(5);
    auto soup = many(300, [&] { return random.around(1.1F, 0.3F); });
    for (const auto& more : {many(20, [&] { return random.around(2.0F, 5.0F); }),
                             many(20, [&] { return random.through_the_eye(); })}) {
        soup.insert(soup.end(), more.begin(), more.end());
    }
    const auto ids = [](std::vector<uint64_t> page) {
        std::ranges::transform(page, page.begin(), [](uint64_t word) { return word & 0xffffffffU; });
        return page;
    };
    const auto first = ids(draw_all(soup, {160, 90}, {.tuning = {0, 512}}));
    EXPECT_EQ(first, ids(draw_all(soup, {160, 90}, {.tuning = {192, 512}})));
    EXPECT_EQ(first, ids(draw_all(soup, {160, 90}, {.tuning = {2048, 32}})));
}

TEST_P(RasterPaths, AGridCoversEachPixelOnce)
{
    Soup random(6);
    constexpr int columns = 7;
    constexpr int rows = 5;
    const glm::uvec2 size_px(96, 64);
    std::vector<glm::vec4> corners;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) {
            // The border is outside the page. An inner corner may be exactly at a pixel's centre.
            const bool inner = x > 0 && x < columns && y > 0 && y < rows;
            const glm::vec2 px = glm::vec2(x * 18 - 15, y * 16 - 8) +
                                 (inner ? glm::vec2(random.between(-6.0F, 6.0F), random.between(-6.0F, 6.0F))
                                        : glm::vec2(0.0F));
            const glm::vec2 snapped = (x + y) % 3 == 0 ? glm::floor(px) + 0.5F : px;
            corners.push_back(Soup::at(snapped / glm::vec2(size_px) * 2.0F - 1.0F,
                                       (x + y) % 3 == 0 ? 1.0F : random.between(0.5F, 4.0F)));
        }
    }
    std::vector<ClipTriangle> grid;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const auto corner = [&](int dx, int dy) {
                return corners[static_cast<size_t>((y + dy) * (columns + 1) + x + dx)];
            };
            grid.push_back({{corner(0, 0), corner(1, 0), corner(0, 1)}});
            grid.push_back({{corner(1, 0), corner(1, 1), corner(0, 1)}});
        }
    }
    for (const Way& way : ways()) {
        std::vector<int> times(size_t{size_px.x} * size_px.y, 0);
        for (uint32_t i = 0; i < grid.size(); ++i) {
            const auto alone = draw(grid, size_px, way, {.first_triangle = i, .triangle_count = 1});
            for (size_t pixel = 0; pixel < alone.size(); ++pixel) {
                times[pixel] += alone[pixel] != 0 ? 1 : 0;
            }
        }
        EXPECT_EQ(std::ranges::count(times, 1), std::ssize(times))
            << "small_area_px " << way.tuning.small_area_px;
    }
}

TEST(Raster, DrawsWhatTheTileListCannotHold)
{
    // 128 tiles per triangle, together more than the 2^18 of the list. The nearest triangle is last, and few
    // workgroups process all in order, so it is among those that did not fit.
    const glm::uvec2 size_px(8192, 1);
    std::vector<ClipTriangle> soup;
    for (int i = 0; i < 2400; ++i) {
        const float w = 4.0F - 0.001F * static_cast<float>(i);
        soup.push_back({{Soup::at({-3, -9}, w), Soup::at({3, -9}, w), Soup::at({0, 20}, w)}});
    }
    const auto page = draw_all(soup, size_px, {.tuning = {.list_groups = 16}});
    EXPECT_TRUE(std::ranges::all_of(page, [](uint64_t word) { return static_cast<uint32_t>(word) == 2399; }));
}

TEST(Raster, LosesNoneOfManyTiles)
{
    // More full tiles in one column than llvmpipe's loop limit allows for few workgroups.
    const glm::uvec2 size_px(1, 8192);
    std::vector<ClipTriangle> soup;
    for (int i = 0; i < 400; ++i) {
        const float w = 4.0F - 0.005F * static_cast<float>(i);
        soup.push_back({{Soup::at({-9, -3}, w), Soup::at({-9, 3}, w), Soup::at({20, 0}, w)}});
    }
    const auto page = draw_all(soup, size_px, {.tuning = {.list_groups = 32}});
    EXPECT_TRUE(std::ranges::all_of(page, [](uint64_t word) { return static_cast<uint32_t>(word) == 399; }));
}

TEST_P(RasterPaths, AlphaMasksCutHoles)
{
    // A wall that fills the page, with 8 x 8 opaque or missing squares, in front of a solid one.
    Image checker{.width = 8, .height = 8, .rgba = std::vector<uint8_t>(256, 255)};
    for (size_t i = 0; i < 64; ++i) {
        checker.rgba[4 * i + 3] = (i / 8 + i) % 2 == 0 ? 255 : 0;
    }
    const auto wall = [](float z) {
        Primitive primitive;
        primitive.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
        primitive.normals.assign(4, {0, 0, 1});
        primitive.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        primitive.indices = {0, 1, 2, 0, 2, 3};
        return primitive;
    };
    Scene scene;
    test::add_object(scene, wall(0.0F), glm::vec3(1.0F));
    test::add_object(scene, wall(-0.1F), glm::vec3(1.0F));
    scene.textures.push_back({.image = checker});
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.materials[0].base_color_texture.texture = 0;
    Camera camera = test::front_camera(5.0, 0.6);
    camera.orthographic_half_height_m = 1.0;
    test::Drawing drawing(scene, camera, {160, 160});
    ASSERT_EQ(drawing.layout.masked.count, 2U);
    drawing.path = GetParam();
    for (const Way& way : ways()) {
        drawing.tuning = way.tuning;
        const auto page = drawing.visibility();
        for (uint32_t y = 0; y < 160; ++y) {
            for (uint32_t x = 0; x < 160; ++x) {
                const bool near_edge = x % 20 < 3 || x % 20 > 16 || y % 20 < 3 || y % 20 > 16;
                const bool stands = (x / 20 + y / 20) % 2 == 0;
                const bool seen = static_cast<uint32_t>(page[y * 160 + x]) >= drawing.layout.masked.first;
                ASSERT_TRUE(near_edge || seen == stands) << x << ", " << y;
            }
        }
    }
}

TEST_P(RasterPaths, PeelsEverySecondPixel)
{
    // Bodies of few and of many pixels that intersect: tests what is behind the nearest surface.
    const glm::uvec2 size_px(181, 133);
    Scene scene;
    test::add_object(scene, shapes::sphere(0.3F, 48, 24), glm::vec3(1.0F), {-0.3, 0.2, 0.0});
    test::add_object(scene, shapes::sphere(0.2F, 96, 48), glm::vec3(1.0F), {0.3, 0.0, 0.5});
    test::add_object(scene, shapes::box({1.6F, 0.8F, 0.3F}), glm::vec3(1.0F), {0.0, -0.4, -1.0});
    test::Drawing drawing(scene, test::front_camera(3.0, 0.6), size_px);
    drawing.path = GetParam();
    std::vector<uint64_t> words = drawing.visibility();
    words.resize((words.size() + 1) / 2 * 2);
    gpu::Buffer seen = gpu::upload_buffer(test::shared_device(), "seen", words);
    const auto peeled = [&](const Way& way, std::optional<glm::uvec2> second_from) {
        gpu::Graph graph;
        const RasterInputs meshes = drawing.raster_inputs(graph);
        const Batch all{.first_triangle = drawing.layout.opaque.first,
                        .triangle_count = drawing.layout.opaque.count};
        return test::run_and_read_as<uint64_t>(
            graph, add_visibility(graph, "peeled", meshes, {&all, 1},
                                  {.clip_from_anchor = drawing.globals.clip_from_anchor,
                                   .size_px = size_px,
                                   .cull_back_faces = false,
                                   .path = GetParam(),
                                   .tuning = way.tuning,
                                   .behind = gpu::import_whole(graph, "seen", seen),
                                   .second_from = second_from}));
    };
    for (const Way& way : ways()) {
        const std::vector<uint64_t> whole = peeled(way, std::nullopt);
        for (const glm::uvec2 from :
             {glm::uvec2(0, 0), glm::uvec2(1, 0), glm::uvec2(0, 1), glm::uvec2(1, 1)}) {
            const std::vector<uint64_t> half = peeled(way, from);
            const glm::uvec2 half_px = (size_px + 1U - from) / 2U;
            size_t other = 0;
            size_t there = 0;
            for (uint32_t y = 0; y < half_px.y; ++y) {
                for (uint32_t x = 0; x < half_px.x; ++x) {
                    const uint64_t wanted = whole[size_t{from.y + 2 * y} * size_px.x + from.x + 2 * x];
                    const uint64_t found = half[size_t{y} * half_px.x + x];
                    const double off =
                        static_cast<double>(depth_of(found)) / static_cast<double>(depth_of(wanted));
                    const bool is_same = GetParam() == RasterPath::compute ? found == wanted
                                         : wanted == 0                     ? found == 0
                                                                           : std::abs(off - 1.0) < 1e-3;
                    other += is_same ? 0U : 1U;
                    there += wanted != 0 ? 1U : 0U;
                }
            }
            EXPECT_GT(there, 1000U);
            // The hardware snaps edges again.
            EXPECT_LE(other, GetParam() == RasterPath::compute ? 0U : there / 500)
                << from.x << ", " << from.y;
        }
    }
}

/// More threads than one row of workgroups holds; each has its own item.
TEST(Raster, ClearsALargePageToItsEnd)
{
    const std::vector<uint32_t> dirty(4 * ((size_t{1} << 21U) + 100000), 7U);
    gpu::Buffer page = gpu::upload_buffer(test::shared_device(), "page", dirty);
    gpu::Graph graph;
    const gpu::BufferId cleared = add_clear(graph, "page", gpu::import_whole(graph, "page", page));
    EXPECT_EQ(test::run_and_read_as<uint32_t>(graph, cleared), std::vector<uint32_t>(dirty.size()));
}

INSTANTIATE_TEST_SUITE_P(Both, RasterPaths, testing::Values(RasterPath::compute, RasterPath::hardware),
                         path_name);

} // namespace
} // namespace estampe::raster
