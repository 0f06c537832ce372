// SPDX-License-Identifier: MIT
// Compares the two paths on whole scenes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/raster/paths.hpp"
#include "techniques/raster/raster_test_support.hpp"

namespace estampe::raster {
namespace {

constexpr glm::uvec2 page_px(640, 360);

Material& last_material(Scene& scene, bool double_sided)
{
    scene.materials.back().double_sided = double_sided;
    return scene.materials.back();
}

/// A floor that extends below and behind the eye, a sphere of triangles smaller than pixels, and bodies that
/// intersect. No triangle is two-sided or mirrored.
Scene plain_scene()
{
    Scene scene = test::scene_of(shapes::plane(40.0F, 40.0F));
    last_material(scene, false);
    test::add_object(scene, shapes::sphere(0.8F, 600, 300), {0.5F, 0.5F, 0.5F}, {-0.5, 0.8, 0.0});
    last_material(scene, false);
    test::add_object(scene, shapes::torus(0.8F, 0.3F), {0.5F, 0.5F, 0.5F}, {0.3, 0.6, 0.2});
    last_material(scene, false);
    return scene;
}

/// Adds walls of all kinds: seen from the front and from behind, two-sided or not, mirrored or not, and one
/// with holes.
Scene mixed_scene()
{
    Scene scene = plain_scene();
    double x = -2.5;
    for (const bool double_sided : {false, true}) {
        for (const double sign : {1.0, -1.0}) {
            for (const bool turned : {false, true}) {
                test::add_object(scene, shapes::quad(0.5F, 1.4F), {0.5F, 0.5F, 0.5F}, {x, 1.6, 0.6});
                last_material(scene, double_sided);
                scene.nodes.back().transform.scale = {sign, 1.0, 1.0};
                if (turned) {
                    scene.nodes.back().transform.rotation = {0.0, 0.0, 1.0, 0.0};
                }
                x += 0.7;
            }
        }
    }
    Image holes{.width = 4, .height = 4, .rgba = std::vector<uint8_t>(64, 255)};
    for (size_t i = 0; i < 16; ++i) {
        holes.rgba[4 * i + 3] = (i / 4 + i) % 2 == 0 ? 255 : 0;
    }
    scene.textures.push_back({.image = holes});
    test::add_object(scene, shapes::quad(3.0F, 1.0F), {0.5F, 0.5F, 0.5F}, {0.2, 0.6, 1.2});
    Material& masked = last_material(scene, true);
    masked.alpha_mode = AlphaMode::mask;
    masked.base_color_texture.texture = 0;
    return scene;
}

const Camera paths_camera{.eye = {0.4, 1.5, 5.0}, .target = {0.0, 0.9, 0.0}};

test::Drawing drawing_of(const Scene& scene, RasterPath path, const Camera& from = paths_camera)
{
    test::Drawing drawing(scene, from, page_px);
    drawing.path = path;
    return drawing;
}

uint32_t triangle_of(uint64_t word)
{
    return static_cast<uint32_t>(word);
}

uint32_t depth_bits_of(uint64_t word)
{
    return static_cast<uint32_t>(word >> 32U);
}

struct Agreement {
    double same_ids = 0.0; ///< share of all pixels
    size_t covered = 0;
    size_t seen_in_one_only = 0; ///< pixels that only one path covers
    std::vector<int64_t> ulps;   ///< sorted depth differences where ids agree

