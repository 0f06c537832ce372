// SPDX-License-Identifier: MIT
// Smoke that tests fill a grid with, against what can be worked out by hand.
#include "techniques/smoke/smoke.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "frame/view.hpp"
#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::smoke {
namespace {

constexpr glm::uvec2 size_px(48, 40);
constexpr double near_m = 0.05;
constexpr uint32_t side = 32;
constexpr float cell_m = 1.0F / side;

/// Of a cell's middle, in a box of one metre.
using Density = std::function<float(glm::vec3)>;

/// A box of one metre about the origin, turned a little.
struct Turned {
    glm::dmat4 anchor_from_box = glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(0.3, 1.0, 0.2)));

    [[nodiscard]] Box box() const
    {
        glm::dmat4 box_from_grid = glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5));
        box_from_grid = glm::scale(box_from_grid, glm::dvec3(1.0 / side));
        return {.cells = glm::uvec3(side),
                .cell_m = cell_m,
                .grid_from_anchor = glm::mat4(glm::inverse(anchor_from_box * box_from_grid))};
    }
};

struct Seen {
    Camera camera{.eye = {0.4, 0.3, 2.2}, .target = {0.0, 0.05, 0.0}, .near_m = near_m};
    test::Painter<float> depth = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> lines = [](glm::uvec2) { return glm::vec4(0.0F); };
    std::vector<Lamp> lamps = {};
    float ambient = 1.0F;
};

struct Drawn {
    std::vector<glm::vec4> marched;
    std::vector<uint32_t> paint; ///< four bytes each
    std::vector<float> ink;
    shared::FrameGlobals frame;

    [[nodiscard]] float cover(size_t i) const { return static_cast<float>(paint[i] >> 24U) / 255.0F; }
};

Drawn draw(const Density& density, const SmokeStyle& style, const Seen& seen = {})
{
    gpu::Device& device = test::shared_device();
    const Box box = Turned().box();
    gpu::Image field(device, "density",
                     {.width = side, .height = side, .format = gpu::Format::r32f, .layers = side});
    gpu::upload_layers(device, field, [&](uint32_t z) {
        std::vector<float> numbers;
        for (uint32_t i = 0; i < side * side; ++i) {
            numbers.push_back(density((glm::vec3(i % side, i / side, z) + 0.5F) * cell_m));
        }
        const auto bytes = std::as_bytes(std::span(numbers));
        return gpu::LayerPixels{.levels = {{bytes.begin(), bytes.end()}}};
    });
    const shared::SmokeGlobals around =
        globals_of(box, style, {.lamps = seen.lamps, .ambient = seen.ambient});
    auto globals = gpu::upload_buffer(device, "smoke", std::vector{around});
    const Bounds bounds{.min = glm::dvec3(-1.0), .max = glm::dvec3(1.0)};
    Drawn drawn{.frame = frame::frame_globals(seen.camera, bounds, glm::dvec3(0.0), {.size_px = size_px})};
    auto frame = gpu::upload_buffer(device, "frame", std::vector{drawn.frame});
    auto depth = test::Layer::depth(size_px, seen.depth);
    auto lines = test::Layer::root_color(size_px, seen.lines);
    VolumeMemory memory;
    memory.provide(device, box.cells);
    for (int wanted = 0; wanted < 3; ++wanted) {
        gpu::Graph graph;
        const ViewInputs view{.frame = gpu::import_whole(graph, "frame", frame),
                              .globals = gpu::import_whole(graph, "smoke", globals),
                              .depth = depth.in(graph),
                              .size_px = size_px};
        const Volume volume = wanted == 0
                                  ? add_volume(graph, memory, style,
                                               {.globals = view.globals,
                                                .density = gpu::import_uploaded(graph, "density", field),
                                                .puff_count = puff_count_of(around)})
                                  : memory.import(graph);
        const gpu::ImageId marched = add_march(graph, volume, style, view);
        const Layer layer =
            add_ink(graph, style,
                    {.view = view, .marched = marched, .lines = lines.in(graph), .pixels_per_mm = 4.0F});
        if (wanted == 0) {
            drawn.marched = test::run_and_read_as<glm::vec4>(graph, marched);
        } else if (wanted == 1) {
            drawn.paint = test::run_and_read_as<uint32_t>(graph, layer.paint);
        } else {
            drawn.ink = test::run_and_read_coverage(graph, layer.ink);
        }
    }
    return drawn;
}

