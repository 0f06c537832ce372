// SPDX-License-Identifier: MIT
// Teeth and penumbrae of the shadows of lamps and spots: their properties, and a comparison with ray tracing.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/crawl.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/scenes.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 edge_px(200, 150);
constexpr float lamp_reach_px = 4.0F;

/// A spherical lamp in world space.
struct GlowingLamp {
    glm::dvec3 position{0.0};
    double radius_m = 0.0;
    uint32_t map_texels = 512;        ///< per side
    std::optional<glm::dvec3> target; ///< the spot's target, if it is a spot; its half angle is 40 degrees
};

shared::LightRecord record_of_glow(const GlowingLamp& lamp, const glm::dvec3& anchor)
{
    shared::LightRecord record{};
    record.position = glm::vec3(lamp.position - anchor);
    record.range_m = 60.0F;
    record.color = glm::vec3(30.0F);
    record.groups = 0xffffffffU;
    record.type = shared::light_point;
    record.radius_m = static_cast<float>(lamp.radius_m);
    if (lamp.target) {
        constexpr float outer = 0.766F;
        record.type = shared::light_spot;
        record.direction = glm::vec3(glm::normalize(*lamp.target - lamp.position));
        record.cone_scale = 1.0F / (0.80F - outer);
        record.cone_offset = -outer * record.cone_scale;
    }
    return record;
}

struct LampLit {
    std::vector<double> share; ///< share of the lamp that arrives; 1 where it does not shine anyway
    std::vector<bool> lightable;
    std::vector<glm::dvec3> point;
    std::vector<glm::dvec3> normal;
};

LampLit lit_by_lamp(const Scene& scene, const Camera& camera, const GlowingLamp& lamp,
                    const ShadowStyle& style = {}, const std::optional<HatchedLines>& lines = std::nullopt)
{
    test::Drawing drawing(scene, camera, edge_px);
    const shared::LightRecord record = record_of_glow(lamp, drawing.layout.anchor);
    const auto dark = drawing.light(
        {.records = {record}, .local_shadow_size = lamp.map_texels, .shadow = style, .lines = lines});
    const auto open = drawing.light({.records = {record}});
    const auto surface = drawing.surface();
    LampLit result;
    for (size_t i = 0; i < dark.size(); ++i) {
        result.point.push_back(drawing.point_seen(i, surface.depth[i]) + drawing.layout.anchor);
        result.normal.emplace_back(surface.smooth_normal[i]);
        const double facing =
            glm::dot(result.normal.back(), glm::normalize(lamp.position - result.point.back()));
        result.lightable.push_back(surface.draw[i] != 0 && open[i].x > 0.01F && facing > 0.03);
        result.share.push_back(result.lightable.back() ? static_cast<double>(dark[i].x / open[i].x) : 1.0);
    }
    return result;
}

/// Visible share of a luminous sphere, traced with 256 rays.
double traced_lamp(const test::EmbreeScene& rays, const glm::dvec3& from, const GlowingLamp& lamp)
{
    const glm::dvec3 way = glm::normalize(lamp.position - from);
    const glm::dvec3 right = glm::normalize(glm::cross(way, glm::dvec3(0.1, 0.2, 0.9)));
    const glm::dvec3 up = glm::cross(right, way);
    int open = 0;
    for (int i = 0; i < 256; ++i) {
        const double away = lamp.radius_m * std::sqrt((i + 0.5) / 256.0);
        const double angle = 2.399963229728653 * i;
        open += rays.is_between(from, lamp.position + away * (right * std::cos(angle) + up * std::sin(angle)))
                    ? 0
                    : 1;
    }
    return open / 256.0;
}

/// A box with an open front, and bodies in it.
Scene furnished_room()
{
    Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F));
    test::add_object(scene, shapes::box({4.0F, 4.0F, 0.1F}), glm::vec3(1.0F), {0.0, 0.0, -2.0});
    test::add_object(scene, shapes::box({0.1F, 4.0F, 4.0F}), glm::vec3(1.0F), {-2.0, 0.0, 0.0});
    test::add_object(scene, shapes::box({0.1F, 4.0F, 4.0F}), glm::vec3(1.0F), {2.0, 0.0, 0.0});
    test::add_object(scene, shapes::box({0.9F, 1.8F, 0.9F}), glm::vec3(1.0F), {-0.7, 0.0, -0.6});
    scene.nodes.back().transform.rotation = glm::angleAxis(0.35, glm::dvec3(0, 1, 0));
    test::add_object(scene, shapes::sphere(0.5F, 96, 48), glm::vec3(1.0F), {0.8, 0.5, 0.5});
    test::add_object(scene, shapes::box({0.06F, 2.6F, 0.06F}), glm::vec3(1.0F), {1.2, 0.0, -0.9});
    return scene;
}

