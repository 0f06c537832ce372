// SPDX-License-Identifier: MIT
// The sun's clipmap: its texels do not depend on the eye, are fine enough for the page, and agree with ray
// tracing.
#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/shadow/shadow_test_support.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 clipmap_px(160, 120);
constexpr uint32_t level_size = 1024;
const glm::dvec3 towards_side_sun = glm::normalize(glm::dvec3(0.5, 0.8, 0.3));

/// A long row of posts and slabs on a floor.
Scene colonnade()
{
    Scene scene = test::scene_of(shapes::plane(200.0F, 60.0F));
    for (int i = -12; i <= 12; ++i) {
        test::add_object(scene, shapes::box({0.5F, 3.0F, 0.5F}), glm::vec3(1.0F), {7.0 * i, 0.0, -2.0});
        test::add_object(scene, shapes::box({3.0F, 0.4F, 1.0F}), glm::vec3(1.0F), {7.0 * i + 2.0, 0.0, 1.5});
    }
    return scene;
}

Camera colonnade_walker(double along_m)
{
    return {.eye = {along_m, 1.7, 7.0}, .target = {along_m + 6.0, 0.3, -3.0}, .vertical_fov_rad = 0.8};
}

TEST(SunClipmap, HoldsTheSameBitsWhereverItsWindowIs)
{
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        test::Drawing drawing(colonnade(), colonnade_walker(0.0), clipmap_px);
        drawing.path = path;
        const Clipmap clipmap = clipmap_of(drawing, towards_side_sun, 256);
        for (const uint32_t level : {0U, 2U}) {
            const glm::ivec2 low = windows_about(clipmap, glm::dvec3(drawing.globals.eye_anchor))[level];
            const Piece here{.level = level, .low = low, .size = glm::uvec2(256)};
            const Piece there{.level = level, .low = low + glm::ivec2(48, -16), .size = glm::uvec2(256)};
            const Piece strip{.level = level, .low = low + glm::ivec2(64, 0), .size = {32, 256}};
            const auto first = drawing.sun_piece(clipmap, here);
            size_t covered = 0;
            for (const Piece& piece : {there, strip}) {
                const auto second = drawing.sun_piece(clipmap, piece);
                size_t other = 0;
                for (int y = 0; y < 256; ++y) {
                    for (int x = 0; x < 256; ++x) {
                        const glm::ivec2 at = low + glm::ivec2(x, y) - piece.low;
                        if (at.x < 0 || at.y < 0 || at.x >= static_cast<int>(piece.size.x) ||
                            at.y >= static_cast<int>(piece.size.y)) {
                            continue;
                        }
                        const uint32_t a = first[static_cast<size_t>(y) * 256 + static_cast<size_t>(x)];
                        const uint32_t b =
                            second[static_cast<size_t>(at.y) * piece.size.x + static_cast<size_t>(at.x)];
                        covered += a != 0 ? 1U : 0U;
                        // The device's own rasteriser interpolates depth from its picture's corner.
                        const bool same =
                            path == RasterPath::compute
                                ? a == b
                                : std::abs(std::bit_cast<float>(a) - std::bit_cast<float>(b)) < 1e-5F;
                        other += same ? 0U : 1U;
                    }
                }
                EXPECT_EQ(other, 0U) << "level " << level << ", path " << name_of(path);
            }
            EXPECT_GT(covered, 2000U);
        }
    }
}

std::vector<uint32_t> random_words(size_t count, uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<uint32_t> words(count);
    std::ranges::generate(words, [&] { return static_cast<uint32_t>(random()); });
    return words;
}

