// SPDX-License-Identifier: MIT
// Occlusion from depth: exact cases, a formula, and ray tracing.
#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"
#include "techniques/occlusion/test_support.hpp"

namespace estampe::occlusion {
namespace {

constexpr glm::uvec2 size_px(160, 120);
const OcclusionStyle far_reaching{.enabled = true, .reach_mm = 60.0F, .thickness = 1.0F};

/// Visibility on a floor at distance `a`, as a share of the radius, from an endless wall. Cosine-distributed
/// rays through the unit disc beyond a chord meet the wall; the falloff weights them by their distance.
double by_wall(double a)
{
    const double s = std::sqrt(1.0 - a * a);
    return 1.0 - ((1.0 + 2.0 * a * a) * std::acos(a) - 3.0 * a * s) / std::numbers::pi;
}

TEST(Occlusion, LeavesAPlaneExactlyOpen)
{
    const Scene scene = test::scene_of(shapes::plane(400.0F, 400.0F));
    for (const Camera& camera :
         {Camera{.eye = {1.0, 2.0, 6.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.9},
          Camera{.eye = {0.3, 0.4, 5.0}, .target = {0.0, 0.0, -3.0}, .vertical_fov_rad = 0.6},
          Camera{.eye = {0.0, 9.0, 0.01}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 1.2},
          Camera{.eye = {4.0, 3.0, 5.0}, .target = {0.0, 0.0, 0.0}, .orthographic_half_height_m = 2.0}}) {
        const SeenPage page(scene, camera, size_px);
        for (const float radius_m : {0.2F, 1.0F, 5.0F}) {
            const std::vector<float> open = page.open(far_reaching, radius_m);
            EXPECT_EQ(std::ranges::min(open), 1.0F) << camera.eye.y << " m above, radius " << radius_m;
        }
    }
}

TEST(Occlusion, IsInACornerWhatTheFormulaGives)
{
    Scene scene = test::scene_of(shapes::plane(60.0F, 60.0F));
    test::add_object(scene, shapes::box({60.0F, 30.0F, 1.0F}), glm::vec3(1.0F), {0.0, 0.0, -0.5});
    const Camera camera{.eye = {0.0, 3.5, 4.5}, .target = {0.0, 0.3, 0.3}, .vertical_fov_rad = 0.35};
    const SeenPage page(scene, camera, size_px);
    constexpr double radius_m = 1.0;
    const std::vector<float> open = page.open(far_reaching, static_cast<float>(radius_m));
    double squares = 0.0;
    double worst = 0.0;
    int count = 0;
    for (size_t i = 0; i < open.size(); ++i) {
        const glm::dvec3 at = page.point(i);
        const bool is_floor = page.surface.smooth_normal[i].y > 0.9F;
        const bool is_wall = page.surface.smooth_normal[i].z > 0.9F;
        const glm::uvec2 pixel(i % size_px.x, i / size_px.x);
        if ((!is_floor && !is_wall) || pixel.x < 40 || pixel.x >= 120 || pixel.y < 25 || pixel.y >= 95) {
            continue;
        }
        const double away_m = is_floor ? at.z : at.y;
        const double wanted = away_m < radius_m ? by_wall(std::max(away_m, 0.0) / radius_m) : 1.0;
        const double off = static_cast<double>(open[i]) - wanted;
        squares += off * off;
        worst = std::max(worst, std::abs(off));
        ++count;
    }
    RecordProperty("rmse", fmt::format("{:.4f}", std::sqrt(squares / count)));
    EXPECT_GT(count, 2000);
    EXPECT_LT(std::sqrt(squares / count), 0.03);
    EXPECT_LT(worst, 0.1);
}

/// A floor, a wall, a step, a table, a ball, a pole and a ring.
Scene furnished_corner()
{
    Scene scene = test::scene_of(shapes::plane(40.0F, 40.0F));
    test::add_object(scene, shapes::box({40.0F, 8.0F, 1.0F}), glm::vec3(1.0F), {0.0, 0.0, -3.5});
    test::add_object(scene, shapes::box({2.0F, 0.5F, 1.0F}), glm::vec3(1.0F), {-1.8, 0.0, -2.4});
    test::add_object(scene, shapes::box({1.6F, 0.12F, 1.0F}), glm::vec3(1.0F), {1.4, 0.8, -1.2});
    test::add_object(scene, shapes::box({0.12F, 0.8F, 0.12F}), glm::vec3(1.0F), {0.7, 0.0, -0.8});
    test::add_object(scene, shapes::box({0.12F, 0.8F, 0.12F}), glm::vec3(1.0F), {2.1, 0.0, -0.8});
    test::add_object(scene, shapes::sphere(0.6F, 48), glm::vec3(1.0F), {-0.6, 0.6, -0.6});
    test::add_object(scene, shapes::torus(0.5F, 0.15F), glm::vec3(1.0F), {0.5, 0.15, 0.6});
    return scene;
}

TEST(Occlusion, IsWhatRaysTell)
{
    const Scene scene = furnished_corner();
    const test::EmbreeScene rays(scene);
    const Camera camera{.eye = {1.2, 3.2, 6.0}, .target = {0.0, 0.5, -1.0}, .vertical_fov_rad = 0.65};
    const SeenPage page(scene, camera, size_px);
    constexpr float radius_m = 1.0F;
    OcclusionStyle style = far_reaching;
    style.thickness = OcclusionStyle{}.thickness;
    const std::vector<float> open = page.open(style, radius_m);
    double squares = 0.0;
    double all_squares = 0.0;
    double bias = 0.0;
    int count = 0;
    int all = 0;
    for (size_t i = 0; i < open.size(); i += 5) {
        if (page.surface.depth[i] <= 0.0F) {
            continue;
        }
        const Truth truth = traced(page, rays, i, static_cast<double>(radius_m), 256);
        const double off = static_cast<double>(open[i]) - truth.open;
        all_squares += off * off;
        ++all;
        if (truth.hidden_share < 0.1) {
            squares += off * off;
            bias += off;
            ++count;
        }
    }
    RecordProperty("rmse", fmt::format("{:.4f} (mean {:.4f}), of all {:.4f}", std::sqrt(squares / count),
                                       bias / count, std::sqrt(all_squares / all)));
    EXPECT_GT(count, all / 2);
    EXPECT_LT(std::sqrt(squares / count), 0.045);
}

/// Thin bars in front of a wall, and two bodies that are deeper than the radius of occlusion.
Scene bars_and_blocks()
{
    Scene scene = test::scene_of(shapes::plane(40.0F, 40.0F));
    test::add_object(scene, shapes::box({40.0F, 8.0F, 1.0F}), glm::vec3(1.0F), {0.0, 0.0, -3.5});
    for (const double x : {-2.4, -2.0, -1.6, -1.2, -0.8}) {
        test::add_object(scene, shapes::box({0.1F, 2.0F, 0.1F}), glm::vec3(1.0F), {x, 0.0, -2.4});
    }
    test::add_object(scene, shapes::box({2.0F, 0.1F, 0.1F}), glm::vec3(1.0F), {-1.6, 1.0, -2.2});
    test::add_object(scene, shapes::box({0.7F, 1.1F, 2.6F}), glm::vec3(1.0F), {0.6, 0.0, -1.4});
    test::add_object(scene, shapes::box({0.7F, 0.5F, 2.6F}), glm::vec3(1.0F), {1.9, 0.0, -1.4});
    return scene;
}

/// Root of the mean square difference between a page's visibility and traced rays.
double error_of(const SeenPage& page, const std::vector<float>& open, const std::vector<Truth>& truths)
{
    double squares = 0.0;
    int count = 0;
    for (size_t i = 0; i < truths.size(); ++i) {
        if (page.surface.depth[5 * i] > 0.0F) {
            const double off = static_cast<double>(open[5 * i]) - truths[i].open;
            squares += off * off;
            ++count;
        }
    }
    return std::sqrt(squares / count);
}

TEST(Occlusion, BackFacesTellHowThickThingsAre)
{
    const Scene scene = bars_and_blocks();
    const test::EmbreeScene rays(scene);
    const Camera camera{.eye = {0.4, 3.2, 6.0}, .target = {0.0, 0.6, -1.0}, .vertical_fov_rad = 0.65};
    const SeenPage page(scene, camera, size_px);
    constexpr float radius_m = 1.0F;
    std::vector<Truth> truths;
    for (size_t i = 0; i < page.surface.depth.size(); i += 5) {
        truths.push_back(page.surface.depth[i] > 0.0F
                             ? traced(page, rays, i, static_cast<double>(radius_m), 256)
                             : Truth{});
    }
    OcclusionStyle style = far_reaching;
    double best_guess = 1.0;
    std::string guesses;
    for (const float thickness : {0.1F, 0.2F, 0.35F, 0.5F, 1.0F, 2.0F}) {
        style.thickness = thickness;
        const double error = error_of(page, page.open(style, radius_m), truths);
        best_guess = std::min(best_guess, error);
        guesses += fmt::format(" {:.4f} at {}", error, thickness);
    }
    style.thickness = OcclusionStyle{}.thickness;
    style.thickness_from = ThicknessFrom::back_faces;
    const double with_backs = error_of(page, page.open(style, radius_m), truths);
    RecordProperty("rmse", fmt::format("{:.4f}, by guesses{}", with_backs, guesses));
    EXPECT_LT(with_backs, 0.05);
    EXPECT_LT(with_backs, 0.85 * best_guess) << "no single thickness is right for bars and blocks";
}

TEST(Occlusion, BackFacesLeaveAPlaneExactlyOpen)
{
    OcclusionStyle style = far_reaching;
    style.thickness_from = ThicknessFrom::back_faces;
    const Camera camera{.eye = {1.0, 2.0, 6.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.9};
    for (Primitive shape : {shapes::plane(400.0F, 400.0F), shapes::box({400.0F, 1.0F, 400.0F})}) {
        const Scene scene = test::scene_of(std::move(shape));
        EXPECT_EQ(std::ranges::min(SeenPage(scene, camera, size_px).open(style, 1.0F)), 1.0F);
    }
}

TEST(Occlusion, IsInTilesWhatItIsOnTheWholePage)
{
    const Camera camera{.eye = {1.2, 3.2, 6.0}, .target = {0.0, 0.5, -1.0}, .vertical_fov_rad = 0.65};
    const SeenPage page(furnished_corner(), camera, size_px);
    OcclusionStyle style = far_reaching;
    style.reach_mm = 12.0F;
    const std::vector<float> whole = page.open(style, 0.7F);
    const uint32_t reach = reach_px(style, 1.0F);
    const glm::uvec2 part_px(80, 64);
    for (const glm::uvec2 from_px : {glm::uvec2(16, 20), glm::uvec2(33, 21), glm::uvec2(50, 31)}) {
        const std::vector<float> part = page.open(style, 0.7F, features::PixelRect{from_px, part_px});
        int shaded = 0;
        for (uint32_t y = reach; y < part_px.y - reach; ++y) {
            for (uint32_t x = reach; x < part_px.x - reach; ++x) {
                const float wanted = whole[size_t{y + from_px.y} * size_px.x + x + from_px.x];
                EXPECT_EQ(part[size_t{y} * part_px.x + x], wanted) << x << ", " << y;
                shaded += wanted < 0.9F ? 1 : 0;
            }
        }
        EXPECT_GT(shaded, 50);
    }
}

/// Variation of visibility along a horizontal or vertical edge, and from frame to frame.
struct Grain {
    double deviation = 0.0;
    double most = 0.0;
};

Grain grain_along(bool is_upright)
{
    Scene scene = test::scene_of(shapes::box({60.0F, 60.0F, 1.0F}));
    const glm::vec3 size = is_upright ? glm::vec3(1.0F, 60.0F, 60.0F) : glm::vec3(60.0F, 1.0F, 60.0F);
    test::add_object(scene, shapes::box(size), glm::vec3(1.0F), {0.0, is_upright ? 0.0 : 29.0, 0.0});
    std::vector<std::vector<float>> frames;
    for (const double along_m : {0.0, 0.013, 0.029, 0.041}) {
        const glm::dvec3 moved = is_upright ? glm::dvec3(0.0, along_m, 0.0) : glm::dvec3(along_m, 0.0, 0.0);
        const glm::dvec3 aside = is_upright ? glm::dvec3(3.0, 30.0, 5.0) : glm::dvec3(0.0, 33.0, 5.0);
        const Camera camera{.eye = aside + moved,
                            .target =
                                glm::dvec3(is_upright ? 0.9 : 0.0, is_upright ? 30.0 : 30.4, 0.5) + moved,
                            .vertical_fov_rad = 0.6};
        frames.push_back(SeenPage(scene, camera, size_px).open(far_reaching, 1.0F));
    }
    constexpr uint32_t first = 50;
    constexpr uint32_t length = 20;
    Grain grain;
    int count = 0;
    const uint32_t across = is_upright ? size_px.x : size_px.y;
    for (uint32_t line = 10; line < across - 10; ++line) {
        std::vector<double> values;
        for (const std::vector<float>& open : frames) {
            for (uint32_t i = first; i < first + length; ++i) {
                const size_t pixel = is_upright ? size_t{i} * size_px.x + line : size_t{line} * size_px.x + i;
                values.push_back(static_cast<double>(open[pixel]));
            }
        }
        const double mean =
            std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
        for (const double value : values) {
            grain.deviation += (value - mean) * (value - mean);
            grain.most = std::max(grain.most, std::abs(value - mean));
            ++count;
        }
    }
    grain.deviation = std::sqrt(grain.deviation / count);
    return grain;
}

TEST(Occlusion, HasNoGrain)
{
    for (const bool is_upright : {false, true}) {
        const Grain grain = grain_along(is_upright);
        EXPECT_LT(grain.deviation, 0.005) << is_upright;
        EXPECT_LT(grain.most, 0.03) << is_upright;
    }
}

TEST(Occlusion, PutsDarknessUnderThings)
{
    const Camera camera{.eye = {1.2, 3.2, 6.0}, .target = {0.0, 0.5, -1.0}, .vertical_fov_rad = 0.65};
    const SeenPage page(furnished_corner(), camera, size_px);
    const std::vector<float> open = page.open(far_reaching, 1.0F);
    const auto at = [&](const glm::dvec3& place) {
        const glm::dvec4 clip = glm::dmat4(page.drawing.globals.clip_from_anchor) *
                                glm::dvec4(place - page.drawing.layout.anchor, 1.0);
        const glm::dvec2 pixel = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(size_px);
        return open[static_cast<size_t>(pixel.y) * size_px.x + static_cast<size_t>(pixel.x)];
    };
    EXPECT_LT(at({-0.6, 0.0, -0.35}), 0.65F) << "before the ball, where it stands";
    EXPECT_GT(at({2.0, 0.0, 1.5}), 0.97F) << "open floor";
    // A table's edge does not darken the far floor behind it.
    OcclusionStyle weak = far_reaching;
    weak.strength = 2.0F;
    const std::vector<float> darker = page.open(weak, 1.0F);
    for (size_t i = 0; i < open.size(); ++i) {
        EXPECT_NEAR(darker[i], open[i] * open[i], 2e-3F);
    }
}

} // namespace
} // namespace estampe::occlusion
