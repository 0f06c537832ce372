// SPDX-License-Identifier: MIT
// The thickness of objects, and the light that they transmit.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::subsurface {
namespace {

constexpr glm::uvec2 through_px(120, 96);
constexpr glm::uvec2 half_px = through_px / 2U;

/// Images of the half page.
struct Far {
    std::vector<uint32_t> draw;
    std::vector<double> thickness_m;
    std::vector<glm::vec4> light;   ///< transmitted light, for white light on the far side
    std::vector<glm::vec4> on_page; ///< transmitted light at every pixel of the page
};

/// Page position of a half-page pixel.
glm::uvec2 pixel_of(size_t half)
{
    return 2U * glm::uvec2(half % half_px.x, half / half_px.x);
}

size_t half_at(glm::uvec2 pixel)
{
    return size_t{pixel.y / 2} * half_px.x + pixel.x / 2;
}

/// The far side of a scene in which all surfaces scatter light.
Far far_side_of(const Scene& scene, const Camera& camera, const SubsurfaceStyle& style,
                RasterPath path = RasterPath::compute)
{
    test::Drawing drawing(scene, camera, through_px);
    drawing.path = path;
    const test::SurfacePixels seen = drawing.surface();
    const auto at = [](glm::uvec2 pixel) { return size_t{pixel.y} * through_px.x + pixel.x; };
    auto draw = test::Layer::words(through_px, [&](glm::uvec2 p) { return seen.draw[at(p)]; });
    auto depth = test::Layer::depth(through_px, [&](glm::uvec2 p) { return seen.depth[at(p)]; });
    auto normal = test::Layer::normals(through_px, [&](glm::uvec2 p) {
        return seen.depth[at(p)] > 0.0F ? seen.smooth_normal[at(p)] : glm::vec3(0.0F, 0.0F, 1.0F);
    });
    auto far_light = test::Layer::color(half_px, [](glm::uvec2) { return glm::vec4(1.0F); });
    auto frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{drawing.globals});
    auto parameters =
        gpu::upload_buffer(test::shared_device(), "subsurface parameters", std::vector{parameters_of(style)});
    std::vector<uint64_t> words = drawing.visibility();
    words.resize((words.size() + 1) / 2 * 2);
    auto visibility = gpu::upload_buffer(test::shared_device(), "visibility", words);
    Far result;
    for (int wanted = 0; wanted < 3; ++wanted) {
        auto light = test::Layer::color(through_px, [](glm::uvec2) { return glm::vec4(0.0F); });
        gpu::Graph graph;
        const raster::RasterInputs meshes = drawing.raster_inputs(graph);
        const raster::Batch body{.first_triangle = drawing.layout.opaque.first,
                                 .triangle_count = drawing.layout.opaque.count};
        const gpu::BufferId behind =
            raster::add_visibility(graph, "behind", meshes, {&body, 1},
                                   {.clip_from_anchor = drawing.globals.clip_from_anchor,
                                    .size_px = through_px,
                                    .cull_back_faces = false,
                                    .path = path,
                                    .behind = gpu::import_whole(graph, "visibility", visibility),
                                    .second_from = glm::uvec2(0)});
        const SubsurfaceInputs inputs{.frame = gpu::import_whole(graph, "frame", frame),
                                      .draw = draw.in(graph),
                                      .depth = depth.in(graph),
                                      .normal = normal.in(graph),
                                      .parameters =
                                          gpu::import_whole(graph, "subsurface parameters", parameters),
                                      .variant_of_draw = std::nullopt,
                                      .size_px = through_px};
        const FarSide far_side = add_far_side(graph, inputs, behind, meshes.triangles, meshes.posed_vertices);
        if (wanted == 0) {
            result.draw = test::run_and_read_as<uint32_t>(graph, far_side.draw);
        } else if (wanted == 1) {
            const auto depths = test::run_and_read_as<float>(graph, far_side.depth);
            for (size_t i = 0; i < depths.size(); ++i) {
                const size_t whole = at(pixel_of(i));
                result.thickness_m.push_back(glm::distance(drawing.point_seen(whole, depths[i]),
                                                           drawing.point_seen(whole, seen.depth[whole])));
            }
        } else {
            const Through through{.far_side = far_side, .light = far_light.in(graph)};
            result.on_page =
                test::run_and_read_colors(graph, add_scatter(graph, inputs, light.in(graph), through, false));
            for (size_t i = 0; i < size_t{half_px.x} * half_px.y; ++i) {
                result.light.push_back(result.on_page[at(pixel_of(i))]);
            }
        }
    }
    return result;
}

/// Length of the view ray through a pixel inside a sphere around the origin.
double chord_m(const Camera& camera, glm::uvec2 pixel, double radius_m)
{
    const auto globals = features::frame_globals(camera, {}, camera.eye, {.size_px = through_px});
    const glm::dvec2 ndc = 2.0 * (glm::dvec2(pixel) + 0.5) / glm::dvec2(through_px) - 1.0;
    const glm::dvec4 p = glm::inverse(glm::dmat4(globals.clip_from_anchor)) * glm::dvec4(ndc, 0.5, 1.0);
    const glm::dvec3 way = glm::normalize(glm::dvec3(p) / p.w);
    const double nearest = glm::dot(-camera.eye, way);
    const double beside_2 = glm::dot(camera.eye, camera.eye) - nearest * nearest;
    return beside_2 < radius_m * radius_m ? 2.0 * std::sqrt(radius_m * radius_m - beside_2) : 0.0;
}