    [[nodiscard]] int64_t ulps_at(double quantile) const
    {
        return ulps.at(static_cast<size_t>(quantile * static_cast<double>(ulps.size() - 1)));
    }
};

Agreement compare(const std::vector<uint64_t>& a, const std::vector<uint64_t>& b)
{
    Agreement result;
    size_t same = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        result.covered += a[i] != 0 ? 1U : 0U;
        result.seen_in_one_only += (a[i] != 0) != (b[i] != 0) ? 1U : 0U;
        same += (a[i] != 0) == (b[i] != 0) && triangle_of(a[i]) == triangle_of(b[i]) ? 1U : 0U;
        if (a[i] != 0 && b[i] != 0 && triangle_of(a[i]) == triangle_of(b[i])) {
            const auto apart = static_cast<int64_t>(depth_bits_of(a[i])) - depth_bits_of(b[i]);
            result.ulps.push_back(std::abs(apart));
        }
    }
    result.same_ids = static_cast<double>(same) / static_cast<double>(a.size());
    std::ranges::sort(result.ulps);
    return result;
}

/// Draws with both paths and compares. Depths differ by rounding, in proportion to the triangle's largest
/// depth, and by a shift of up to 1/256 pixel, which matters where a triangle is seen edge-on.
Agreement expect_agreement(const Scene& scene, const Camera& from, const char* what)
{
    const Agreement found = compare(drawing_of(scene, RasterPath::compute, from).visibility(),
                                    drawing_of(scene, RasterPath::hardware, from).visibility());
    EXPECT_GE(found.same_ids, 0.9999) << what;
    EXPECT_LE(found.seen_in_one_only, 2U) << what;
    EXPECT_GT(found.covered, 10000U) << what;
    return found;
}

TEST(RasterPathsAgree, OnBodiesWithinSight)
{
    Scene scene = test::scene_of(shapes::sphere(0.8F, 600, 300));
    test::add_object(scene, shapes::torus(1.3F, 0.3F), {0.5F, 0.5F, 0.5F});
    const Agreement found = expect_agreement(scene, paths_camera, "bodies");
    EXPECT_LE(found.ulps_at(0.5), 16);
    EXPECT_LE(found.ulps_at(0.99), 256);
}

TEST(RasterPathsAgree, OnPlainTriangles)
{
    const Scene scene = plain_scene();
    ASSERT_TRUE(drawing_of(scene, RasterPath::compute).layout.opaque.plain);
    const Agreement found = expect_agreement(scene, paths_camera, "plain");
    EXPECT_LE(found.ulps_at(0.999), 512);
}

TEST(RasterPathsAgree, OnTwoSidedMirroredAndMaskedOnes)
{
    const Scene scene = mixed_scene();
    test::Drawing drawing = drawing_of(scene, RasterPath::hardware);
    ASSERT_FALSE(drawing.layout.opaque.plain);
    const Agreement found = expect_agreement(scene, paths_camera, "mixed");
    EXPECT_LE(found.ulps_at(0.999), 512);
    // Everything to be tested is visible: of the eight walls, those that are not culled.
    std::vector<bool> seen(drawing.layout.triangles.size(), false);
    for (const uint64_t word : drawing.visibility()) {
        seen[triangle_of(word)] = seen[triangle_of(word)] || word != 0;
    }
    const size_t walls_end = drawing.layout.masked.first;
    size_t walls_seen = 0;
    for (size_t i = walls_end - 16; i < walls_end; i += 2) {
        walls_seen += seen[i] || seen[i + 1] ? 1U : 0U;
    }
    EXPECT_EQ(walls_seen, 6U);
    EXPECT_TRUE(seen[drawing.layout.masked.first] && seen[drawing.layout.masked.first + 1]);
}

/// The outside of a one-sided body is seen, even if the scene has only a mirrored node: the triangles'
/// orientation follows the node's determinant.
TEST(RasterPathsAgree, OnAMirroredNodeAlone)
{
    Scene scene = test::scene_of(shapes::sphere(0.8F, 60, 30));
    scene.materials[0].double_sided = false;
    scene.nodes[0].transform.scale = {-1.0, 1.0, 1.0};
    (void)expect_agreement(scene, paths_camera, "mirrored");
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        test::Drawing drawing = drawing_of(scene, path);
        EXPECT_FALSE(drawing.layout.opaque.plain);
        const std::vector<shared::PosedVertex> posed = drawing.posed();
        size_t backs = 0;
        for (const uint64_t word : drawing.visibility()) {
            if (word == 0) {
                continue;
            }
            const glm::vec3 outwards = posed[drawing.layout.triangles[triangle_of(word)].x].position;
            backs += glm::dot(outwards, drawing.globals.eye_anchor) < 0.0F ? 1U : 0U;
        }
        EXPECT_EQ(backs, 0U);
    }
}

TEST(RasterPathsAgree, InParallelProjection)
{
    Camera parallel = paths_camera;
    parallel.orthographic_half_height_m = 1.5;
    const Agreement found = expect_agreement(mixed_scene(), parallel, "parallel");
    EXPECT_LE(found.ulps_at(0.999), 4);
}

class RasterPathDepth : public testing::TestWithParam<RasterPath> {};

TEST_P(RasterPathDepth, AloneIsTheDepthOfVisibility)
{
    test::Drawing drawing = drawing_of(mixed_scene(), GetParam());
    const auto words = drawing.visibility();
    const auto depths = drawing.depth_alone();
    size_t wrong = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        wrong += std::bit_cast<uint32_t>(depths[i]) != depth_bits_of(words[i]) ? 1U : 0U;
    }
    EXPECT_EQ(wrong, 0U);
}

TEST_P(RasterPathDepth, OfNothingIsBlank)
{
    test::Drawing drawing = drawing_of(plain_scene(), GetParam());
    drawing.layout.opaque.count = 0;
    const auto words = drawing.visibility();
    EXPECT_TRUE(std::ranges::all_of(words, [](uint64_t word) { return word == 0; }));
    const auto depths = drawing.depth_alone();
    EXPECT_TRUE(std::ranges::all_of(depths, [](float depth) { return depth == 0.0F; }));
}

TEST_P(RasterPathDepth, IsTheSameEachTime)
{
    test::Drawing drawing = drawing_of(mixed_scene(), GetParam());
    EXPECT_EQ(drawing.visibility(), drawing.visibility());
}

INSTANTIATE_TEST_SUITE_P(Both, RasterPathDepth, testing::Values(RasterPath::compute, RasterPath::hardware),
                         path_name);

TEST(RasterPathsAgree, MeasuringNamesOneOfThem)
{
    gpu::Executor executor(test::shared_device());
    const RasterPath measured = measure_paths(test::shared_device(), executor);
    EXPECT_TRUE(measured == RasterPath::hardware || measured == RasterPath::compute);
}

} // namespace
} // namespace estampe::raster