/// A camera above the floor on which the shadows fall.
const Camera room_from_above{.eye = {0.6, 6.5, 5.0}, .target = {0.0, 0.4, -0.2}, .vertical_fov_rad = 0.6};

TEST(LampPenumbra, AgreesWithRaysOverTheBall)
{
    const Scene scene = furnished_room();
    const test::EmbreeScene rays(scene);
    // A lamp this small has penumbrae about one texel wide in smaller maps, which then cannot resolve its
    // visible share.
    const GlowingLamp lamps[] = {
        {.position = {0.3, 3.3, 0.6}, .radius_m = 0.03, .map_texels = 2048},
        {.position = {0.3, 3.3, 0.6}, .radius_m = 0.12},
        {.position = {0.3, 3.3, 0.6}, .radius_m = 0.4},
        {.position = {1.6, 3.2, 1.8}, .radius_m = 0.15, .target = glm::dvec3(-0.5, 0.3, -0.6)}};
    for (const GlowingLamp& lamp : lamps) {
        const LampLit soft = lit_by_lamp(scene, room_from_above, lamp);
        double error = 0.0;
        size_t compared = 0;
        double partly_error = 0.0;
        size_t partly = 0;
        for (size_t i = 0; i < soft.share.size(); i += 3) {
            if (!soft.lightable[i]) {
                continue;
            }
            const double share = traced_lamp(rays, soft.point[i] + 3e-4 * soft.normal[i], lamp);
            const double off = std::abs(soft.share[i] - share);
            const bool is_partly = share > 0.01 && share < 0.99;
            error += off;
            ++compared;
            partly += is_partly ? 1U : 0U;
            partly_error += is_partly ? off : 0.0;
        }
        fmt::print("{} of {} m: mean error {:.4f}; in penumbrae {:.4f}, {} of {} px\n",
                   lamp.target ? "spot" : "lamp", lamp.radius_m, error / static_cast<double>(compared),
                   partly_error / static_cast<double>(std::max<size_t>(partly, 1)), partly, compared);
        EXPECT_LT(error / static_cast<double>(compared), 0.004);
        EXPECT_GT(compared, 2000U);
        EXPECT_GT(partly, 70U);
        EXPECT_LT(partly_error / static_cast<double>(partly), 0.035);
    }
}

Scene board()
{
    Scene scene = test::scene_of(shapes::plane(16.0F, 16.0F));
    test::add_object(scene, shapes::box({1.6F, 0.05F, 1.6F}), glm::vec3(1.0F), {0.0, 3.0, 0.0});
    return scene;
}

/// Sees the board's shadow from `distance`, but not the board.
Camera under_board(double distance, double aside_m = 0.0)
{
    const glm::dvec3 target(-1.2 + aside_m, 0.0, 0.6);
    return {.eye = target + distance * glm::normalize(glm::dvec3(-0.2, 0.6, 1.0)),
            .target = target,
            .vertical_fov_rad = 0.6};
}

const GlowingLamp over_board{.position = {0.7, 6.0, 0.2}};
const GlowingLamp spot_on_board{.position = {0.7, 6.0, 0.2}, .target = glm::dvec3(-0.2, 0.0, 0.0)};

struct LampTeeth {
    const char* name;
    GlowingLamp lamp;
    ShadowStyle style;
    std::optional<HatchedLines> lines;
};

std::vector<LampTeeth> all_lamp_teeth()
{
    const ShadowStyle waves{
        .edge = Edge::waves, .edge_reach_mm = lamp_reach_px, .edge_spacing_mm = 3.0F, .edge_variety = 0.5F};
    ShadowStyle strokes = waves;
    strokes.edge = Edge::strokes;
    const HatchedLines lines{.width_mm = 1.5F};
    return {{"waves of a lamp", over_board, waves, std::nullopt},
            {"waves of a spot", spot_on_board, waves, std::nullopt},
            {"strokes of a lamp", over_board, strokes, lines},
            {"strokes of a spot", spot_on_board, strokes, lines}};
}

/// Distance in pixels from a pixel to the nearest edge of a plain shadow; at most 8.
double to_edge_px(const LampLit& plain, size_t pixel)
{
    constexpr int most = 8;
    const auto x = static_cast<int>(pixel % edge_px.x);
    const auto y = static_cast<int>(pixel / edge_px.x);
    double nearest = most;
    for (int v = std::max(y - most, 0); v <= std::min(y + most, static_cast<int>(edge_px.y) - 1); ++v) {
        for (int u = std::max(x - most, 0); u <= std::min(x + most, static_cast<int>(edge_px.x) - 1); ++u) {
            const size_t other = static_cast<size_t>(v) * edge_px.x + static_cast<size_t>(u);
            if (std::abs(plain.share[other] - plain.share[pixel]) > 0.3) {
                nearest = std::min(nearest, std::hypot(u - x, v - y));
            }
        }
    }
    return nearest;
}

