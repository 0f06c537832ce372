// SPDX-License-Identifier: MIT
// Ripples on a plane that the tests place in front of the eye.
#include "techniques/terrain/ripples/ripples.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/glsl.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::terrain {

namespace ripples_drawn_in_glsl {
using namespace test::glsl; // NOLINT(google-build-using-namespace): GLSL's names are the point
#include "techniques/terrain/ripples/ripples.glsl"
} // namespace ripples_drawn_in_glsl

namespace {

namespace in_glsl = ripples_drawn_in_glsl;

constexpr glm::uvec2 size_px(128, 96);
constexpr uint32_t sand = 5;

/// A plane in the world, below the eye.
struct SeenPlane {
    glm::dvec3 eye{3.0, 1.7, -2.0};
    double eye_height_m = 1.7;
    glm::dvec3 normal{0.0, 1.0, 0.0};
    glm::dvec3 anchor{0.0};
    double time_s = 0.0;

    [[nodiscard]] shared::FrameGlobals globals() const
    {
        const Camera camera{.eye = eye, .target = eye + glm::dvec3(1.0, -0.35, 0.4)};
        return features::frame_globals(camera, {}, anchor, {.size_px = size_px});
    }

    /// Position on the plane at a pixel, from the anchor; none above the horizon.
    [[nodiscard]] std::optional<glm::dvec3> place(glm::uvec2 pixel) const
    {
        const auto from_clip = glm::inverse(glm::dmat4(globals().clip_from_anchor));
        const glm::dvec2 ndc = 2.0 * (glm::dvec2(pixel) + 0.5) / glm::dvec2(size_px) - 1.0;
        const glm::dvec4 p = from_clip * glm::dvec4(ndc, 0.5, 1.0);
        const glm::dvec3 from = eye - anchor;
        const glm::dvec3 ray = glm::dvec3(p) / p.w - from;
        const double along = -glm::dot(normal, glm::dvec3(0.0, eye_height_m, 0.0)) / glm::dot(normal, ray);
        return along > 0.0 ? std::optional(from + along * ray) : std::nullopt;
    }

    [[nodiscard]] float depth(glm::uvec2 pixel) const
    {
        const auto at = place(pixel);
        const glm::dvec4 p =
            at ? glm::dmat4(globals().clip_from_anchor) * glm::dvec4(*at, 1.0) : glm::dvec4(1.0);
        return at ? static_cast<float>(p.z / p.w) : 0.0F;
    }
};

TerrainDescription dunes()
{
    TerrainDescription terrain;
    terrain.wind.towards_deg = 70.0F;
    return terrain;
}

struct Words {
    uint32_t shading = 0;
    uint32_t smooth = 0;
    bool operator==(const Words&) const = default;
};

/// Applies ripples; if `is_halved`, the left half belongs to another draw.
std::vector<Words> rippled(const SeenPlane& ground, bool is_halved = false)
{
    auto draw = test::Layer::words(size_px, [&](glm::uvec2 pixel) {
        return ground.depth(pixel) == 0.0F ? 0U : (is_halved && pixel.x < size_px.x / 2 ? sand : sand + 1U);
    });
    auto depth = test::Layer::depth(size_px, [&](glm::uvec2 pixel) { return ground.depth(pixel); });
    auto normal = test::Layer::normals(size_px, [&](glm::uvec2) { return glm::vec3(ground.normal); });
    auto frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{ground.globals()});
    gpu::Graph graph;
    const auto bent = add_ripples(graph,
                                  {.frame = gpu::import_whole(graph, "frame", frame),
                                   .draw = draw.in(graph),
                                   .depth = depth.in(graph),
                                   .normal = normal.in(graph),
                                   .size_px = size_px},
                                  ripples_at(dunes(), sand, ground.anchor, ground.time_s).value());
    return test::run_and_read_as<Words>(graph, bent);
}

std::vector<glm::vec3> shading_of(const std::vector<Words>& words)
{
    std::vector<glm::vec3> normals;
    std::ranges::transform(words, std::back_inserter(normals),
                           [](const Words& word) { return pose::unpack_normal(word.shading); });
    return normals;
}

TEST(SandRipples, BendNormalsAsTheirFormLeans)
{
    const SeenPlane ground{.eye = {1e6 + 3.0, 0.4, -2.0},
                           .eye_height_m = 0.4,
                           .anchor = {64.0 * 15625.0, 0.0, 0.0},
                           .time_s = 90.0};
    const auto words = rippled(ground);
    const auto normals = shading_of(words);
    const auto ripples = ripples_at(dunes(), sand, ground.anchor, ground.time_s).value();
    const glm::vec2 cells(shared::ripple_cell_along, shared::ripple_cell_across);
    const glm::vec2 across(-ripples.wind.y, ripples.wind.x);
    int close = 0;
    for (uint32_t y = size_px.y - 10; y < size_px.y; ++y) { // so near that no ripple is faded
        for (uint32_t x = 0; x < size_px.x; ++x) {
            const glm::dvec3 place = ground.place({x, y}).value();
            const glm::vec2 flat(place.x, place.z);
            const glm::vec2 at =
                ripples.rest + glm::vec2(glm::dot(flat, ripples.wind), glm::dot(flat, across)) /
                                   (ripples.wavelength_m * cells);
            const glm::vec2 lean = ripples.height_m / ripples.wavelength_m *
                                   in_glsl::ripple_lean(glm::ivec2(ripples.cell), at, ripples.meander, cells);
            const glm::vec2 rise = lean.x * ripples.wind + lean.y * across;
            const glm::vec3 wanted = glm::normalize(glm::vec3(-rise.x, 1.0F, -rise.y));
            close += glm::distance(wanted, normals[y * size_px.x + x]) < 5e-3F ? 1 : 0;
        }
    }
    EXPECT_EQ(close, 10 * size_px.x);
    EXPECT_GT(std::ranges::max(normals, {}, [](const glm::vec3& n) { return n.x; }).x, 0.2F);
}

