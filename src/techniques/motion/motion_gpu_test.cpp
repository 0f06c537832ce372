// SPDX-License-Identifier: MIT
// Motion compared with projections in double precision, and hatching warped by motion.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "scene/pose.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr uint32_t page_width_px = 96;
constexpr uint32_t page_height_px = 64;
constexpr double page_fov_rad = 0.7;
constexpr glm::uvec2 small_px(page_width_px, page_height_px);

Camera camera_at(const glm::dvec3& eye, const glm::dvec3& target)
{
    Camera camera{.eye = eye, .target = target, .vertical_fov_rad = page_fov_rad};
    camera.near_m = 0.1;
    return camera;
}

/// A camera's axes: right, down the page, forward.
glm::dmat3 axes_of(const Camera& camera)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    return {right, glm::cross(forward, right), forward};
}

/// Page position in pixels of the point that the eye sees in a direction.
glm::dvec2 page_of(const Camera& camera, const glm::dvec3& from_eye)
{
    const glm::dvec3 view = glm::transpose(axes_of(camera)) * from_eye;
    const double scale = 0.5 * page_height_px / std::tan(0.5 * page_fov_rad);
    return glm::dvec2(0.5 * page_width_px, 0.5 * page_height_px) + scale * glm::dvec2(view) / view.z;
}

glm::dvec3 page_ray(const Camera& camera, const glm::dvec2& page_px)
{
    const double scale = 0.5 * page_height_px / std::tan(0.5 * page_fov_rad);
    return axes_of(camera) *
           glm::dvec3((page_px - glm::dvec2(0.5 * page_width_px, 0.5 * page_height_px)) / scale, 1.0);
}

