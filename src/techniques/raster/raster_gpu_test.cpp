// SPDX-License-Identifier: MIT
// The rasteriser against one that could hardly be simpler, pixel by pixel.
#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "gpu/upload.hpp"
#include "shaders/mesh.glsl.h"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/page_raster.hpp"
#include "support/scenes.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {
namespace {

using test::ClipTriangle;
using test::PageHit;

constexpr float near_z = 0.1F;

/// clip = (x, y, near, z): no rounding between a vertex and its place in clip space.
const glm::mat4 plain_perspective(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 0, 1),
                                  glm::vec4(0, 0, near_z, 0));

std::vector<uint64_t> draw(const std::vector<ClipTriangle>& soup, glm::uvec2 size_px, const Tuning& tuning,
                           Batch batch)
{
    std::vector<shared::PosedVertex> vertices;
    std::vector<glm::uvec4> triangles;
    for (const ClipTriangle& triangle : soup) {
        const auto first = static_cast<uint32_t>(vertices.size());
        for (const glm::vec4& corner : triangle.corner) {
            vertices.push_back({.position = {corner.x, corner.y, corner.w}});
        }
        triangles.emplace_back(first, first + 1, first + 2,
                               (triangle.two_sided ? shared::triangle_two_sided : 0U) |
                                   (triangle.mirrored ? shared::triangle_mirrored : 0U));
    }
    gpu::Buffer vertex_buffer = gpu::upload_buffer(test::shared_device(), "vertices", vertices);
    gpu::Buffer triangle_buffer = gpu::upload_buffer(test::shared_device(), "triangles", triangles);
    gpu::Graph graph;
    const RasterInputs in{.triangles = graph.import_buffer("triangles", triangle_buffer,
                                                           {.size_bytes = triangle_buffer.size_bytes()}),
                          .posed_vertices = graph.import_buffer("vertices", vertex_buffer,
                                                                {.size_bytes = vertex_buffer.size_bytes()}),
                          .draws = {},
                          .rest_vertices = {},
                          .materials = {},
                          .textures = {}};
    auto page = test::run_and_read_as<uint64_t>(
        graph, add_visibility(graph, "visibility", in, {batch},
                              {.clip_from_anchor = plain_perspective, .size_px = size_px, .tuning = tuning}));
    page.resize(size_t{size_px.x} * size_px.y);
    return page;
}

std::vector<uint64_t> draw_all(const std::vector<ClipTriangle>& soup, glm::uvec2 size_px,
                               const Tuning& tuning = {})
{
    return draw(soup, size_px, tuning, {.triangle_count = static_cast<uint32_t>(soup.size())});
}

float depth_of(uint64_t word)
{
    return std::bit_cast<float>(static_cast<uint32_t>(word >> 32U));
}

/// Whether the page shows at a pixel what it should: the nearest triangle, or one as near as rounding can
/// tell.
bool agrees(uint64_t word, const std::vector<PageHit>& hits)
{
    if (word == 0 || hits.empty()) {
        return word == 0 && hits.empty();
    }
    const auto seen = static_cast<uint32_t>(word);
    return std::ranges::any_of(hits, [&](const PageHit& hit) {
        const double tolerance = std::max(hit.tolerance, hits.front().tolerance);
        return hit.triangle == seen && hits.front().depth - hit.depth <= tolerance &&
               std::abs(hit.depth - static_cast<double>(depth_of(word))) <= tolerance;
    });
}

void expect_page(const std::vector<uint64_t>& page, const std::vector<std::vector<PageHit>>& expected,
                 const std::string& what)
{
    size_t wrong = 0;
    size_t covered = 0;
    for (size_t i = 0; i < page.size(); ++i) {
        wrong += agrees(page[i], expected[i]) ? 0U : 1U;
        covered += expected[i].empty() ? 0U : 1U;
    }
    EXPECT_EQ(wrong, 0U) << what << ": of " << page.size() << " pixels, " << covered << " covered";
    EXPECT_GT(covered, 0U) << what << " shows nothing at all";
}

class Soup {
public:
    explicit Soup(uint32_t seed) : random_(seed) {}