SmokeStyle plain(float extinction_per_m, Sampling sampling = Sampling::rays, float step = 0.7F)
{
    return {.drawn = true,
            .thickness = 0.1F * extinction_per_m,
            .puffs = false,
            .sampling = sampling,
            .step = step};
}

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

/// Through the middle of a pixel, in the box's own axes, which begin at its low corner.
Ray ray_of(const Drawn& drawn, const Camera& camera, size_t pixel)
{
    const glm::dvec2 ndc =
        2.0 * (glm::dvec2(pixel % size_px.x, pixel / size_px.x) + 0.5) / glm::dvec2(size_px) - 1.0;
    const auto point_at = [&](double depth) {
        const glm::dvec4 point =
            glm::inverse(glm::dmat4(drawn.frame.clip_from_anchor)) * glm::dvec4(ndc, depth, 1.0);
        return glm::dvec3(point) / point.w;
    };
    const bool is_parallel = camera.orthographic_half_height_m.has_value();
    const glm::dvec3 near = point_at(1.0);
    const glm::dvec3 origin = is_parallel ? near : camera.eye;
    const glm::dvec3 direction =
        is_parallel ? glm::normalize(camera.target - camera.eye) : glm::normalize(near - origin);
    const glm::dmat4 box_from_anchor = glm::inverse(Turned().anchor_from_box);
    return {glm::dvec3(box_from_anchor * glm::dvec4(origin, 1.0)) + 0.5,
            glm::dmat3(box_from_anchor) * direction};
}

/// How far a ray goes through the box, up to `most`.
double way_through_box(const Ray& ray, double most = 1e9)
{
    double from = 0.0;
    double to = most;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = -ray.origin[axis] / ray.direction[axis];
        const double b = (1.0 - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return std::max(to - from, 0.0);
}

std::vector<Camera> cameras()
{
    Camera parallel{.eye = {0.4, 0.3, 2.2}, .target = {0.0, 0.05, 0.0}, .near_m = near_m};
    parallel.orthographic_half_height_m = 0.9;
    return {
        Seen().camera,
        parallel,
        {.eye = {0.1, -0.05, 0.2}, .target = {0.3, 0.1, -1.0}, .near_m = near_m}}; // the last within the box
}

TEST(Smoke, SlabLetsThroughWhatBeerAndLambertSay)
{
    constexpr double extinction_per_m = 3.0;
    for (const float step : {0.3F, 0.7F, 3.0F}) {
        for (const Camera& camera : cameras()) {
            const Drawn drawn = draw([](glm::vec3) { return 0.75F; },
                                     plain(extinction_per_m, Sampling::rays, step), {.camera = camera});
            for (size_t i = 0; i < drawn.marched.size(); ++i) {
                const double way_m = way_through_box(ray_of(drawn, camera, i));
                EXPECT_NEAR(drawn.marched[i].x, 1.0 - std::exp(-0.75 * extinction_per_m * way_m), 1e-4) << i;
            }
        }
    }
}

TEST(Smoke, EndsWhereTheSceneBegins)
{
    constexpr double wall_m = 2.1; // before the eye
    const Seen seen{.depth = [](glm::uvec2 pixel) {
        return pixel.x < size_px.x / 2 ? static_cast<float>(near_m / wall_m) : 0.0F;
    }};
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, plain(2.0F), seen);
    const glm::dvec3 forward = glm::normalize(seen.camera.target - seen.camera.eye);
    const glm::dmat4 box_from_anchor = glm::inverse(Turned().anchor_from_box);
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, seen.camera, i);
        const double along = glm::dot(ray.direction, glm::dmat3(box_from_anchor) * forward);
        const double most_m = i % size_px.x < size_px.x / 2 ? wall_m / along : 1e9;
        EXPECT_NEAR(drawn.marched[i].x, 1.0 - std::exp(-2.0 * way_through_box(ray, most_m)), 2e-4) << i;
    }
}