TEST(SunClipmap, MixesTilesAndNothingBeside)
{
    const Clipmap clipmap{.finest_m = 1.0, .size = 256, .level_count = 3};
    // The first is a whole level; the second wraps around in both directions.
    const std::vector<Piece> squares{{.level = 0, .low = {-96, 40}, .size = glm::uvec2(256)},
                                     {.level = 1, .low = {-52, 200}, .size = glm::uvec2(128)},
                                     {.level = 2, .low = {4, -300}, .size = glm::uvec2(64)}};
    const std::vector<glm::uvec3> tiles{{0, 1, 2}, {0, 3, 0}, {1, 0, 0}, {1, 1, 1}, {2, 0, 0}};
    const std::vector<uint32_t> first{0, 256 * 256, 256 * 256 + 128 * 128};
    const auto picture = random_words(first[2] + 64 * 64, 1);
    const auto still = random_words(size_t{3} * 256 * 256, 2);
    auto wanted = random_words(size_t{3} * 256 * 256, 3);
    gpu::Device& device = test::shared_device();
    gpu::Buffer map = gpu::upload_buffer(device, "map", wanted);
    gpu::Buffer pictures = gpu::upload_buffer(device, "pictures", picture);
    gpu::Buffer stills = gpu::upload_buffer(device, "still", still);
    std::vector<uint32_t> packed;
    for (const glm::uvec3& tile : tiles) { // square, column, row
        packed.push_back(tile.x << 16U | tile.z << 8U | tile.y);
        const Piece& square = squares[tile.x];
        const uint32_t side = square.size.x;
        for (uint32_t i = 0; i < 64 * 64; ++i) {
            const glm::uvec2 place = 64U * glm::uvec2(tile.y, tile.z) + glm::uvec2(i % 64, i / 64);
            const glm::uvec2 at = ((side == 256 ? glm::uvec2(0) : glm::uvec2(square.low)) + place) % 256U;
            const size_t texel = (square.level * 256 + at.y) * 256 + at.x;
            wanted[texel] = std::max(picture[first[tile.x] + place.y * side + place.x], still[texel]);
        }
    }
    gpu::Buffer list = gpu::upload_buffer(device, "tiles", packed);
    gpu::Graph graph;
    const auto mixed = add_mixed_levels(graph, clipmap,
                                        {.squares = squares,
                                         .pictures = gpu::import_whole(graph, "pictures", pictures),
                                         .still = gpu::import_whole(graph, "still", stills),
                                         .tiles = gpu::import_whole(graph, "tiles", list),
                                         .tile_count = static_cast<uint32_t>(packed.size())},
                                        gpu::import_whole(graph, "map", map));
    EXPECT_TRUE(test::run_and_read_as<uint32_t>(graph, mixed) == wanted);
}

struct ClipmapLit {
    std::vector<double> share;
    std::vector<glm::dvec3> point;
    std::vector<double> away_m; ///< along the view direction
    double pixel_m = 0.0;       ///< at distance 1
    size_t flat = 0;            ///< number of pixels of the floor
};

ClipmapLit lit_by_clipmap(const Scene& scene, const Camera& camera, const std::optional<Clipmap>& clipmap)
{
    test::Drawing drawing(scene, camera, clipmap_px);
    const auto light = drawing.light({.records = {sun_record(towards_side_sun)},
                                      .directional_count = 1,
                                      .shadow_size = 1024,
                                      .clipmap = clipmap});
    const auto surface = drawing.surface();
    ClipmapLit result;
    result.pixel_m = 2.0 * std::tan(0.5 * camera.vertical_fov_rad) / clipmap_px.y;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    for (size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 point = drawing.point_seen(i, surface.depth[i]) + drawing.layout.anchor;
        const double cosine = glm::dot(glm::dvec3(surface.smooth_normal[i]), towards_side_sun);
        const bool faces = surface.draw[i] != 0 && cosine > 0.02;
        result.share.push_back(faces ? static_cast<double>(light[i].x) / cosine : -1.0);
        result.point.push_back(point + glm::dvec3(surface.smooth_normal[i]) * 1e-3);
        result.away_m.push_back(glm::dot(point - camera.eye, forward));
    }
    return result;
}

TEST(SunClipmap, AgreesWithRays)
{
    const Scene scene = colonnade();
    const test::EmbreeScene rays(scene);
    const Camera behind{.eye = {3.0, 3.0, -7.0}, .target = {4.0, 0.0, -3.0}, .vertical_fov_rad = 0.8};
    test::Drawing drawing(scene, behind, clipmap_px);
    const Clipmap clipmap = clipmap_of(drawing, towards_side_sun, level_size);
    const ClipmapLit seen = lit_by_clipmap(scene, behind, clipmap);
    size_t compared = 0;
    size_t shadowed = 0;
    size_t wrong = 0;
    const glm::dvec3 right(clipmap.view.right);
    const glm::dvec3 down(clipmap.view.down);
    for (size_t i = 0; i < seen.share.size(); ++i) {
        if (seen.share[i] < 0.0) {
            continue;
        }
        const bool blocked = rays.is_blocked(seen.point[i], towards_side_sun);
        const double band_m = 2.0 * std::max(seen.away_m[i] * seen.pixel_m, clipmap.finest_m);
        bool is_edge = false;
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 aside = right * std::cos(0.785398 * k) + down * std::sin(0.785398 * k);
            is_edge |= rays.is_blocked(seen.point[i] + aside * band_m + towards_side_sun * (2.0 * band_m),
                                       towards_side_sun) != blocked;
        }
        if (!is_edge) {
            ++compared;
            shadowed += blocked ? 1U : 0U;
            wrong += (seen.share[i] < 0.5) != blocked ? 1U : 0U;
        }
    }
    fmt::print("{} of {} pixels wrong, {} in shadow, {} levels\n", wrong, compared, shadowed,
               clipmap.level_count);
    EXPECT_LT(static_cast<double>(wrong), 0.01 * static_cast<double>(compared));
    EXPECT_GT(shadowed, 200U);
    EXPECT_GT(compared, 5000U);
}

