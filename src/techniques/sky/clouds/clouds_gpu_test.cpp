// SPDX-License-Identifier: MIT
// Rendered clouds: fixed in the world, drifting with the wind, and covering the right share.
#include "techniques/sky/clouds/clouds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include <gtest/gtest.h>

#include "techniques/sky/clouds/clouds_test_support.hpp"
#include "techniques/sky/clouds/cover.hpp"

namespace estampe::sky {
namespace {

const CloudStyle heaps{.coverage = 0.4F, .tones = 1};
const CloudStyle all_kinds{.coverage = 0.25F, .flocks = 0.25F, .streaks = 0.2F, .tones = 1};

TEST(Clouds, CoverTheShareOfTheSkyThatIsAskedFor)
{
    // The page shows one tile. The puffs are flat, so that they have no visible sides.
    constexpr float up_m = 1000.0F;
    const View up{.camera = looking(89.9, 0.0, 1.9), .size_px = {240, 240}};
    const float eye_m = static_cast<float>(up.camera.eye.y);
    const float tile_m = 2.0F * up_m * std::tan(0.95F);
    double before = 0.0;
    for (const float share : {0.15F, 0.45F, 0.75F}) {
        const double heaped = mean(paint(up, {.coverage = share,
                                              .base_m = eye_m + up_m,
                                              .size_m = tile_m * 6.0F / 64.0F,
                                              .heaped = 0.1F,
                                              .tones = 1,
                                              .reach_m = 2e5F})
                                       .white);
        EXPECT_NEAR(heaped, static_cast<double>(share), 0.03);
        EXPECT_GT(heaped, before);
        before = heaped;
        const double streaked = mean(paint(up, {.streaks = share,
                                                .streaks_base_m = eye_m + up_m,
                                                .streaks_size_m = tile_m * 4.0F / 32.0F,
                                                .streaks_mm = 0.3F,
                                                .tones = 1,
                                                .reach_m = 2e5F})
                                         .white);
        EXPECT_NEAR(streaked, static_cast<double>(share), 0.05);
    }
}

TEST(Clouds, AreNotPaintedBehindWhatIsNear)
{
    View view{.camera = looking(14.0, 30.0, 0.7), .size_px = {160, 100}};
    const Painted all = paint(view, all_kinds);
    view.far_m = 100.0F;
    const Painted seen = paint(view, all_kinds);
    size_t hidden = 0;
    for (size_t i = 0; i < all.white.size(); ++i) {
        EXPECT_EQ(seen.white[i], view.is_covered(i) ? 0.0F : all.white[i]) << i;
        EXPECT_EQ(seen.ink[i], view.is_covered(i) ? 0.0F : all.ink[i]) << i;
        hidden += seen.white[i] != all.white[i] ? 1 : 0;
    }
    EXPECT_GT(hidden, 500U);
}

TEST(Clouds, StandStillInTheWorldAsTheCameraTurns)
{
    const View view{.camera = looking(14.0, 30.0, 0.7), .size_px = {160, 100}};
    const View turned{.camera = looking(19.0, 37.0, 0.7), .size_px = {160, 100}};
    const Painted first = paint(view, all_kinds);
    const Painted second = paint(turned, all_kinds);
    EXPECT_GT(mean(first.white), 0.2);
    size_t seen_twice = 0;
    size_t different = 0;
    for (size_t i = 0; i < first.white.size(); ++i) {
        const glm::dvec3 d = view.direction(centre_of(i, view.size_px));
        const glm::dvec4 clip = glm::dmat4(turned.globals().clip_from_anchor) * glm::dvec4(1000.0 * d, 1.0);
        const glm::ivec2 at(glm::floor((0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(view.size_px)));
        if (clip.w <= 0.0 || at.x < 1 || at.y < 1 || at.x > 158 || at.y > 98) {
            continue;
        }
        // Counts a difference only if no pixel around the pixel is similar: an edge may be off by one pixel.
        float least = 1.0F;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const size_t there = static_cast<size_t>(at.y + dy) * 160 + static_cast<size_t>(at.x + dx);
                least = std::min(least, std::abs(second.white[there] - first.white[i]));
            }
        }
        ++seen_twice;
        different += least > 0.25F ? 1 : 0;
    }
    EXPECT_GT(seen_twice, 6000U);
    EXPECT_LT(static_cast<double>(different), 0.01 * static_cast<double>(seen_twice));
}

TEST(Clouds, DriftAsFastAsTheWindAndPassOverAnEyeThatMoves)
{
    CloudStyle style = all_kinds;
    style.wind_m_per_s = 20.0F;
    style.wind.towards_deg = 60.0F;
    style.change_s = 1e6F;
    const View view{.camera = looking(14.0, 30.0, 0.7), .size_px = {160, 100}};
    View moved = view;
    const glm::dvec3 wind(std::sin(std::numbers::pi / 3.0), 0.0, 0.5);
    const glm::dvec3 way = 20.0 * 60.0 * wind;
    moved.camera.eye += way;
    moved.camera.target += way;
    const Painted first = paint(view, style);
    EXPECT_LT(differing(first.white, paint(moved, style, 60.0).white), 0.01) << "with the wind for a minute";
    EXPECT_GT(differing(first.white, paint(view, style, 60.0).white), 0.05)
        << "which one who stays sees pass";
    EXPECT_GT(differing(first.white, paint(moved, style, 58.0).white), 0.015) << "nor in 58 seconds";
    EXPECT_EQ(first.white, paint(view, style).white) << "whatever was painted before";
}

TEST(Clouds, LookTheSameInEveryBearing)
{
    CloudStyle style = all_kinds;
    style.broken = 0.0F;
    style.outline_mm = 0.8F;
    const auto towards = [&](double bearing_deg) {
        Camera camera = looking(16.0, bearing_deg, 0.7);
        camera.target -= camera.eye;
        camera.eye = glm::dvec3(0.0, 2.0, 0.0);
        camera.target += camera.eye;
        // Cameras count their bearings from -z.
        style.wind.towards_deg = static_cast<float>(180.0 - bearing_deg + 30.0);
        return paint({.camera = camera, .size_px = {120, 80}}, style);
    };
    const Painted north = towards(0.0);
    EXPECT_GT(mean(north.ink), 0.005);
    for (const double bearing_deg : {90.0, 180.0, 213.0, 359.9}) {
        const Painted other = towards(bearing_deg);
        EXPECT_LT(differing(north.white, other.white), 0.005) << bearing_deg;
        EXPECT_LT(differing(north.ink, other.ink), 0.01) << bearing_deg;
    }
}

/// Whether a pixel's ray hits any of a layer's puffs in the repeating tile. The hit is certain well inside an
/// outline. The hit is possible near an outline, which wavers by 8.5 %.
struct Met {
    bool surely = false;
    bool perhaps = false;
};

Met meet_any(const CloudPlan& plan, std::span<const shared::CloudPuff> puffs, const glm::dvec3& d,
             double pixel_rad)
{
    const shared::PuffLayer& layer = plan.globals.puffs[0];
    const glm::dvec2 along(plan.globals.along_wind);
    const glm::dvec3 in_wind(d.x * along.x + d.z * along.y, d.y, d.z * along.x - d.x * along.y);
    const glm::dvec3 step = in_wind * glm::dvec3(layer.per_m);
    const double enter_m = static_cast<double>(layer.base_m) / d.y;
    const glm::dvec3 entered = glm::dvec3(layer.eye) + step * enter_m;
    const auto tile = static_cast<double>(layer.cells);
    Met met;
    for (const shared::CloudPuff& puff : puffs) {
        glm::dvec3 from_centre = entered - glm::dvec3(puff.centre);
        from_centre.x -= tile * std::round(from_centre.x / tile);
        from_centre.z -= tile * std::round(from_centre.z / tile);
        const double further_m = std::max(-glm::dot(from_centre, step) / glm::dot(step, step), 0.0);
        const double away = glm::length(from_centre + step * further_m);
        const auto radius = static_cast<double>(puff.radius);
        // More than half of a pixel's span, even on the base, where it is largest.
        const double margin = 0.6 * (enter_m + further_m) * pixel_rad * glm::length(step) / d.y;
        met.surely |= away < 0.9 * radius - margin;
        met.perhaps |= away < 1.1 * radius + margin;
    }
    return met;
}

/// Expects a cloud at a pixel exactly if its ray meets a puff.
void expect_met_puffs_alone(const View& view, const CloudPlan& plan, std::span<const shared::CloudPuff> puffs,
                            const Painted& painted)
{
    size_t within = 0;
    size_t outside = 0;
    for (size_t i = 0; i < painted.white.size(); ++i) {
        const glm::dvec2 position = centre_of(i, view.size_px);
        const glm::dvec3 d = view.direction(position);
        const double pixel_rad = glm::distance(d, view.direction(position + glm::dvec2(1.0, 0.0)));
        const Met met = meet_any(plan, puffs, d, pixel_rad);
        if (met.surely) {
            EXPECT_GT(painted.white[i], 0.99F) << i;
            ++within;
        } else if (!met.perhaps) {
            EXPECT_LT(painted.white[i], 0.01F) << i;
            ++outside;
        }
    }
    EXPECT_GT(within, 500U);
    EXPECT_GT(outside, 500U);
}

TEST(Clouds, CoverWhereARayMeetsAnyPuffOfAll)
{
    // The puffs are apart, so that none hides a missing one; the tile's edges cut many of them.
    constexpr uint32_t cells = 64;
    constexpr float cell_m = 150.0F;
    std::vector<shared::CloudPuff> puffs;
    for (uint32_t i = 0; i < cells * cells / 4; ++i) {
        const glm::vec2 stray(hashed(i, 1, 1), hashed(i, 2, 1));
        const glm::vec2 place =
            2.0F * glm::vec2(i % (cells / 2), i / (cells / 2)) + 0.8F * (stray - 0.5F) + float{cells};
        puffs.push_back({.centre = {std::fmod(place.x, float{cells}), 0.6F * hashed(i, 3, 1),
                                    std::fmod(place.y, float{cells})},
                         .radius = 0.4F + 0.4F * hashed(i, 4, 1),
                         .lean = {0.0F, 1.0F, 0.0F},
                         .trait = hashed(i, 5, 1)});
    }
    const auto shapes = std::make_shared<CloudShapes>();
    const CloudShapes::Layer layer = shapes->add(puffs, cells);
    CloudStyle style{
        .coverage = 0.5F, .size_m = 6.0F * cell_m, .wind = {.towards_deg = 0.0F}, .color = glm::vec3(1.0F)};
    style.tones = 1;
    style.outline_mm = 0.0F;
    style.reach_m = 2e5F;
    // Views across the tile's corner, along both of its edges and diagonally.
    for (const double bearing_deg : {0.0, 90.0, 180.0, 270.0, 32.0}) {
        SCOPED_TRACE(bearing_deg);
        View view{.camera = looking(40.0, bearing_deg, 0.7), .size_px = {96, 60}};
        const glm::dvec3 away_m(0.2 * bearing_deg - 30.0, 0.0, 20.0 - 0.2 * bearing_deg);
        view.camera.eye += away_m;
        view.camera.target += away_m;
        CloudMemory memory;
        auto plan = plan_clouds(style, {.eye_m = view.camera.eye}, memory);
        ASSERT_TRUE(plan && plan->globals.puffs[0].cells == cells);
        plan->shapes = shapes;
        shared::PuffLayer& planned = plan->globals.puffs[0];
        planned.thick_m = 1.6F * cell_m;
        planned.first_cell = layer.first_cell;
        planned.first_home = layer.first_home;
        planned.reach = layer.reach;
        for (const bool by_groups : {false, true}) {
            expect_met_puffs_alone(view, *plan, puffs, paint(view, plan, {.by_groups = by_groups}));
        }
    }
}

TEST(Clouds, AreNotUnderTheHorizonNorUnderTheEyeNorThereUnasked)
{
    const View level{.camera = looking(0.0, 10.0, 0.9), .size_px = {80, 60}};
    const Painted painted = paint(level, all_kinds);
    for (size_t i = 0; i < painted.white.size(); ++i) {
        if (level.direction(centre_of(i, level.size_px)).y < 0.0) {
            EXPECT_EQ(painted.white[i], 0.0F);
            EXPECT_EQ(painted.ink[i], 0.0F);
        }
    }
    EXPECT_GT(mean(painted.white), 0.02);
    CloudMemory memory;
    EXPECT_FALSE(plan_clouds({}, {}, memory));
    EXPECT_FALSE(plan_clouds(heaps, {.eye_m = {0.0, heaps.base_m + 1.0F, 0.0}}, memory));
    EXPECT_TRUE(plan_clouds(heaps, {.eye_m = {0.0, heaps.base_m - 1.0F, 0.0}}, memory));
}

TEST(Clouds, ShowTheirLitSideTowardsTheSun)
{
    CloudStyle style{.coverage = 0.3F, .tones = 2, .shade = 0.55F, .outline_mm = 0.0F, .reach_m = 2e5F};
    style.shade_color = glm::vec3(0.5F);
    View view{.camera = looking(12.0, 0.0, 0.9), .size_px = {120, 80}};
    const auto lit_share = [&](const glm::vec3& towards_sun) {
        view.towards_sun = glm::normalize(towards_sun);
        const auto white = paint(view, style).white;
        const auto lit = std::ranges::count_if(white, [](float value) { return value > 0.8F; });
        const auto cloud = std::ranges::count_if(white, [](float value) { return value > 0.4F; });
        return static_cast<double>(lit) / static_cast<double>(cloud);
    };
    const double behind_the_eye = lit_share({0.0F, 0.25F, 1.0F});
    const double behind_them = lit_share({0.0F, 0.25F, -1.0F});
    EXPECT_GT(behind_the_eye, behind_them + 0.3);
    style.tones = 1;
    EXPECT_GT(lit_share({0.0F, 0.25F, -1.0F}), 0.9) << "of one tone there is no shade";
}

TEST(Clouds, AreHatchedInTheirShadeAlone)
{
    CloudStyle style{.coverage = 0.4F, .outline_mm = 0.0F, .hatch = 0.5F, .hatch_mm = 0.1F, .reach_m = 2e5F};
    style.shade_color = glm::vec3(0.5F);
    const View view{.camera = looking(12.0, 0.0, 0.9),
                    .size_px = {160, 100},
                    .towards_sun = {0.5F, 0.3F, 0.0F},
                    .pixels_per_mm = 20.0F};
    const Painted painted = paint(view, style);
    double shaded = 0.0;
    double ink = 0.0;
    for (size_t i = 0; i < painted.ink.size(); ++i) {
        const bool is_shade = std::abs(painted.white[i] - 0.5F) < 0.01F;
        shaded += is_shade ? 1.0 : 0.0;
        ink += is_shade ? static_cast<double>(painted.ink[i]) : 0.0;
        if (painted.white[i] == 0.0F || painted.white[i] == 1.0F) {
            EXPECT_EQ(painted.ink[i], 0.0F) << i;
        }
    }
    ASSERT_GT(shaded, 1000.0);
    EXPECT_NEAR(ink / shaded, 0.5, 0.06);
}

/// Share of sunlight on a level plain below the eye, and the position of each pixel on it, in metres.
struct Plain {
    std::vector<float> share;
    std::vector<glm::dvec2> places;
};

Plain shadow_on_plain(const View& view, const CloudStyle& style, float strength, double time_s)
{
    constexpr double height_m = 200.0;
    gpu::Device& device = test::shared_device();
    CloudMemory memory;
    const auto plan = plan_clouds(
        style, {.eye_m = view.camera.eye, .time_s = time_s, .towards_sun = view.towards_sun}, memory);
    const shared::FrameGlobals globals = view.globals();
    gpu::Buffer frame = gpu::upload_buffer(device, "frame", std::vector{globals});
    features::Clouds clouds;
    clouds.upload(device, *plan);
    const glm::dmat4 anchor_from_clip = glm::inverse(glm::dmat4(globals.clip_from_anchor));
    Plain plain;
    std::vector<float> depths;
    for (uint32_t i = 0; i < view.size_px.x * view.size_px.y; ++i) {
        const glm::dvec2 ndc =
            2.0 * (glm::dvec2(i % view.size_px.x, i / view.size_px.x) + 0.5) / glm::dvec2(view.size_px) - 1.0;
        const glm::dvec4 near = anchor_from_clip * glm::dvec4(ndc, 1.0, 1.0);
        const glm::dvec3 eye(globals.eye_anchor);
        const glm::dvec3 way = glm::dvec3(near) / near.w - eye;
        const glm::dvec3 place = eye - way * (height_m / way.y);
        const glm::dvec4 clip = glm::dmat4(globals.clip_from_anchor) * glm::dvec4(place, 1.0);
        depths.push_back(way.y < 0.0 ? static_cast<float>(clip.z / clip.w) : 0.0F);
        plain.places.emplace_back(place.x, place.z);
    }
    auto depth = test::Layer::depth(
        view.size_px, [&](glm::uvec2 pixel) { return depths[pixel.y * view.size_px.x + pixel.x]; });
    gpu::Graph graph;
    plain.share = test::run_and_read_coverage(
        graph, add_cloud_shadow(graph,
                                {.frame = gpu::import_whole(graph, "frame", frame),
                                 .clouds = clouds.import(graph),
                                 .depth = depth.in(graph),
                                 .share = std::nullopt,
                                 .size_px = view.size_px},
                                strength));
    return plain;
}

/// Cached shapes are reused while nothing changes, and equal newly computed ones.
TEST(CloudMemories, HoldWhatWouldBeMade)
{
    CloudMemory memory;
    const auto shapes_at = [&](const CloudStyle& style, double time_s) {
        const auto shapes = plan_clouds(style, {.time_s = time_s}, memory)->shapes;
        CloudMemory fresh;
        const auto anew = plan_clouds(style, {.time_s = time_s}, fresh)->shapes;
        EXPECT_EQ(shapes->starts, anew->starts);
        EXPECT_EQ(shapes->streaks, anew->streaks);
        return shapes;
    };
    CloudStyle style = all_kinds;
    const auto first = shapes_at(style, 0.0);
    EXPECT_EQ(shapes_at(style, 0.02), first) << "an eye sees no change in a fiftieth of a second";
    EXPECT_NE(shapes_at(style, 60.0), first);
    style.wind_m_per_s = 2.0F;
    const auto other = shapes_at(style, 0.0);
    style.flocks = 0.5F;
    EXPECT_NE(shapes_at(style, 0.0)->starts, other->starts);
}

TEST(CloudShadows, CoverAsMuchGroundAsCloudsCoverSky)
{
    // A view from above of a plain a little wider than a tile, under a sun overhead.
    View down{.camera = looking(-89.9, 0.0, 1.9), .size_px = {160, 160}};
    down.towards_sun = glm::vec3(0.0F, 1.0F, 0.0F);
    const float eye_m = static_cast<float>(down.camera.eye.y);
    for (const float share : {0.2F, 0.6F}) {
        const CloudStyle style{.coverage = share,
                               .base_m = eye_m + 100.0F,
                               .size_m = 2.0F * 200.0F * std::tan(0.95F) * 6.0F / 64.0F,
                               .heaped = 0.1F,
                               .reach_m = 2e5F};
        EXPECT_NEAR(1.0 - mean(shadow_on_plain(down, style, 1.0F, 0.0).share), static_cast<double>(share),
                    0.04);
        EXPECT_NEAR(1.0 - mean(shadow_on_plain(down, style, 0.5F, 0.0).share),
                    0.5 * static_cast<double>(share), 0.02);
    }
}

TEST(CloudShadows, LieWhereTheSunMeetsAClouds)
{
    // A second view looks from places on the plain to the sun. It must see clouds where the plain is in
    // shadow.
    View down{.camera = looking(-60.0, 30.0, 1.2), .size_px = {48, 36}};
    down.towards_sun = glm::normalize(glm::vec3(0.5F, 0.7F, -0.2F));
    const CloudStyle style{.coverage = 0.7F, .base_m = 900.0F, .size_m = 400.0F, .tones = 1, .reach_m = 2e5F};
    const Plain plain = shadow_on_plain(down, style, 1.0F, 3.0);
    size_t shaded = 0;
    size_t open = 0;
    for (size_t i = 0; i < plain.share.size(); i += 37) {
        View up{.camera = down.camera, .size_px = {3, 3}};
        const glm::dvec3 eye(down.globals().eye_anchor);
        up.camera.eye += glm::dvec3(plain.places[i].x - eye.x, -200.0, plain.places[i].y - eye.z);
        up.camera.target = up.camera.eye + glm::dvec3(down.towards_sun);
        up.camera.vertical_fov_rad = 0.01;
        up.towards_sun = down.towards_sun;
        const float seen = paint(up, style, 3.0).white[4];
        if (plain.share[i] < 0.02F || plain.share[i] > 0.98F) {
            EXPECT_NEAR(1.0F - plain.share[i], seen, 0.3F) << i;
            shaded += plain.share[i] < 0.5F ? 1 : 0;
            open += plain.share[i] > 0.5F ? 1 : 0;
        }
    }
    EXPECT_GT(shaded, 3U);
    EXPECT_GT(open, 3U);
}

} // namespace
} // namespace estampe::sky