TEST(Smoke, WhiteFurnaceStaysWhite)
{
    std::mt19937 random(3);
    for (const Sampling sampling : {Sampling::rays, Sampling::axis, Sampling::view}) {
        for (const float step : {0.3F, 3.0F}) {
            const Drawn drawn = draw([&](glm::vec3) { return static_cast<float>(random() % 1000) * 0.002F; },
                                     plain(8.0F, sampling, step));
            double most = 0.0;
            for (const glm::vec4& pixel : drawn.marched) {
                most = std::max(most, static_cast<double>(pixel.x));
                // Light is 1 everywhere, also behind: what smoke takes of it, it gives back.
                EXPECT_NEAR(pixel.x * pixel.y + (1.0F - pixel.x), 1.0F, 0.02F);
            }
            EXPECT_GT(most, 0.95);
        }
    }
}

TEST(Smoke, ThreeWaysOfLookingUpAgreeWithABallsChord)
{
    constexpr double radius = 0.45;
    constexpr double extinction_per_m = 6.0;
    const Density ball = [](glm::vec3 place) {
        const double off = glm::length(glm::dvec3(place) - 0.5) / radius;
        return static_cast<float>(off < 1.0 ? (1.0 - off * off) * (1.0 - off * off) : 0.0);
    };
    for (const Sampling sampling : {Sampling::rays, Sampling::axis, Sampling::view}) {
        const Drawn drawn = draw(ball, plain(extinction_per_m, sampling));
        for (size_t i = 0; i < drawn.marched.size(); ++i) {
            const Ray ray = ray_of(drawn, Seen().camera, i);
            const glm::dvec3 to_middle = glm::dvec3(0.5) - ray.origin;
            const double aside = glm::length(glm::cross(ray.direction, to_middle)) / radius;
            const double inside = std::max(1.0 - aside * aside, 0.0);
            const double depth = extinction_per_m * radius * 16.0 / 15.0 * std::pow(inside, 2.5);
            EXPECT_NEAR(drawn.marched[i].x, 1.0 - std::exp(-depth), 0.01) << i;
        }
    }
}

TEST(Smoke, PlanesOfTheGridStandFast)
{
    // Between planes four cells apart there is smoke that none of them sees, at whatever slant.
    const Density between = [](glm::vec3 place) {
        const auto layer = static_cast<uint32_t>(place.z / cell_m) % 4;
        return layer == 1 || layer == 2 ? 1.0F : 0.0F;
    };
    const auto most = [&](Sampling sampling) {
        const Drawn drawn = draw(between, plain(8.0F, sampling, 4.0F));
        return std::ranges::max(drawn.marched, {}, &glm::vec4::x).x;
    };
    EXPECT_EQ(most(Sampling::axis), 0.0F);
    EXPECT_GT(most(Sampling::rays), 0.5F);
}

TEST(Smoke, LightIsWeakenedOnItsWayIn)
{
    constexpr double extinction_per_m = 2.0;
    const glm::dmat3 turn(Turned().anchor_from_box);
    Camera camera{
        .eye = turn * glm::dvec3(0.0, 0.0, 2.0), .target = {0.0, 0.0, 0.0}, .up = turn[1], .near_m = near_m};
    camera.orthographic_half_height_m = 0.6;
    const Seen seen{
        .camera = camera, .lamps = {{.place = glm::vec3(turn[1]), .luminance = 0.75F}}, .ambient = 0.25F};
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, plain(extinction_per_m), seen);
    size_t count = 0;
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, camera, i);
        if (ray.origin.y > 0.1 && ray.origin.y < 0.9 && way_through_box(ray) > 0.0) {
            // The box's top is at 1, and each ray keeps its height.
            EXPECT_NEAR(drawn.marched[i].y, 0.25 + 0.75 * std::exp(-extinction_per_m * (1.0 - ray.origin.y)),
                        0.01);
            ++count;
        }
    }
    EXPECT_GT(count, 500U);
}

TEST(Smoke, NothingIsDrawnWhereThereIsNone)
{
    const Camera away{.eye = {0.4, 0.3, 2.2}, .target = {0.0, 0.3, 5.0}, .near_m = near_m};
    for (const Drawn& drawn : {draw([](glm::vec3) { return 0.0F; }, {.drawn = true}),
                               draw([](glm::vec3) { return 1.0F; }, {.drawn = true}, {.camera = away})}) {
        for (size_t i = 0; i < drawn.marched.size(); ++i) {
            EXPECT_EQ(drawn.marched[i].x, 0.0F);
            EXPECT_EQ(drawn.cover(i), 0.0F);
            EXPECT_EQ(drawn.ink[i], 0.0F);
        }
    }
}

