// SPDX-License-Identifier: MIT
// The sun stands still and the eye walks through a long square. Tests which texels the clipmap keeps, and
// that shadows do not crawl.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/shadow/shadow_test_support.hpp"

namespace estampe::shadow {
namespace {

constexpr glm::uvec2 crawl_px(192, 108);
constexpr double step_m = 0.1;
const glm::dvec3 towards_low_sun = glm::normalize(glm::dvec3(0.6, 0.5, 0.4));

Camera square_walker(double along_m)
{
    return {.eye = {along_m, 1.7, 5.0}, .target = {along_m + 18.0, 0.0, -3.0}, .vertical_fov_rad = 0.8};
}

/// The sun's share and the geometry at each pixel of the page.
struct Seen {
    std::vector<double> share;
    std::vector<glm::dvec3> point;  ///< world space
    std::vector<double> away_m;     ///< along the view direction; 0 for the background
    std::vector<glm::dvec3> normal; ///< of the triangle, on the eye's side
    glm::dmat4 clip_from_anchor{1.0};
    glm::dvec3 anchor{0.0};
};

/// A walk that reuses the sun's map from step to step.
class Walk {
public:
    Walk(const Scene& scene, const test::EmbreeScene& rays, const ShadowStyle& style,
         const std::optional<HatchedLines>& lines)
        : scene_(scene), rays_(rays), style_(style), lines_(lines),
          clipmap_(clipmap_of(test::Drawing(scene, square_walker(0.0), crawl_px), towards_low_sun, 1024))
    {
    }

    Seen look(double along_m)
    {
        const Camera camera = square_walker(along_m);
        test::Drawing drawing(scene_, camera, crawl_px);
        drawing.path = path;
        drawing.features = features_;
        shared::LightRecord sun{};
        sun.type = shared::light_directional;
        sun.direction = glm::vec3(towards_low_sun);
        sun.color = glm::vec3(1.0F);
        const auto light = drawing.light({.records = {sun},
                                          .directional_count = 1,
                                          .falloff = 0.0F,
                                          .shadow = style_,
                                          .lines = lines_,
                                          .clipmap = clipmap_,
                                          .keeps_sun_map = true});
        const auto depth = drawing.depth_alone();
        Seen seen{.clip_from_anchor = glm::dmat4(drawing.globals.clip_from_anchor),
                  .anchor = drawing.layout.anchor};
        const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
        for (size_t i = 0; i < light.size(); ++i) {
            const glm::dvec3 point = drawing.point_seen(i, depth[i]) + seen.anchor;
            seen.share.push_back(static_cast<double>(light[i].x));
            const glm::dvec3 way = glm::normalize(point - camera.eye);
            const auto hit = rays_.first_hit(camera.eye, way);
            const glm::dvec3 normal = hit ? hit->normal : glm::dvec3(0.0);
            seen.point.push_back(point);
            seen.normal.push_back(glm::dot(normal, way) > 0.0 ? -normal : normal);
            seen.away_m.push_back(depth[i] > 0.0F ? glm::dot(point - camera.eye, forward) : 0.0);
        }
        return seen;
    }

    [[nodiscard]] const Clipmap& clipmap() const { return clipmap_; }

    /// The current map, level by level.
    [[nodiscard]] std::vector<uint32_t> texels()
    {
        gpu::Graph graph;
        return test::run_and_read_as<uint32_t>(
            graph, gpu::import_whole(graph, "map", features_->shadows.sun().buffer()));
    }