TEST(SunClipmap, HasATexelForEachPixel)
{
    const Scene scene = colonnade();
    test::Drawing drawing(scene, colonnade_walker(3.0), clipmap_px);
    const Clipmap clipmap = clipmap_of(drawing, towards_side_sun, level_size);
    const ClipmapLit seen = lit_by_clipmap(scene, colonnade_walker(3.0), clipmap);
    const Windows windows = windows_about(clipmap, glm::dvec3(drawing.globals.eye_anchor));
    double least = 1e9;
    double most = 0.0;
    for (size_t i = 0; i < seen.share.size(); ++i) {
        if (seen.share[i] < 0.0) {
            continue;
        }
        // Repeats the shader's choice of level: the finest level that contains the point and is not finer
        // than the page.
        const double pixel_m = seen.away_m[i] * seen.pixel_m;
        const glm::dvec3 point = seen.point[i] - drawing.layout.anchor;
        const auto holds = [&](uint32_t level) {
            const double texel_m = std::ldexp(clipmap.finest_m, static_cast<int>(level));
            const glm::dvec2 at = glm::dvec2(glm::dot(point, glm::dvec3(clipmap.view.right)),
                                             glm::dot(point, glm::dvec3(clipmap.view.down))) /
                                      texel_m -
                                  glm::dvec2(windows[level]);
            return at.x > 3.0 && at.y > 3.0 && at.x < level_size - 3.0 && at.y < level_size - 3.0;
        };
        uint32_t level = 0;
        while (level + 1 < clipmap.level_count &&
               (!holds(level) || std::ldexp(clipmap.finest_m, static_cast<int>(level) + 1) <= pixel_m)) {
            ++level;
        }
        const double ratio = std::ldexp(clipmap.finest_m, static_cast<int>(level)) / pixel_m;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    fmt::print("texel to pixel: {:.3f} to {:.3f}\n", least, most);
    EXPECT_GE(least, 0.5);
    EXPECT_LE(most, 1.05);
}

TEST(SunClipmap, ShadowOfAPointDoesNotFlipWhileTheEyeWalks)
{
    const Scene scene = colonnade();
    test::Drawing still(scene, colonnade_walker(0.0), clipmap_px);
    const Clipmap clipmap = clipmap_of(still, towards_side_sun, level_size);
    double worst = 0.0;
    ClipmapLit before = lit_by_clipmap(scene, colonnade_walker(0.0), clipmap);
    for (int step = 1; step <= 8; ++step) {
        const Camera camera = colonnade_walker(0.1 * step);
        const ClipmapLit now = lit_by_clipmap(scene, camera, clipmap);
        test::Drawing later(scene, camera, clipmap_px);
        const glm::dmat4 clip_from_anchor(later.globals.clip_from_anchor);
        size_t changed = 0;
        size_t seen = 0;
        for (size_t i = 0; i < before.share.size(); ++i) {
            const glm::dvec4 clip = clip_from_anchor * glm::dvec4(before.point[i] - later.layout.anchor, 1.0);
            const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(clipmap_px);
            if (before.share[i] < 0.0 || clip.w <= 0.0 || at.x < 1.0 || at.y < 1.0 ||
                at.x >= clipmap_px.x - 1.0 || at.y >= clipmap_px.y - 1.0) {
                continue;
            }
            ++seen;
            const size_t there = static_cast<size_t>(at.y) * clipmap_px.x + static_cast<size_t>(at.x);
            bool found = false;
            for (const size_t other :
                 {there, there - 1, there + 1, there - clipmap_px.x, there + clipmap_px.x}) {
                found |= std::abs(now.share[other] - before.share[i]) < 0.5;
            }
            changed += found ? 0U : 1U;
        }
        worst = std::max(worst, static_cast<double>(changed) / static_cast<double>(seen));
        before = now;
    }
    fmt::print("{:.4f} % of pixels change in a step of 0.1 m\n", 100.0 * worst);
    EXPECT_LT(worst, 0.005);
}

} // namespace
} // namespace estampe::shadow