TEST(Through, KnowsHowThickASphereIs)
{
    const Camera camera{.eye = {0.4, 0.7, 4.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.6};
    for (const bool is_two_sided : {false, true}) {
        for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
            Scene scene = test::scene_of(shapes::sphere(1.0F, 256, 128));
            scene.materials.front().double_sided = is_two_sided;
            const SubsurfaceStyle style{.enabled = true, .depth_m = 1.0F, .tint = glm::vec3(0.5F)};
            const Far far = far_side_of(scene, camera, style, path);
            double worst = 0.0;
            int count = 0;
            for (size_t i = 0; i < far.draw.size(); ++i) {
                const double wanted = chord_m(camera, pixel_of(i), 1.0);
                if (wanted > 0.3) {
                    EXPECT_EQ(far.draw[i], 1U);
                    worst = std::max(worst, std::abs(far.thickness_m[i] / wanted - 1.0));
                    EXPECT_NEAR(far.light[i].x, std::exp2(-far.thickness_m[i]), 2e-3) << "in every tile";
                    ++count;
                } else if (wanted == 0.0) {
                    EXPECT_EQ(far.draw[i], 0U);
                }
            }
            EXPECT_GT(count, 500);
            EXPECT_LT(worst, 0.01);
        }
    }
}

TEST(Through, AbsorbsAsBeerAndLambertSay)
{
    const Camera camera{
        .eye = {0.0, 0.25, 3.0}, .target = {0.0, 0.25, 0.0}, .orthographic_half_height_m = 0.4};
    for (const float thickness_m : {0.05F, 0.2F, 0.5F}) {
        const Scene scene = test::scene_of(shapes::box({0.5F, 0.5F, thickness_m}));
        const SubsurfaceStyle style{
            .enabled = true, .depth_m = 0.1F, .tint = {0.8F, 0.5F, 0.1F}, .strength = 0.75F};
        const Far far = far_side_of(scene, camera, style);
        const glm::vec4 through = far.light[half_at(through_px / 2U)];
        for (int channel = 0; channel < 3; ++channel) {
            const double wanted = 0.75 * std::pow(static_cast<double>(style.tint[channel]),
                                                  static_cast<double>(thickness_m) / 0.1);
            EXPECT_NEAR(through[channel], wanted, 1e-3 * wanted + 1e-6) << thickness_m;
        }
        EXPECT_EQ(far.light.front().x, 0.0F) << "beside it";
    }
}

TEST(Through, LightsNothingWhereNothingComesThrough)
{
    // At half of the light lost per centimetre, nothing is left behind half a metre.
    const Scene scene = test::scene_of(shapes::box({0.5F, 0.5F, 0.5F}));
    const Camera camera{
        .eye = {0.0, 0.25, 3.0}, .target = {0.0, 0.25, 0.0}, .orthographic_half_height_m = 0.4};
    const Far far = far_side_of(scene, camera, {.enabled = true, .depth_m = 0.01F, .tint = glm::vec3(0.5F)});
    EXPECT_NEAR(far.thickness_m[half_at({60, 48})], 0.5, 1e-3);
    EXPECT_EQ(std::ranges::max(far.draw), 0U);
    for (const glm::vec4& light : far.light) {
        EXPECT_EQ(light.x, 0.0F);
    }
}

TEST(Through, TakesASheetForThin)
{
    // A leaf in front of a body: the next surface behind the leaf is a front face.
    Scene scene = test::scene_of(shapes::quad(1.0F, 1.0F));
    test::add_object(scene, shapes::box({2.0F, 2.0F, 0.5F}), glm::vec3(1.0F), {0.0, -1.0, -2.0});
    const Camera camera{.eye = {0.0, 0.5, 3.0}, .target = {0.0, 0.5, 0.0}, .vertical_fov_rad = 0.3};
    const Far far = far_side_of(scene, camera, {.enabled = true});
    EXPECT_EQ(far.draw[half_at({60, 48})], 1U);
    EXPECT_NEAR(far.thickness_m[half_at({60, 48})], 0.0, 1e-4);
}

TEST(Through, LiesBetweenItsNeighboursOnThePage)
{
    // At the half page's pixels the page equals the half page; between them it is interpolated, and it does
    // not fade at the body's edge.
    const Scene scene = test::scene_of(shapes::box({0.5F, 0.5F, 0.2F}));
    const Camera camera{
        .eye = {0.0, 0.25, 3.0}, .target = {0.0, 0.25, 0.0}, .orthographic_half_height_m = 0.4};
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        const Far far =
            far_side_of(scene, camera,
                        {.enabled = true, .depth_m = 0.2F, .tint = glm::vec3(0.5F), .strength = 1.0F}, path);
        int count = 0;
        float most = 0.0F;
        for (const glm::vec4& pixel : far.on_page) {
            const float light = pixel.x;
            most = light == 0.0F ? most : std::max(most, std::abs(light - 0.5F));
            count += light > 0.0F ? 1 : 0;
        }
        EXPECT_LT(most, 2e-3F);
        RecordProperty("most", fmt::format("{:.2g}", most));
        EXPECT_EQ(count, 60 * 60) << "all of the box's front";
    }
}

} // namespace
} // namespace estampe::subsurface
