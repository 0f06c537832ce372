// SPDX-License-Identifier: MIT
// Places of the background that are seen through bodies which bend light.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::subsurface {
namespace {

constexpr glm::uvec2 bent_px(160, 120);
const SubsurfaceStyle bending_glass{
    .enabled = true, .behind = 1.0F, .refraction = Refraction::thick, .ior = 1.5F};

/// The centre of a pixel that is counted row by row.
glm::dvec2 middle_of(size_t pixel)
{
    return glm::dvec2(pixel % bent_px.x, pixel / bent_px.x) + 0.5;
}

/// A page whose first object is a clear body.
struct GlassPage {
    GlassPage(const Scene& scene, const Camera& camera, RasterPath path = RasterPath::compute)
        : drawing(scene, camera, bent_px), seen(drawing.surface())
    {
        drawing.path = path;
    }

    /// For each pixel: the place seen, whether lines are drawn there, and whether the ray is bent.
    [[nodiscard]] std::vector<glm::vec4> places(const SubsurfaceStyle& style, float most_mm = 1000.0F)
    {
        const auto at = [](glm::uvec2 pixel) { return size_t{pixel.y} * bent_px.x + pixel.x; };
        auto draw = test::Layer::words(bent_px, [&](glm::uvec2 p) { return seen.draw[at(p)]; });
        auto depth = test::Layer::depth(bent_px, [&](glm::uvec2 p) { return seen.depth[at(p)]; });
        auto normal = test::Layer::normals(bent_px, [&](glm::uvec2 p) {
            return seen.depth[at(p)] > 0.0F ? seen.shading_normal[at(p)] : glm::vec3(0.0F, 0.0F, 1.0F);
        });
        auto frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{drawing.globals});
        auto parameters = gpu::upload_buffer(test::shared_device(), "subsurface parameters",
                                             std::vector{parameters_of(style), parameters_of({})});
        std::vector<uint32_t> variant_of_draw(drawing.layout.draws.size(), 1U);
        variant_of_draw.front() = 0U;
        auto variants = gpu::upload_buffer(test::shared_device(), "variants", variant_of_draw);
        const auto first_other = std::ranges::find_if(drawing.layout.triangles, [](const glm::uvec4& t) {
            return (t.w & shared::triangle_draw_mask) != 0U;
        });
        const auto body_count =
            static_cast<uint32_t>(std::distance(drawing.layout.triangles.begin(), first_other));
        const raster::Batch body{.triangle_count = body_count};
        const raster::Batch others{.first_triangle = body_count,
                                   .triangle_count = drawing.layout.opaque.count - body_count};
        gpu::Graph graph;
        const raster::RasterInputs meshes = drawing.raster_inputs(graph);
        raster::View view{
            .clip_from_anchor = drawing.globals.clip_from_anchor, .size_px = bent_px, .path = drawing.path};
        const gpu::BufferId background = raster::add_visibility(graph, "others", meshes, {&others, 1}, view);
        view.cull_back_faces = false;
        const std::vector<gpu::BufferId> inside =
            raster::add_layers(graph, "inside", meshes, {&body, 1}, view, 2);
        const gpu::ImageId bent = add_refraction(
            graph, {.common = {.frame = gpu::import_whole(graph, "frame", frame),
                               .draw = draw.in(graph),
                               .depth = depth.in(graph),
                               .normal = normal.in(graph),
                               .parameters = gpu::import_whole(graph, "subsurface parameters", parameters),
                               .variant_of_draw = gpu::import_whole(graph, "variants", variants),
                               .pixels_per_mm = 1.0F,
                               .size_px = bent_px},
                    .inside = inside,
                    .background = background,
                    .triangles = meshes.triangles,
                    .posed_vertices = meshes.posed_vertices,
                    .most_mm = most_mm});
        return test::run_and_read_as<glm::vec4>(graph, bent);
    }

    /// A pixel's view ray in world space: a point, and the unit direction.
    [[nodiscard]] std::pair<glm::dvec3, glm::dvec3> ray(size_t pixel) const
    {
        const glm::dvec2 place = middle_of(pixel);
        const glm::dvec3 nearer = drawing.point_at(place, 0.9) + drawing.layout.anchor;
        const glm::dvec3 farther = drawing.point_at(place, 0.01) + drawing.layout.anchor;
        return {nearer, glm::normalize(farther - nearer)};
    }