TEST(Smoke, ALineGoesAroundIt)
{
    const Density ball = [](glm::vec3 place) { return glm::length(place - 0.5F) < 0.35F ? 1.0F : 0.0F; };
    SmokeStyle style = plain(100.0F);
    style.medium = Medium::wash;
    style.line_mm = 0.5F; // two pixels
    const Drawn drawn = draw(ball, style);
    const auto covers = [&](int x, int y) {
        return drawn.cover(static_cast<size_t>(y) * size_px.x + static_cast<size_t>(x)) > 0.5F;
    };
    size_t on_edge = 0;
    for (int y = 5; y < static_cast<int>(size_px.y) - 5; ++y) {
        for (int x = 5; x < static_cast<int>(size_px.x) - 5; ++x) {
            const float ink = drawn.ink[static_cast<size_t>(y) * size_px.x + static_cast<size_t>(x)];
            const bool is_edge = covers(x, y) && !(covers(x - 1, y) && covers(x + 1, y) && covers(x, y - 1) &&
                                                   covers(x, y + 1));
            bool is_near_end = false;
            for (int i = 0; i < 121; ++i) {
                is_near_end = is_near_end || !covers(x + i % 11 - 5, y + i / 11 - 5);
            }
            on_edge += is_edge ? 1 : 0;
            EXPECT_TRUE(!is_edge || ink > 0.4F) << x << ", " << y;
            EXPECT_TRUE(is_near_end || ink == 0.0F) << x << ", " << y;
        }
    }
    EXPECT_GT(on_edge, 20U);
}

TEST(Smoke, LinesOfWhatStandsBeforeItStay)
{
    // Whatever lies before the smoke ends in the middle of the page; its line reaches beyond.
    const Seen seen{
        .depth = [](glm::uvec2 pixel) { return pixel.x < 24 ? static_cast<float>(near_m / 1.0) : 0.0F; },
        .lines = [](glm::uvec2 pixel) { return glm::vec4(0.0F, 0.0F, 0.0F, pixel.x == 24 ? 1.0F : 0.0F); }};
    const Drawn drawn = draw([](glm::vec3) { return 1.0F; }, plain(100.0F), seen);
    const size_t row = size_t{20} * size_px.x;
    EXPECT_EQ(drawn.cover(row + 20), 0.0F);
    EXPECT_EQ(drawn.cover(row + 24), 0.0F) << "the line's";
    EXPECT_GT(drawn.cover(row + 28), 0.9F);
}

TEST(Smoke, PuffsAreRoundAndOnlyWhereItIsDense)
{
    const Density half = [](glm::vec3 place) { return place.x < 0.5F ? 1.0F : 0.0F; };
    SmokeStyle style{.drawn = true};
    style.puff = 0.2F;
    const Drawn drawn = draw(half, style);
    size_t drawn_far = 0;
    size_t drawn_dense = 0;
    size_t dense = 0;
    for (size_t i = 0; i < drawn.marched.size(); ++i) {
        const Ray ray = ray_of(drawn, Seen().camera, i);
        Ray in_half = ray; // the dense half as a box of its own
        in_half.origin.x *= 2.0;
        in_half.direction.x *= 2.0;
        dense += way_through_box(in_half) > 0.3 ? 1 : 0;
        drawn_dense += way_through_box(in_half) > 0.3 && drawn.cover(i) > 0.5F ? 1 : 0;
        Ray in_rest = ray; // farther off than a puff is large
        in_rest.origin.x = (ray.origin.x - 0.7) / 0.3;
        in_rest.direction.x /= 0.3;
        drawn_far += way_through_box(in_rest) > 0.0 && way_through_box(in_half) == 0.0 &&
                             drawn.marched[i].z > 0.0F &&
                             (ray.origin + static_cast<double>(drawn.marched[i].z) * ray.direction).x > 0.75
                         ? 1
                         : 0;
    }
    EXPECT_GT(static_cast<double>(drawn_dense), 0.9 * static_cast<double>(dense));
    EXPECT_EQ(drawn_far, 0U);
}

} // namespace
} // namespace estampe::smoke