struct Raggedness {
    double area_change = 0.0; ///< relative change of the shadow's area
    double farthest_px = 0.0; ///< largest distance from the plain edge to a changed pixel
    double mean_px = 0.0;
    size_t moved = 0;
};

Raggedness raggedness(const LampLit& plain, const LampLit& toothed)
{
    Raggedness result;
    double before = 0.0;
    double after = 0.0;
    for (size_t i = 0; i < plain.share.size(); ++i) {
        before += 1.0 - plain.share[i];
        after += 1.0 - toothed.share[i];
        if (std::abs(toothed.share[i] - plain.share[i]) > 0.3) {
            const double distance_px = to_edge_px(plain, i);
            result.farthest_px = std::max(result.farthest_px, distance_px);
            result.mean_px += distance_px;
            ++result.moved;
        }
    }
    result.mean_px /= static_cast<double>(std::max<size_t>(result.moved, 1));
    result.area_change = after / before - 1.0;
    return result;
}

TEST(LampEdge, TeethAreAsLongOnThePageFromNearAndFar)
{
    const Scene scene = board();
    for (const LampTeeth& teeth : all_lamp_teeth()) {
        double means[2] = {};
        for (const int k : {0, 1}) {
            const Camera camera = under_board(k == 0 ? 4.5 : 9.0);
            const LampLit plain = lit_by_lamp(scene, camera, teeth.lamp);
            const LampLit toothed = lit_by_lamp(scene, camera, teeth.lamp, teeth.style, teeth.lines);
            const Raggedness found = raggedness(plain, toothed);
            means[k] = found.mean_px;
            fmt::print("{:17} area {:+.4f}, {} px moved, by {:.2f} px on average and {:.2f} at most\n",
                       teeth.name, found.area_change, found.moved, found.mean_px, found.farthest_px);
            EXPECT_LT(std::abs(found.area_change), 0.01) << teeth.name;
            EXPECT_LT(found.farthest_px, lamp_reach_px + 1.5) << teeth.name;
            EXPECT_GT(found.farthest_px, 0.6 * lamp_reach_px) << teeth.name;
            EXPECT_GT(found.moved, 100U) << teeth.name;
        }
        EXPECT_NEAR(means[0], means[1], 0.2 * means[1]) << teeth.name;
    }
}

TEST(LampEdge, TeethStayInPlaceWhileTheEyeMoves)
{
    const Scene scene = board();
    for (const LampTeeth& teeth : all_lamp_teeth()) {
        double worst = 0.0;
        LampLit before = lit_by_lamp(scene, under_board(6.0), teeth.lamp, teeth.style, teeth.lines);
        // Teeth cover only a small part of the page. The share of tooth pixels that change must be small.
        const size_t moved = raggedness(lit_by_lamp(scene, under_board(6.0), teeth.lamp), before).moved;
        const double of_teeth = static_cast<double>(moved) / static_cast<double>(before.share.size());
        for (int step = 1; step <= 3; ++step) {
            const Camera camera = under_board(6.0, 0.1 * step);
            const LampLit now = lit_by_lamp(scene, camera, teeth.lamp, teeth.style, teeth.lines);
            worst = std::max(worst, test::crawl(before, now, test::Drawing(scene, camera, edge_px)));
            before = now;
        }
        fmt::print("{:17} {:.4f} % of pixels change in a step of 0.1 m, {:.2f} % of those that teeth moved\n",
                   teeth.name, 100.0 * worst, 100.0 * worst / of_teeth);
        EXPECT_LT(worst, 0.005) << teeth.name;
        EXPECT_LT(worst, 0.1 * of_teeth) << teeth.name;
    }
}

TEST(LampEdge, TeethOfWidePenumbraeReachFarther)
{
    const Scene scene = board();
    ShadowStyle strokes = all_lamp_teeth().back().style;
    const Camera camera = under_board(6.0);
    const auto spread = [&](double radius_m) {
        GlowingLamp lamp = over_board;
        lamp.radius_m = radius_m;
        const LampLit toothed = lit_by_lamp(scene, camera, lamp, strokes, HatchedLines{.width_mm = 1.5F});
        // Half of the penumbra remains, so that only the teeth differ.
        lamp.radius_m = 0.5 * radius_m;
        const LampLit plain = lit_by_lamp(scene, camera, lamp);
        double moved = 0.0;
        for (size_t i = 0; i < plain.share.size(); ++i) {
            moved += std::abs(toothed.share[i] - plain.share[i]);
        }
        return moved;
    };
    const double of_point = spread(0.0);
    const double of_ball = spread(0.15);
    fmt::print("teeth move {:.0f} pixels of light, those of a penumbra {:.0f}\n", of_point, of_ball);
    EXPECT_GT(of_ball, 1.4 * of_point);
}

} // namespace
} // namespace estampe::shadow
