// SPDX-License-Identifier: MIT
// Distances on the page to things, for surfaces that the tests set pixel by pixel.
#include "techniques/halo/halo.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::halo {
namespace {

constexpr glm::uvec2 size_px(203, 121); // not a multiple of a texel
constexpr glm::uvec2 size_texels(52, 31);
constexpr float reach_px = 37.0F;

struct Page {
    test::Painter<uint32_t> word = [](glm::uvec2) { return 0U; };
    test::Painter<glm::vec3> normal = [](glm::uvec2) { return glm::vec3(0, 0, 1); };
    glm::uvec2 from_px{0}; ///< place of the tile on the page
};

std::vector<float> distances_of(const Page& page)
{
    shared::FrameGlobals globals = features::frame_globals({}, {}, glm::dvec3(0.0), {.size_px = size_px});
    globals.tile_from_px = page.from_px;
    gpu::Buffer frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
    auto draw = test::Layer::words(size_px, page.word);
    auto normal = test::Layer::normals(size_px, page.normal);
    gpu::Graph graph;
    return test::run_and_read_coverage(
        graph, add_distances(graph, {.frame = gpu::import_whole(graph, "frame", frame),
                                     .draw = draw.in(graph),
                                     .normal = normal.in(graph),
                                     .ground_draws = {7U, UINT32_MAX},
                                     .reach_px = reach_px,
                                     .pixels_per_mm = 4.0F,
                                     .size_px = size_px}));
}

bool has_things(const Page& page)
{
    const std::vector<float> distances = distances_of(page);
    return std::ranges::find(distances, 0.0F) != distances.end();
}

TEST(Halo, DistancesAreThoseToTheNearestThing)
{
    // A post, a beam and a single pixel before bare paper.
    const auto is_thing = [](glm::uvec2 p) {
        return (p.x > 50 && p.x < 61 && p.y > 70) || (p.y == 20 && p.x > 90 && p.x < 150) ||
               p == glm::uvec2(202, 120);
    };
    for (const glm::uvec2 from_px :
         {glm::uvec2(0), glm::uvec2(8, 4), glm::uvec2(1, 2), glm::uvec2(1023, 517)}) {
        const std::vector<float> found =
            distances_of({.word = [&](glm::uvec2 p) { return is_thing(p) ? 1U : 0U; }, .from_px = from_px});
        ASSERT_EQ(found.size(), size_t{size_texels.x} * size_texels.y);
        const glm::uvec2 offset_px = from_px % 4U; // texels lie on a lattice of the page, not of the tile
        std::vector<glm::ivec2> things;
        for (uint32_t y = 0; y < size_px.y; ++y) {
            for (uint32_t x = 0; x < size_px.x; ++x) {
                if (is_thing({x, y})) {
                    things.emplace_back((x + offset_px.x) / 4, (y + offset_px.y) / 4);
                }
            }
        }
        for (size_t i = 0; i < found.size(); ++i) {
            const glm::ivec2 texel(i % size_texels.x, i / size_texels.x);
            double least_px = 1e9;
            for (const glm::ivec2& thing : things) {
                least_px = std::min(least_px, 4.0 * std::hypot(thing.x - texel.x, thing.y - texel.y));
            }
            if (least_px <= static_cast<double>(reach_px)) {
                // Two numbers above 32 are rounded to half floats.
                EXPECT_NEAR(static_cast<double>(found[i]), least_px, 2.0 / 64.0)
                    << texel.x << ", " << texel.y;
            } else {
                EXPECT_GT(found[i], reach_px) << texel.x << ", " << texel.y;
            }
        }
    }
}

TEST(Halo, GroundAndLevelPlanesAreNoThings)
{
    const auto all = [](uint32_t word) { return [word](glm::uvec2) { return word; }; };
    EXPECT_TRUE(has_things({.word = all(1U)}));  // a wall
    EXPECT_FALSE(has_things({.word = all(8U)})); // the ground's draw call, whatever its normals
    const glm::vec3 up(0, 1, 0);
    EXPECT_FALSE(has_things({.word = all(1U), .normal = [&](glm::uvec2) { return up; }}));
    // A steep plane and a dome, which is level but not flat.
    const glm::vec3 steep = glm::normalize(glm::vec3(1, 1, 0));
    EXPECT_TRUE(has_things({.word = all(1U), .normal = [&](glm::uvec2) { return steep; }}));
    EXPECT_TRUE(has_things({.word = all(1U), .normal = [](glm::uvec2 p) {
                                return glm::normalize(glm::vec3(2e-3F * static_cast<float>(p.x), 1, 0));
                            }}));
}

TEST(Halo, NarrowEdgesOfFloorsAreNoThings)
{
    // Steps between slabs of a floor are edges up to about 1.2 mm on the page: 5 pixels, two squares of 4.
    const auto floor_with_step = [](uint32_t width_px, bool runs_down) {
        return Page{.word = [](glm::uvec2) { return 1U; },
                    .normal =
                        [=](glm::uvec2 p) {
                            const uint32_t at = runs_down ? p.x : p.y;
                            return at >= 50 && at < 50 + width_px ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
                        }};
    };
    for (const bool runs_down : {false, true}) {
        EXPECT_FALSE(has_things(floor_with_step(1, runs_down)));
        EXPECT_FALSE(has_things(floor_with_step(5, runs_down)));
        EXPECT_TRUE(has_things(floor_with_step(17, runs_down)));
    }
}

TEST(Halo, ReachesAsFarAsTilesAllow)
{
    EXPECT_EQ(halo::reach_px(0.0F, 10.0F), 0U);
    EXPECT_EQ(halo::reach_px(3.0F, 10.0F), 50U);
}

} // namespace
} // namespace estampe::halo
