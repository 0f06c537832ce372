// SPDX-License-Identifier: MIT
// The buffers of a picture against distances, normals and outlines that are known exactly.
#include <estampe/surface_buffers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings buffer_page{.width = 200, .height = 120};

Style without_margin()
{
    Style style;
    style.set("paper.margin_mm=0");
    return style;
}

SurfaceBuffers buffers_of(const Scene& scene, const Camera& camera,
                          const RenderSettings& settings = buffer_page)
{
    test::shared_renderer().set_scene(scene);
    return test::shared_renderer().render_buffers(camera, without_margin(), settings);
}

/// The view from the world of a camera whose picture has `size_px`, in pixels from the upper left corner.
glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& place, const glm::dvec2& size_px)
{
    const glm::dvec3 seen(glm::lookAt(camera.eye, camera.target, camera.up) * glm::dvec4(place, 1.0));
    const double half_m =
        camera.orthographic_half_height_m.value_or(-seen.z * std::tan(0.5 * camera.vertical_fov_rad));
    const glm::dvec2 half(half_m * size_px.x / size_px.y, half_m);
    const glm::dvec2 from_middle = 0.5 * glm::dvec2(seen) / half - camera.shift;
    return size_px * (glm::dvec2(0.5) + glm::dvec2(from_middle.x, -from_middle.y));
}

Camera with_shift(Camera camera, const glm::dvec2& shift)
{
    camera.shift = shift;
    return camera;
}

Camera parallel_of(Camera camera, double half_height_m)
{
    camera.orthographic_half_height_m = half_height_m;
    return camera;
}

TEST(SurfaceBuffers, ASphereHasItsDistancesAndNormals)
{
    const double radius_m = 1.0;
    Scene scene = test::scene_of(shapes::sphere(static_cast<float>(radius_m), 128, 64));
    scene.materials.emplace_back();
    scene.meshes[0].primitives[0].material = 1;
    for (const Camera& camera :
         {test::front_camera(5.0, 0.6), parallel_of(test::front_camera(5.0, 0.6), 1.4)}) {
        const SurfaceBuffers buffers = buffers_of(scene, camera);
        size_t covered = 0;
        for (uint32_t y = 0; y < buffers.height; ++y) {
            for (uint32_t x = 0; x < buffers.width; ++x) {
                const size_t i = size_t{y} * buffers.width + x;
                if (buffers.objects[i] == no_index) {
                    continue;
                }
                ++covered;
                ASSERT_EQ(buffers.objects[i], 0U);
                ASSERT_EQ(buffers.materials[i], 1U);
                // The place that depth and pixel give lies on the sphere, and its normal is its direction.
                const glm::dvec2 on_page(2.0 * (x + 0.5) / buffers.width - 1.0,
                                         1.0 - 2.0 * (y + 0.5) / buffers.height);
                const double half_m = camera.orthographic_half_height_m.value_or(
                    buffers.depth_m[i] * std::tan(0.5 * camera.vertical_fov_rad));
                const glm::dvec3 place(on_page.x * half_m * buffers.width / buffers.height,
                                       on_page.y * half_m, camera.eye.z - buffers.depth_m[i]);
                ASSERT_NEAR(glm::length(place), radius_m, 0.01);
                ASSERT_NEAR(glm::length(buffers.normals[i]), 1.0, 1e-4);
                ASSERT_GT(glm::dot(glm::dvec3(buffers.normals[i]), glm::normalize(place)), 0.995);
            }
        }
        EXPECT_GT(covered, 2000U);
        EXPECT_EQ(buffers.depth_m[0], std::numeric_limits<float>::infinity());
        EXPECT_EQ(buffers.normals[0], glm::vec3(0.0F));
        EXPECT_EQ(buffers.materials[0], no_index);
    }
}