    [[nodiscard]] glm::dvec2 page_of(const glm::dvec3& world) const
    {
        const glm::dvec4 clip =
            glm::dmat4(drawing.globals.clip_from_anchor) * glm::dvec4(world - drawing.layout.anchor, 1.0);
        return 0.5 * (glm::dvec2(clip) / clip.w + 1.0) * glm::dvec2(bent_px);
    }

    test::Drawing drawing;
    test::SurfacePixels seen;
};

TEST(Refraction, SlabShiftsByTheFormula)
{
    // A slab turned about the vertical axis, in front of a wall that is parallel to the page.
    double worst_px = 0.0;
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        for (const double angle_deg : {0.0, 20.0, 45.0, 65.0}) {
            for (const float ior : {1.2F, 1.5F, 2.4F}) {
                constexpr float thickness_m = 0.5F;
                Scene scene = test::scene_of(shapes::box({6.0F, 4.0F, thickness_m}));
                const double angle = angle_deg * std::numbers::pi / 180.0;
                scene.nodes[0].transform.translation = {0.0, -2.0, 0.0};
                scene.nodes[0].transform.rotation = glm::angleAxis(angle, glm::dvec3(0, 1, 0));
                test::add_object(scene, shapes::box({40.0F, 40.0F, 0.1F}), glm::vec3(1.0F),
                                 {0.0, -20.0, -6.0});
                Camera camera = test::front_camera(8.0, 0.5);
                camera.orthographic_half_height_m = 1.0;
                GlassPage page(scene, camera, path);
                SubsurfaceStyle style = bending_glass;
                style.ior = ior;
                const std::vector<glm::vec4> places = page.places(style);
                const double sine = std::sin(angle);
                const double shift_m =
                    static_cast<double>(thickness_m) * sine *
                    (1.0 - std::cos(angle) /
                               std::sqrt(static_cast<double>(ior) * static_cast<double>(ior) - sine * sine));
                const double shift_px = shift_m * bent_px.y / 2.0;
                // The slab's right edge is turned away, so the ray runs to the left inside the slab.
                for (uint32_t y = 50; y < 70; ++y) {
                    for (uint32_t x = 70; x < 90; ++x) {
                        const size_t pixel = size_t{y} * bent_px.x + x;
                        ASSERT_EQ(places[pixel].w, 1.0F);
                        const glm::dvec2 shift = glm::dvec2(places[pixel]) - middle_of(pixel);
                        worst_px =
                            std::max({worst_px, std::abs(std::abs(shift.x) - shift_px), std::abs(shift.y)});
                        if (angle_deg > 0.0) {
                            ASSERT_LT(shift.x * sine, 0.0);
                        }
                    }
                }
            }
        }
    }
    RecordProperty("worst", fmt::format("{:.4f} px", worst_px));
    EXPECT_LT(worst_px, 0.1);
}

/// Where a ray leaves a ball around the origin after two refractions, and its direction there.
std::pair<glm::dvec3, glm::dvec3> through_ball(const glm::dvec3& from, const glm::dvec3& along, double radius,
                                               double ior)
{
    const double nearest = -glm::dot(from, along);
    const double inside_2 = radius * radius - glm::dot(from, from) + nearest * nearest;
    const glm::dvec3 entry = from + (nearest - std::sqrt(inside_2)) * along;
    const glm::dvec3 inside = glm::refract(along, glm::normalize(entry), 1.0 / ior);
    const glm::dvec3 exit = entry - 2.0 * glm::dot(entry, inside) * inside;
    return {exit, glm::refract(inside, -glm::normalize(exit), ior)};
}