glm::dvec2 centre_of(size_t pixel)
{
    const size_t column = pixel % page_width_px;
    const size_t row = pixel / page_width_px;
    return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

RenderSettings settings_at(double time_s, const std::optional<Moment>& since, glm::uvec2 size_px = small_px)
{
    return {.width = size_px.x, .height = size_px.y, .time_s = time_s, .motion_since = since};
}

/// Motion vectors on the page from one moment to another.
const Motion& draw_motion(const Moment& since, const Moment& now)
{
    Style bare;
    bare.set("picture.ground=false");
    bare.set("paper.margin_mm=0");
    static_cast<void>(test::shared_renderer().render(now.camera, bare, settings_at(now.time_s, since)));
    return test::shared_renderer().motion();
}

/// A square of 2 m that moves and turns for one second.
struct Wall {
    static glm::dmat4 place(double time_s)
    {
        const glm::dvec3 position = glm::mix(glm::dvec3(-0.3, 0.1, 0.0), glm::dvec3(0.4, -0.1, 0.3), time_s);
        return glm::translate(glm::dmat4(1.0), position);
    }

    static Scene scene()
    {
        Scene scene;
        test::add_object(scene, shapes::quad(2.0F, 2.0F), glm::vec3(0.5F), glm::dvec3(place(0.0)[3]));
        Animation animation;
        animation.name = "move";
        animation.duration_s = 1.0F;
        animation.channels.push_back({.node = 0,
                                      .path = AnimatedPath::translation,
                                      .interpolation = Interpolation::linear,
                                      .times_s = {0.0F, 1.0F},
                                      .values = {}});
        for (const double time_s : {0.0, 1.0}) {
            for (int k = 0; k < 3; ++k) {
                animation.channels.back().values.push_back(static_cast<float>(place(time_s)[3][k]));
            }
        }
        scene.animations.push_back(std::move(animation));
        return scene;
    }
};

TEST(Motion, BetweenEqualMomentsNothingMoves)
{
    test::shared_renderer().set_scene(Wall::scene());
    const Moment moment{camera_at({0.5, 0.3, 3.0}, {0.0, 0.0, 0.0}), 0.4};
    for (int frame = 0; frame < 2; ++frame) {
        const Motion& motion = draw_motion(moment, moment);
        ASSERT_EQ(motion.pixels.size(), size_t{page_width_px} * page_height_px);
        for (const glm::vec4& pixel : motion.pixels) {
            ASSERT_EQ(glm::vec2(pixel), glm::vec2(0.0F));
            ASSERT_EQ(pixel.w, 1.0F);
        }
    }
    static_cast<void>(test::shared_renderer().render(moment.camera, {}, settings_at(0.4, std::nullopt)));
    EXPECT_TRUE(test::shared_renderer().motion().pixels.empty());
}

TEST(Motion, IsThatOfTheWallAndTheCamera)
{
    test::shared_renderer().set_scene(Wall::scene());
    const Camera first = camera_at({0.5, 0.3, 3.0}, {0.0, 0.0, 0.0});
    const Camera second = camera_at({0.3, 0.35, 2.8}, {0.05, 0.05, 0.0});
    const std::vector<glm::vec4> motion = draw_motion({first, 0.2}, {second, 0.6}).pixels;
    const glm::dvec3 wall_moved = glm::dvec3(Wall::place(0.6)[3] - Wall::place(0.2)[3]);
    const double wall_z = Wall::place(0.6)[3].z;
    size_t on_wall = 0;
    for (size_t i = 0; i < motion.size(); ++i) {
        const glm::dvec3 ray = page_ray(second, centre_of(i));
        glm::dvec3 before = ray; // infinitely far
        if (motion[i].z > 0.0F) {
            const glm::dvec3 seen = second.eye + ray * ((wall_z - second.eye.z) / ray.z);
            before = seen - wall_moved - first.eye;
            ++on_wall;
            const double away = glm::dot(before, axes_of(first)[2]);
            ASSERT_NEAR(motion[i].z * away / first.near_m, 1.0, 1e-4);
        }
        const glm::dvec2 expected = centre_of(i) - page_of(first, before);
        ASSERT_LT(glm::distance(glm::dvec2(motion[i]), expected), 0.01) << i;
        ASSERT_EQ(motion[i].w, 1.0F);
    }
    EXPECT_GT(on_wall, motion.size() / 4);
    EXPECT_LT(on_wall, motion.size() - 100);
    // Pictures drawn in between do not matter, and time may run backwards.
    EXPECT_NE(draw_motion({second, 0.6}, {first, 0.1}).pixels, motion);
    EXPECT_EQ(draw_motion({first, 0.2}, {second, 0.6}).pixels, motion);
}

/// A ball with morph targets, a skinned tube, and a box that turns.
Scene bodies()
{
    Scene scene;
    Animation animation{.name = "all", .channels = {}, .duration_s = 1.0F};
    Primitive ball = shapes::sphere(0.5F, 24, 16);
    MorphTarget& offsets = ball.morph_targets.emplace_back();
    for (const glm::vec3& p : ball.positions) {
        offsets.position_offsets.emplace_back(0.4F * p.y, 0.8F * p.x * p.x, 0.3F);
        offsets.normal_offsets.emplace_back(0.0F);
    }
    animation.channels.push_back({.node = test::add_object(scene, ball, glm::vec3(0.5F), {-1.1, 0.0, 0.0}),
                                  .path = AnimatedPath::weights,
                                  .times_s = {0.0F, 1.0F},
                                  .values = {0.0F, 1.0F}});
    scene.meshes.back().morph_weights = {0.0F};
    animation.channels.push_back(
        {.node = test::add_object(scene, shapes::box({0.6F, 0.9F, 0.5F}), glm::vec3(0.5F), {1.1, -0.5, 0.0}),
         .path = AnimatedPath::rotation,
         .times_s = {0.0F, 1.0F},
         .values = {0.0F, 0.0F, 0.0F, 1.0F, 0.3F, 0.6F, 0.1F, 0.73F}});
    Primitive tube = shapes::cylinder(0.25F, 1.6F, 20);
    for (const glm::vec3& p : tube.positions) {
        const float bent = glm::clamp(p.y / 1.6F, 0.0F, 1.0F);
        tube.joints_0.emplace_back(0, 1, 0, 0);
        tube.weights_0.emplace_back(1.0F - bent, bent, 0.0F, 0.0F);
    }
    const Index skinned = test::add_object(scene, tube, glm::vec3(0.5F));
    scene.nodes[skinned].skin = 0;
    scene.skins.push_back(
        {.joints = {skinned + 1, skinned + 2}, .joint_from_bind = {glm::mat4(1.0F), glm::mat4(1.0F)}});
    for (int joint = 0; joint < 2; ++joint) {
        scene.nodes.push_back({.transform = {.translation = {0.0, -0.8, 0.1}}});
        scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    }
    animation.channels.push_back({.node = skinned + 2,
                                  .path = AnimatedPath::translation,
                                  .times_s = {0.0F, 1.0F},
                                  .values = {0.0F, -0.8F, 0.1F, 0.5F, -0.7F, 0.6F}});
    scene.animations.push_back(std::move(animation));
    return scene;
}

/// The posed vertices of each node at a given time.
std::map<Index, std::vector<glm::dvec3>> posed_at(const Scene& scene, double time_s)
{
    std::map<Index, std::vector<glm::dvec3>> result;
    visit_posed(scene, pose_scene(scene, time_s), [&](const PosedPrimitive& posed) {
        result[posed.node].assign(posed.positions.begin(), posed.positions.end());
    });
    return result;
}

TEST(Motion, IsThatOfEachVertexOfWhatMorphsBendsAndTurns)
{
    const Scene scene = bodies();
    const Moment since{camera_at({0.4, 0.5, 3.6}, {0.0, 0.05, 0.0}), 0.3};
    const Moment now{camera_at({0.1, 0.3, 3.4}, {0.05, 0.0, 0.0}), 0.7};
    test::shared_renderer().set_scene(scene);
    const std::vector<glm::vec4> motion = draw_motion(since, now).pixels;
    const test::EmbreeScene rays(scene, now.time_s);
    const auto before = posed_at(scene, since.time_s);
    std::map<Index, size_t> compared;
    size_t elsewhere = 0; // pixels at outlines may see another triangle
    double worst_px = 0.0;
    for (size_t i = 0; i < motion.size(); ++i) {
        const glm::dvec3 ray = glm::normalize(page_ray(now.camera, centre_of(i)));
        const auto hit = rays.first_hit(now.camera.eye, ray);
        if (!hit) {
            continue;
        }
        const uint32_t* corner = &hit->primitive->indices[3 * size_t{hit->triangle}];
        const std::vector<glm::dvec3>& stood = before.at(hit->node);
        const glm::dvec3 point = (1.0 - hit->weight.x - hit->weight.y) * stood[corner[0]] +
                                 hit->weight.x * stood[corner[1]] + hit->weight.y * stood[corner[2]];
        const glm::dvec3 from_eye = point - since.camera.eye;
        const double off_px =
            glm::distance(glm::dvec2(motion[i]), centre_of(i) - page_of(since.camera, from_eye));
        const double depth = since.camera.near_m / glm::dot(from_eye, axes_of(since.camera)[2]);
        if (off_px > 0.02 || std::abs(motion[i].z / depth - 1.0) > 1e-3) {
            ++elsewhere;
            continue;
        }
        worst_px = std::max(worst_px, off_px);
        ++compared[hit->node];
    }
    std::printf("%zu pixels of another triangle; all others within %.5f px\n", elsewhere, worst_px);
    EXPECT_LE(elsewhere, 12U);
    for (const Index node : {0U, 1U, 2U}) {
        EXPECT_GT(compared[node], 150U) << node;
    }
}

TEST(Motion, LeavesThePictureAsItIs)
{
    Scene scene = bodies();
    scene.lights.push_back({.type = LightType::point, .intensity = 40.0F});
    scene.nodes.push_back({.transform = {.translation = {0.5, 1.8, 2.0}}, .light = 0});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    Style adapting;
    adapting.set("light.metering=page");
    const Camera camera = camera_at({0.4, 0.5, 3.6}, {0.0, 0.05, 0.0});
    const auto last_of = [&](bool with_motion) {
        Renderer renderer(test::validated());
        renderer.set_scene(scene);
        Image image;
        for (const double time_s : {0.1, 0.2}) {
            const Moment since{camera_at({0.0, 0.0, 9.0}, {0.0, 0.0, 0.0}), time_s - 0.07};
            image = renderer.render(camera, adapting,
                                    settings_at(time_s, with_motion ? std::optional(since) : std::nullopt));
        }
        return image.rgba;
    };
    EXPECT_EQ(last_of(true), last_of(false));
}

TEST(Motion, WhatWasBehindTheEyeIsNotKnown)
{
    Scene scene;
    test::add_object(scene, shapes::quad(40.0F, 40.0F), glm::vec3(0.5F), {0.0, -20.0, 0.0});
    test::shared_renderer().set_scene(scene);
    const Moment since{camera_at({0.0, 0.0, -3.0}, {0.0, 0.0, -6.0})};
    for (const glm::vec4& pixel : draw_motion(since, {camera_at({0.0, 0.0, 3.0}, {0.0, 0.0, 0.0})}).pixels) {
        ASSERT_EQ(pixel, glm::vec4(0.0F));
    }
}

double smooth_brightness(const Image& image, const glm::dvec2& page_px)
{
    const glm::dvec2 corner = page_px - 0.5;
    const auto x = static_cast<size_t>(corner.x);
    const auto y = static_cast<size_t>(corner.y);
    const glm::dvec2 part = corner - glm::dvec2(x, y);
    const auto at = [&](size_t column, size_t row) {
        return image.rgba[4 * (row * image.width + column)] / 255.0;
    };
    return glm::mix(glm::mix(at(x, y), at(x + 1, y), part.x),
                    glm::mix(at(x, y + 1), at(x + 1, y + 1), part.x), part.y);
}

TEST(Motion, HatchingHoldsStillUnderIt)
{
    Style ink;
    for (const char* assignment :
         {"wash.strength=0", "contour.enabled=false", "paper.grain=0", "paper.ink_break=0",
          "paper.color=#ffffff", "paper.ink=#000000", "sky.enabled=false", "hatch.width_mm=10",
          "paper.granulation=0", "picture.ground=false", "light.exposure_stops=-2", "paper.margin_mm=0"}) {
        ink.set(assignment);
    }
    Scene scene = test::scene_of(shapes::plane(60.0F, 60.0F));
    test::add_sun(scene, {-1.0, 2.0, 2.0});
    test::shared_renderer().set_scene(scene);
    // Strokes of 30 pixels: interpolated lookups blur edges by half a pixel, which counts as motion, more so
    // for finer strokes.
    constexpr glm::uvec2 large(720, 480);
    const auto camera = [](int step) {
        const double distance_m = 4.0 * std::pow(0.99, step);
        return camera_at({0.0, distance_m, 0.6 * distance_m}, {0.0, 0.0, 0.0});
    };
    const auto frame = [&](int step) {
        RenderSettings how = settings_at(0.0, Moment{camera(step - 1)}, large);
        how.samples = 4;
        return test::shared_renderer().render(camera(step), ink, how);
    };
    Image before = frame(0);
    double warped = 0.0;
    double still = 0.0;
    double count = 0.0;
    for (int step = 1; step <= 2; ++step) {
        const Image now = frame(step);
        const std::vector<glm::vec4>& motion = test::shared_renderer().motion().pixels;
        for (size_t i = 0; i < motion.size(); ++i) {
            const size_t column = i % large.x;
            const size_t row = i / large.x;
            const glm::dvec2 here(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
            const glm::dvec2 there = here - glm::dvec2(motion[i]);
            if (there.x > 1.0 && there.y > 1.0 && there.x < large.x - 1.0 && there.y < large.y - 1.0) {
                const double tone = now.rgba[4 * i] / 255.0;
                warped += std::abs(tone - smooth_brightness(before, there));
                still += std::abs(tone - before.rgba[4 * i] / 255.0);
                count += 1.0;
            }
        }
        before = now;
    }
    EXPECT_GT(count, 100000.0);
    EXPECT_LT(warped / count, 0.02);
    EXPECT_GT(still / count, 3.0 * warped / count);
    RecordProperty("warp_error", std::to_string(warped / count));
    std::printf("warp error %.4f, without the warp %.4f\n", warped / count, still / count);
}

} // namespace
} // namespace estampe