    float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    /// A corner at a place of the page (-1 to 1 spans it), seen at distance w.
    static glm::vec4 at(glm::vec2 ndc, float w) { return {ndc.x * w, ndc.y * w, near_z, w}; }

    ClipTriangle around(float spread, float size)
    {
        const glm::vec2 centre(between(-spread, spread), between(-spread, spread));
        ClipTriangle triangle{};
        for (glm::vec4& corner : triangle.corner) {
            corner = at(centre + glm::vec2(between(-size, size), between(-size, size)), between(0.2F, 9.0F));
        }
        return with_sides(triangle);
    }

    ClipTriangle sliver()
    {
        const glm::vec2 from(between(-1.2F, 1.2F), between(-1.2F, 1.2F));
        const glm::vec2 to(between(-1.2F, 1.2F), between(-1.2F, 1.2F));
        return with_sides({{at(from, between(0.3F, 4.0F)), at(to, between(0.3F, 4.0F)),
                            at(to + glm::vec2(between(-0.01F, 0.01F)), between(0.3F, 4.0F))}});
    }

    /// Corners on both sides of the eye.
    ClipTriangle through_the_eye()
    {
        ClipTriangle triangle{};
        for (glm::vec4& corner : triangle.corner) {
            corner = {between(-2.0F, 2.0F), between(-2.0F, 2.0F), near_z, between(-2.0F, 2.0F)};
        }
        return with_sides(triangle);
    }

    /// Surrounds the page, with corners as good as infinitely far away on it.
    ClipTriangle endless()
    {
        ClipTriangle triangle{};
        float angle = between(0.0F, 6.28F);
        for (glm::vec4& corner : triangle.corner) {
            const float reach = std::pow(10.0F, between(2.0F, 9.0F));
            corner = {std::cos(angle) * reach, std::sin(angle) * reach, near_z, between(0.2F, 0.3F)};
            angle += between(1.7F, 2.4F);
        }
        triangle.two_sided = true;
        return triangle;
    }

private:
    ClipTriangle with_sides(ClipTriangle triangle)
    {
        triangle.two_sided = between(0.0F, 1.0F) < 0.5F;
        triangle.mirrored = between(0.0F, 1.0F) < 0.5F;
        return triangle;
    }

    std::mt19937 random_;
};

template <class Make>
std::vector<ClipTriangle> many(size_t count, Make make)
{
    std::vector<ClipTriangle> soup;
    std::generate_n(std::back_inserter(soup), count, make);
    return soup;
}

/// Draws `soup` under every tuning and compares.
void expect_soup(const std::vector<ClipTriangle>& soup, glm::uvec2 size_px, const std::string& what)
{
    const auto expected = test::raster_page(soup, size_px);
    const auto page = draw_all(soup, size_px);
    expect_page(page, expected, what);
    for (const Tuning& tuning : {Tuning{0, 3}, Tuning{64, 1}, Tuning{2048, 32}}) {
        const auto other = draw_all(soup, size_px, tuning);
        expect_page(other, expected, what + " at small_area_px " + std::to_string(tuning.small_area_px));
    }
}

TEST(Raster, DrawsTrianglesOfEverySize)
{
    Soup random(1);
    expect_soup(many(900, [&] { return random.around(1.1F, 0.02F); }), {160, 90}, "tiny");
    expect_soup(many(300, [&] { return random.around(1.1F, 0.3F); }), {160, 90}, "middling");
    expect_soup(many(60, [&] { return random.around(4.0F, 20.0F); }), {161, 89}, "huge");
    expect_soup(many(300, [&] { return random.sliver(); }), {127, 93}, "slivers");
}

TEST(Raster, SharesOutPixelCentresOnEdges)
{
    // Corners on pixel centres, so that many edges, level and upright ones too, run through centres.
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
                {64, 64}, "pixel centres");
    for (int i = 0; i < 4; ++i) {
        expect_soup({{{Soup::at({-0.609375F, -0.609375F}, 1), Soup::at({0.234375F, -0.609375F}, 1),
                       Soup::at({centre(), 0.171875F}, 1)}}},
                    {64, 64}, "level edge on top");
        expect_soup({{{Soup::at({-0.609375F, 0.171875F}, 1), Soup::at({0.234375F, 0.171875F}, 1),
                       Soup::at({centre(), -0.609375F}, 1)}}},
                    {64, 64}, "level edge below");
    }
}