TEST(Refraction, BallShowsTheWorldUpsideDown)
{
    double squares = 0.0;
    double worst_px = 0.0;
    int count = 0;
    for (const bool is_parallel : {false, true}) {
        constexpr double wall_m = -4.0;
        Scene scene = test::scene_of(shapes::sphere(1.0F, 256, 128));
        test::add_object(scene, shapes::box({60.0F, 60.0F, 0.1F}), glm::vec3(1.0F),
                         {0.0, -30.0, wall_m - 0.05});
        Camera camera{.eye = {0.5, 0.8, 7.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.6};
        if (is_parallel) {
            camera.orthographic_half_height_m = 2.2;
        }
        GlassPage page(scene, camera);
        const std::vector<glm::vec4> places = page.places(bending_glass);
        for (size_t pixel = 0; pixel < places.size(); ++pixel) {
            if (places[pixel].w == 0.0F) {
                continue;
            }
            const auto [from, along] = page.ray(pixel);
            const double beside = glm::length(glm::cross(from, along));
            if (beside > 0.9) {
                continue; // the polygons of the outline are not the ball's
            }
            const auto [exit, out] = through_ball(from, along, 1.0, 1.5);
            const glm::dvec3 wall = exit + (wall_m - exit.z) / out.z * out;
            const glm::dvec2 wanted = page.page_of(wall);
            if (wanted.x < 0.0 || wanted.y < 0.0 || wanted.x > bent_px.x || wanted.y > bent_px.y) {
                continue;
            }
            const double off_px = glm::distance(glm::dvec2(places[pixel]), wanted);
            squares += off_px * off_px;
            worst_px = std::max(worst_px, off_px);
            ++count;
        }
        const auto place_at = [&](const glm::dvec3& world) {
            const glm::dvec2 p = page.page_of(world);
            return glm::dvec2(places[size_t(p.y) * bent_px.x + size_t(p.x)]);
        };
        EXPECT_LT(place_at({0.0, -0.5, 0.0}).y + 10.0, place_at({0.0, 0.5, 0.0}).y) << "upside down";
        EXPECT_GT(place_at({-0.5, 0.0, 0.0}).x, place_at({0.5, 0.0, 0.0}).x + 10.0) << "left is right";
    }
    RecordProperty(
        "rmse", fmt::format("{:.3f} px, worst {:.3f} px of {}", std::sqrt(squares / count), worst_px, count));
    EXPECT_GT(count, 2000);
    EXPECT_LT(std::sqrt(squares / count), 0.5);
}

TEST(Refraction, AirAndSheetsBendNothing)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 64, 32));
    test::add_object(scene, shapes::box({60.0F, 60.0F, 0.1F}), glm::vec3(1.0F), {0.0, -30.0, -4.0});
    const Camera camera{.eye = {0.5, 0.8, 7.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.6};
    SubsurfaceStyle air = bending_glass;
    air.ior = 1.0F;
    GlassPage page(scene, camera);
    std::vector<glm::vec4> places = page.places(air);
    for (size_t pixel = 0; pixel < places.size(); ++pixel) {
        ASSERT_EQ(glm::dvec2(places[pixel]), middle_of(pixel));
    }
    // A ray leaves an open sheet without thickness in the direction in which it came.
    Scene sheet = test::scene_of(shapes::quad(2.0F, 2.0F));
    sheet.nodes[0].transform.rotation = glm::angleAxis(0.6, glm::dvec3(0, 1, 0));
    test::add_object(sheet, shapes::box({60.0F, 60.0F, 0.1F}), glm::vec3(1.0F), {0.0, -30.0, -4.0});
    GlassPage thin(sheet, camera);
    places = thin.places(bending_glass);
    for (size_t pixel = 0; pixel < places.size(); ++pixel) {
        ASSERT_LT(glm::distance(glm::dvec2(places[pixel]), middle_of(pixel)), 0.02);
    }
}

TEST(Refraction, NothingIsShiftedFartherThanAllowed)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 64, 32));
    test::add_object(scene, shapes::box({60.0F, 60.0F, 0.1F}), glm::vec3(1.0F), {0.0, -30.0, -4.0});
    const Camera camera{.eye = {0.5, 0.8, 7.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.6};
    const std::vector<glm::vec4> places = GlassPage(scene, camera).places(bending_glass, 9.0F);
    double most_px = 0.0;
    for (size_t pixel = 0; pixel < places.size(); ++pixel) {
        most_px = std::max(most_px, glm::distance(glm::dvec2(places[pixel]), middle_of(pixel)));
    }
    EXPECT_LE(most_px, 9.01);
    EXPECT_GT(most_px, 8.5);
}

} // namespace
} // namespace estampe::subsurface