TEST(SurfaceBuffers, MasksAgreeWithTheProjectionAlsoUnderALensShift)
{
    const glm::vec3 size_m(1.0F, 1.2F, 0.8F); // a box that stands on the ground
    const Scene scene = test::scene_of(shapes::box(size_m));
    const Camera straight{.eye = {0.4, 0.5, 5.0}, .target = {0.4, 0.5, 0.0}, .vertical_fov_rad = 0.8};
    for (const Camera& camera :
         {straight, with_shift(straight, {0.15, 0.2}), with_shift(straight, {-0.2, -0.1}),
          with_shift(parallel_of(straight, 1.5), {0.1, 0.15})}) {
        const SurfaceBuffers buffers = buffers_of(scene, camera);
        glm::dvec2 least(1e9);
        glm::dvec2 most(-1e9);
        for (size_t i = 0; i < buffers.objects.size(); ++i) {
            if (buffers.objects[i] == 0) {
                const glm::dvec2 corner(static_cast<double>(i % buffers.width),
                                        static_cast<double>(i / buffers.width));
                least = glm::min(least, corner);
                most = glm::max(most, corner + 1.0);
            }
        }
        glm::dvec2 expected_least(1e9);
        glm::dvec2 expected_most(-1e9);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 place(0.5 * ((corner & 1) != 0 ? size_m.x : -size_m.x),
                                   (corner & 2) != 0 ? size_m.y : 0.0F,
                                   0.5 * ((corner & 4) != 0 ? size_m.z : -size_m.z));
            const glm::dvec2 pixel = pixel_of(camera, place, {buffers.width, buffers.height});
            expected_least = glm::min(expected_least, pixel);
            expected_most = glm::max(expected_most, pixel);
        }
        EXPECT_LE(glm::length(least - expected_least), 0.75) << "half a pixel along each axis";
        EXPECT_LE(glm::length(most - expected_most), 0.75);
    }
}

TEST(SurfaceBuffers, HoldTheMotionThatIsAskedFor)
{
    const Scene scene = test::scene_of(shapes::sphere(1.0F));
    const Camera camera = test::front_camera(5.0, 0.6);
    RenderSettings settings = buffer_page;
    EXPECT_TRUE(buffers_of(scene, camera).motion.pixels.empty());
    settings.motion_since = Moment{.camera = with_shift(camera, {0.05, 0.0}), .time_s = 0.0};
    const SurfaceBuffers buffers = buffers_of(scene, camera, settings);
    ASSERT_EQ(buffers.motion.pixels.size(), buffers.objects.size());
    const size_t middle = size_t{buffers.height / 2} * buffers.width + buffers.width / 2;
    EXPECT_NEAR(buffers.motion.pixels[middle].x, 0.05 * buffers.width, 0.01)
        << "the shift to the right showed the sphere farther left before";
    EXPECT_NEAR(buffers.motion.pixels[middle].y, 0.0, 0.01);
}

TEST(SurfaceBuffers, LeaveTheNextPictureAsItIs)
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F}, {-0.6, 0.0, 0.0});
    test::add_sun(scene, {1.0, 2.0, 1.5});
    const Style style = without_margin();
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Image alone = renderer.render(test::corner_camera, style, buffer_page);
    renderer.set_scene(scene);
    const SurfaceBuffers first = renderer.render_buffers(test::corner_camera, style, buffer_page);
    EXPECT_EQ(renderer.render(test::corner_camera, style, buffer_page), alone);
    EXPECT_EQ(renderer.render_buffers(test::corner_camera, style, buffer_page).objects, first.objects);
}

TEST(SurfaceBuffers, AreBlankInTheMargin)
{
    Style style = without_margin();
    style.set("paper.margin_mm=20");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(test::scene_of(shapes::sphere(100.0F)));
    const Camera camera = test::front_camera(150.0, 0.6);
    RenderSettings settings = buffer_page;
    settings.motion_since = Moment{.camera = with_shift(camera, {0.1, 0.0}), .time_s = 0.0};
    const SurfaceBuffers buffers = renderer.render_buffers(camera, style, settings);
    EXPECT_EQ(buffers.motion.pixels[0], glm::vec4(0.0F));
    EXPECT_NE(buffers.motion.pixels[size_t{60} * 200 + 100], glm::vec4(0.0F));
    EXPECT_EQ(buffers.objects[0], no_index);
    EXPECT_EQ(buffers.objects[size_t{60} * 200 + 5], no_index);
    EXPECT_EQ(buffers.objects[size_t{60} * 200 + 100], 0U);
}

} // namespace
} // namespace estampe