TEST(Raster, ClipsAtTheNearPlane)
{
    Soup random(2);
    expect_soup(many(120, [&] { return random.through_the_eye(); }), {160, 90}, "through the eye");
}

TEST(Raster, DrawsTrianglesThatReachFarBeyondThePage)
{
    Soup random(3);
    for (int i = 0; i < 12; ++i) {
        expect_soup({random.endless()}, {96, 64}, "endless " + std::to_string(i));
    }
}

TEST(Raster, DrawsNothingOfWhatIsBehindOrBeside)
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
    const auto page = draw_all(soup, {64, 64});
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
    const auto first = ids(draw_all(soup, {160, 90}, {0, 512}));
    EXPECT_EQ(first, ids(draw_all(soup, {160, 90}, {192, 512})));
    EXPECT_EQ(first, ids(draw_all(soup, {160, 90}, {2048, 32})));
}

TEST(Raster, AGridCoversEachPixelOnce)
{
    Soup random(6);
    constexpr int columns = 7;
    constexpr int rows = 5;
    const glm::uvec2 size_px(96, 64);
    std::vector<glm::vec4> corners;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) {
            // The rim lies beyond the page; a corner inside may lie in a pixel's very centre.
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
    for (const uint32_t small_area_px : {0U, 2048U}) {
        std::vector<int> times(size_t{size_px.x} * size_px.y, 0);
        for (uint32_t i = 0; i < grid.size(); ++i) {
            const auto alone =
                draw(grid, size_px, {small_area_px, 4}, {.first_triangle = i, .triangle_count = 1});
            for (size_t pixel = 0; pixel < alone.size(); ++pixel) {
                times[pixel] += alone[pixel] != 0 ? 1 : 0;
            }
        }
        EXPECT_EQ(std::ranges::count(times, 1), std::ssize(times)) << "small_area_px " << small_area_px;
    }
}

TEST(Raster, DrawsWhatTheTileListCannotHold)
{
    // 128 tiles a triangle: together more than the 2^18 that the list holds. The nearest comes last, and few
    // workgroups go through all in order, so that it is among those left over.
    const glm::uvec2 size_px(8192, 1);
    std::vector<ClipTriangle> soup;
    for (int i = 0; i < 2400; ++i) {
        const float w = 4.0F - 0.001F * static_cast<float>(i);
        soup.push_back({{Soup::at({-3, -9}, w), Soup::at({3, -9}, w), Soup::at({0, 20}, w)}});
    }
    const auto page = draw_all(soup, size_px, {.list_groups = 16});
    EXPECT_TRUE(std::ranges::all_of(page, [](uint64_t word) { return static_cast<uint32_t>(word) == 2399; }));
}

TEST(Raster, LosesNoneOfManyTiles)
{
    // Full tiles in one column, more than llvmpipe's limit on loops would let few workgroups draw.
    const glm::uvec2 size_px(1, 8192);
    std::vector<ClipTriangle> soup;
    for (int i = 0; i < 400; ++i) {
        const float w = 4.0F - 0.005F * static_cast<float>(i);
        soup.push_back({{Soup::at({-9, -3}, w), Soup::at({-9, 3}, w), Soup::at({20, 0}, w)}});
    }
    const auto page = draw_all(soup, size_px, {.list_groups = 32});
    EXPECT_TRUE(std::ranges::all_of(page, [](uint64_t word) { return static_cast<uint32_t>(word) == 399; }));
}

TEST(Raster, AlphaMasksCutHoles)
{
    // A wall that fills the page, of 8 x 8 squares that are there or not, before a whole one.
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
    for (const uint32_t small_area_px : {0U, 2048U}) {
        drawing.tuning.small_area_px = small_area_px;
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

} // namespace
} // namespace estampe::raster