    RasterPath path = RasterPath::compute;

private:
    const Scene& scene_;
    const test::EmbreeScene& rays_;
    ShadowStyle style_;
    std::optional<HatchedLines> lines_;
    Clipmap clipmap_;
    std::shared_ptr<frame::Features> features_ = std::make_shared<frame::Features>();
};

/// The pixel of `now` that shows the same point as a pixel of `before`; empty if it is not visible.
std::optional<size_t> found_again(const Seen& before, size_t pixel, const Seen& now)
{
    if (before.away_m[pixel] <= 0.0) {
        return std::nullopt;
    }
    const glm::dvec4 clip = now.clip_from_anchor * glm::dvec4(before.point[pixel] - now.anchor, 1.0);
    const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(crawl_px);
    if (clip.w <= 0.0 || at.x < 1.0 || at.y < 1.0 || at.x >= crawl_px.x - 1.0 || at.y >= crawl_px.y - 1.0) {
        return std::nullopt;
    }
    const size_t there = static_cast<size_t>(at.y) * crawl_px.x + static_cast<size_t>(at.x);
    const double apart_m = glm::distance(now.point[there], before.point[pixel]);
    return now.away_m[there] > 0.0 && apart_m < 0.1 * now.away_m[there] ? std::optional(there) : std::nullopt;
}

/// Number of pixels whose shadow differs from the previous step: no pixel next to the point's new position
/// has the previous light. Edges may pass between two pixels.
struct Change {
    size_t seen = 0;
    size_t changed = 0;