TEST(SandRipples, AreGoneBeforeTheyAlias)
{
    // With increasing distance the mean equals that of the bare ground. Finally every byte is equal.
    float last_lean = 1.0F;
    for (const double height_m : {1.0, 4.0, 12.0, 60.0}) {
        const SeenPlane ground{.eye = {3.0, height_m, -2.0}, .eye_height_m = height_m};
        const auto words = rippled(ground);
        const auto normals = shading_of(words);
        glm::dvec3 mean(0.0);
        float lean = 0.0F;
        uint32_t seen = 0;
        for (uint32_t i = size_px.x * size_px.y / 2; i < normals.size(); ++i, ++seen) {
            mean += glm::dvec3(normals[i]);
            lean += glm::length(glm::vec2(normals[i].x, normals[i].z));
        }
        lean /= static_cast<float>(seen);
        EXPECT_NEAR(mean.x / seen, 0.0, 0.02) << height_m;
        EXPECT_NEAR(mean.z / seen, 0.0, 0.02) << height_m;
        EXPECT_TRUE(lean < last_lean || lean < 1e-4F) << height_m;
        last_lean = lean;
        for (uint32_t i = 0; height_m == 60.0 && i < words.size(); ++i) {
            EXPECT_EQ(words[i].shading, words[i].smooth);
            EXPECT_LT(glm::distance(normals[i], glm::vec3(0.0F, 1.0F, 0.0F)), 1e-3F);
        }
    }
}

TEST(SandRipples, StandStillUnderAMovingAnchor)
{
    const glm::dvec3 eye(1e6 + 3.0, 1.7, 40.0);
    const auto here = shading_of(rippled({.eye = eye, .anchor = {64.0 * 15625.0, 0.0, 0.0}}));
    const auto there = shading_of(rippled({.eye = eye, .anchor = {64.0 * 15624.0, 0.0, 64.0}}));
    int close = 0;
    int seen = 0;
    for (uint32_t i = size_px.x * size_px.y / 2; i < here.size(); ++i, ++seen) {
        close += glm::distance(here[i], there[i]) < 0.01F ? 1 : 0;
    }
    EXPECT_GT(close, seen * 99 / 100);
}

TEST(SandRipples, LeaveOtherDrawsAndTheSmoothNormalAsTheyAre)
{
    const auto words = rippled({.eye = {3.0, 0.6, -2.0}, .eye_height_m = 0.6}, true);
    const Words flat = words[size_px.x * (size_px.y - 1)];
    uint32_t bent = 0;
    for (uint32_t i = 0; i < words.size(); ++i) {
        EXPECT_EQ(words[i].smooth, flat.smooth);
        if (i % size_px.x < size_px.x / 2) {
            EXPECT_EQ(words[i].shading, flat.smooth);
        }
        bent += words[i].shading != words[i].smooth ? 1 : 0;
    }
    EXPECT_GT(bent, 1000U);
}

TEST(SandRipples, SlideFromSlipFaces)
{
    const auto bent = [](double slope_deg) {
        const double a = glm::radians(slope_deg);
        const auto words = rippled({.normal = {-std::sin(a), std::cos(a), 0.0}});
        return std::ranges::count_if(words, [](const Words& w) { return w.shading != w.smooth; });
    };
    EXPECT_GT(bent(10.0), 1000);
    EXPECT_EQ(bent(32.0), 0);
}

TEST(SandRipples, CostNothingWhereThereAreNone)
{
    Renderer& renderer = test::shared_renderer();
    const Camera camera{.eye = {0.0, 2.0, 0.0}, .target = {3.0, 1.0, 0.0}};
    const auto has_pass = [&](const Scene& scene) {
        renderer.set_scene(scene);
        std::ignore = renderer.render(camera, {}, {.width = 64, .height = 48});
        return renderer.graph_dot().find("ripples") != std::string::npos;
    };
    EXPECT_FALSE(has_pass(test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}))));
    Scene flat;
    TerrainDescription terrain{.nodes = {{.name = "height", .expression = "0"}}};
    flat.terrain.emplace(terrain);
    EXPECT_TRUE(has_pass(flat));
    terrain.ripples.height_m = 0.0F;
    flat.terrain.emplace(terrain);
    EXPECT_FALSE(has_pass(flat));
}

} // namespace
} // namespace estampe::terrain