    [[nodiscard]] double share() const { return static_cast<double>(changed) / static_cast<double>(seen); }
};

Change tone_change(const Seen& before, const Seen& now)
{
    Change change;
    for (size_t i = 0; i < before.share.size(); ++i) {
        const auto there = found_again(before, i, now);
        if (!there) {
            continue;
        }
        bool found = false;
        for (const size_t other :
             {*there, *there - 1, *there + 1, *there - crawl_px.x, *there + crawl_px.x}) {
            found |= std::abs(now.share[other] - before.share[i]) < 0.5;
        }
        ++change.seen;
        change.changed += found ? 0U : 1U;
    }
    return change;
}

/// Whether a pixel's surface faces the sun and continues around the pixel, and whether rays from the point
/// and from places two texels aside agree.
bool is_apart_from_edges(const test::EmbreeScene& rays, const Seen& seen, size_t pixel,
                         const Clipmap& clipmap)
{
    const glm::dvec3& normal = seen.normal[pixel];
    if (glm::dot(normal, towards_low_sun) < 0.02) {
        return false;
    }
    const bool here = rays.is_blocked(seen.point[pixel] + normal * 1e-3, towards_low_sun);
    for (const size_t row : {pixel - crawl_px.x, pixel, pixel + crawl_px.x}) {
        for (const size_t other : {row - 1, row, row + 1}) {
            if (glm::dot(seen.normal[other], normal) < 0.99 ||
                rays.is_blocked(seen.point[other] + normal * 1e-3, towards_low_sun) != here) {
                return false;
            }
        }
    }
    const double pixel_m = 2.0 * std::tan(0.4) / crawl_px.y * seen.away_m[pixel];
    const double band_m = 2.0 * std::max(pixel_m, clipmap.finest_m);
    for (int k = 0; k < 16; ++k) {
        const glm::dvec3 aside = glm::dvec3(clipmap.view.right) * std::cos(0.392699 * k) +
                                 glm::dvec3(clipmap.view.down) * std::sin(0.392699 * k);
        const double away_m = (k % 2 == 0 ? 1.0 : 0.5) * band_m;
        if (rays.is_blocked(seen.point[pixel] + aside * away_m + towards_low_sun * (2.0 * band_m),
                            towards_low_sun) != here) {
            return false;
        }
    }
    return true;
}

/// Pixels away from edges whose point has changed between light and shadow.
Change flips(const test::EmbreeScene& rays, const Seen& before, const Seen& now, const Clipmap& clipmap)
{
    Change change;
    for (size_t i = crawl_px.x; i + crawl_px.x < before.share.size(); ++i) {
        const auto there = found_again(before, i, now);
        if (there && i % crawl_px.x > 0 && (i + 1) % crawl_px.x > 0 &&
            glm::dot(before.normal[i], now.normal[*there]) > 0.99) {
            const bool flipped = (before.share[i] < 0.5) != (now.share[*there] < 0.5);
            ++change.seen;
            change.changed += flipped && is_apart_from_edges(rays, before, i, clipmap) ? 1U : 0U;
        }
    }
    return change;
}

/// Where steps are taken: a few places, or with ESTAMPE_LONG all hundred stretches of ten metres.
std::vector<std::pair<double, int>> stretches()
{
    if (std::getenv("ESTAMPE_LONG") != nullptr) {
        return {{0.0, 100}};
    }
    return {{-61.7, 6}, {0.0, 6}, {33.35, 6}};
}

TEST(SunCrawl, AMapThatCameAlongIsTheMapDrawnAfresh)
{
    const Scene scene = test::long_square();
    const test::EmbreeScene rays(scene);
    for (const RasterPath path : {RasterPath::compute, RasterPath::hardware}) {
        Walk walk(scene, rays, {}, std::nullopt);
        Walk other(scene, rays, {}, std::nullopt);
        walk.path = other.path = path;
        // Moves by single strips, by several strips at once, by a jump that keeps no texel, and back.
        for (const double along_m : {0.0, 0.7, 3.1, 60.0, 58.0, 57.3}) {
            (void)walk.look(along_m);
        }
        (void)other.look(57.3);
        const auto came_along = walk.texels();
        const auto afresh = other.texels();
        ASSERT_EQ(came_along.size(), afresh.size());
        size_t covered = 0;
        size_t outlines = 0;
        size_t bits = 0;
        size_t depths = 0;
        for (size_t i = 0; i < afresh.size(); ++i) {
            covered += afresh[i] != 0 ? 1U : 0U;
            outlines += (came_along[i] == 0) != (afresh[i] == 0) ? 1U : 0U;
            bits += came_along[i] != afresh[i] ? 1U : 0U;
            const float apart = std::bit_cast<float>(came_along[i]) - std::bit_cast<float>(afresh[i]);
            depths += std::abs(apart) > 1e-4F ? 1U : 0U;
        }
        fmt::print("{}: of {} covered texels {} differ, {} by more than 1/10000 of the depth\n",
                   name_of(path), covered, bits, depths);
        EXPECT_GT(covered, 50000U);
        EXPECT_EQ(outlines, 0U) << name_of(path);
        // The device's own rasteriser computes depths from its picture's corner. It is inaccurate for
        // slivers.
        EXPECT_LE(bits, path == RasterPath::compute ? 0U : covered) << name_of(path);
        EXPECT_LE(depths, covered / 100000) << name_of(path);
    }
}

TEST(SunCrawl, ShadowsAndTheirStrokesStayInPlaceWhileTheEyeWalks)
{
    const Scene scene = test::long_square();
    const test::EmbreeScene rays(scene);
    const ShadowStyle toothed{.edge = Edge::strokes, .edge_reach_mm = 3.0F};
    for (const bool has_teeth : {false, true}) {
        Walk walk(scene, rays, has_teeth ? toothed : ShadowStyle(),
                  has_teeth ? std::optional(HatchedLines{.width_mm = 1.5F}) : std::nullopt);
        double worst = 0.0;
        double sum = 0.0;
        Change flipped;
        size_t steps = 0;
        for (const auto& [start_m, count] : stretches()) {
            Seen before = walk.look(start_m);
            for (int step = 1; step <= count; ++step) {
                Seen now = walk.look(start_m + step_m * step);
                const Change change = tone_change(before, now);
                EXPECT_GT(change.seen, crawl_px.x * crawl_px.y / 3);
                worst = std::max(worst, change.share());
                sum += change.share();
                if (!has_teeth) {
                    const Change step_flips = flips(rays, before, now, walk.clipmap());
                    flipped.seen += step_flips.seen;
                    flipped.changed += step_flips.changed;
                }
                before = std::move(now);
                ++steps;
            }
        }
        fmt::print(
            "{}: tone changes in {:.4f} % of pixels a step, {:.4f} % at worst, over {} steps; {} of {} "
            "pixels flip away from edges; {} levels\n",
            has_teeth ? "strokes" : "plain", 100.0 * sum / static_cast<double>(steps), 100.0 * worst, steps,
            flipped.changed, flipped.seen, walk.clipmap().level_count);
        EXPECT_LT(worst, 0.005);
        EXPECT_LE(static_cast<double>(flipped.changed), 1e-6 * static_cast<double>(flipped.seen));
    }
}

} // namespace
} // namespace estampe::shadow
