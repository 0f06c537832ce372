// SPDX-License-Identifier: MIT
// Merging only the tiles that moving casters touch must give the same texels as a newly drawn map, whatever
// the buffer of moving casters held before.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "features/shadows/shadows.hpp"
#include "features/shadows/sun.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {
namespace {

constexpr uint32_t level_size = 512;
constexpr uint32_t nearest_depth = 0x3f800000U; ///< the depth 1, which would hide everything
const glm::dvec3 towards_sun = glm::normalize(glm::dvec3(-1.0, 0.9, 0.6));
const Bounds casters{.min = {-60.0, 0.0, -60.0}, .max = {60.0, 12.0, 60.0}};

void move(Scene& scene, Index node, const std::vector<glm::vec3>& places)
{
    AnimationChannel channel{.node = node};
    for (const glm::vec3& place : places) {
        channel.times_s.push_back(static_cast<float>(channel.times_s.size()));
        channel.values.insert(channel.values.end(), {place.x, place.y, place.z});
    }
    scene.animations.front().duration_s = channel.times_s.back();
    scene.animations.front().channels.push_back(channel);
}

/// Pillars, and two balls that move once per second: near each other and far apart, outside the finest
/// window, and one while the other rests.
Scene walkers()
{
    Scene scene = test::scene_of(shapes::plane(120.0F, 120.0F));
    for (const double x : {-45.0, -6.0, 0.0, 7.0, 45.0}) {
        test::add_object(scene, shapes::box({1.0F, 12.0F, 1.0F}), glm::vec3(0.7F), {x, 6.0, -0.8 * x});
    }
    scene.animations.emplace_back();
    move(scene, test::add_object(scene, shapes::sphere(0.4F), glm::vec3(1.0F), {}),
         {{-3, 1, 3},
          {-3.2, 1, 3},
          {-3.5, 1, 3.2},
          {-3.5, 1, 3.2},
          {-3, 1, 3},
          {2, 1, 2},
          {1.8, 1, 2},
          {1.8, 1, 2}});
    move(scene, test::add_object(scene, shapes::sphere(0.3F), glm::vec3(1.0F), {}),
         {{3, 2, -3},
          {3.2, 2, -3},
          {3.2, 2, -3},
          {3, 2.2, -2.8},
          {40, 9, -30},
          {40, 9, -29},
          {2, 2, 1},
          {2, 2, 1}});
    return scene;
}

struct EyeMoment {
    double time_s = 0.0;
    double eye_x = 0.0;
};

/// The eye follows, jumps, or moves while nothing else does. At the end all return to their start.
std::vector<EyeMoment> eye_moments()
{
    return {{0.0},       {1.0},       {2.0},      {2.0, 2.0}, {3.0, 2.0}, {3.5, 3.0}, {4.0, 3.0},
            {5.0, 41.0}, {5.5, 40.0}, {6.0, 0.5}, {7.0, 1.0}, {0.0, 0.0}, {0.5, 0.0}};
}

SunMapPlan plan_about(const test::Drawing& drawing, const EyeMoment& moment)
{
    SunMapPlan plan{.size = level_size};
    plan.view = shadow::sun_view(casters, drawing.layout.anchor, towards_sun, level_size);
    plan.clipmap = shadow::fit_clipmap(plan.view, level_size, 0.03, casters.radius());
    plan.windows =
        shadow::windows_about(*plan.clipmap, glm::dvec3(moment.eye_x, 1.0, 0.0) - drawing.layout.anchor);
    return plan;
}

/// A sun map that is kept from moment to moment.
class KeptMap {
public:
    explicit KeptMap(bool are_parted) : are_parted_(are_parted) {}

    void move(const std::vector<Bounds>& places) { memory_.move(places); }

    std::vector<uint32_t> draw(test::Drawing& drawing, const Scene& scene, const SunMapPlan& plan)
    {
        work = memory_.ensure(test::shared_device(), plan, {.by_compute = true, .are_parted = are_parted_});
        if (work.has_still) { // no texel of this buffer was ever cleared
            memory_.pictures() =
                gpu::upload_buffer(test::shared_device(), "garbage",
                                   std::vector<uint32_t>(memory_.pictures().size_bytes() / 4, nearest_depth));
        }
        gpu::Graph graph;
        const raster::RasterInputs raster = drawing.raster_inputs(graph);
        const std::vector<StillCaster> still = still_casters(drawing.layout, scene);
        const gpu::BufferId map =
            memory_.record(graph, {.raster = raster, .layout = drawing.layout, .still = still}, plan, work);
        memory_.drawn(plan);
        return test::run_and_read_as<uint32_t>(graph, map);
    }

    SunMapWork work;

private:
    bool are_parted_;
    SunMap memory_;
};

uint32_t tiles_of(std::span<const shadow::Piece> squares)
{
    uint32_t count = 0;
    for (const shadow::Piece& square : squares) {
        count += square.size.x / 64 * (square.size.y / 64);
    }
    return count;
}

TEST(SunTiles, GiveTheMapDrawnAfresh)
{
    const Scene scene = walkers();
    KeptMap kept(true);
    std::optional<pose::PoseData> before;
    size_t few = 0;
    for (const EyeMoment& moment : eye_moments()) {
        test::Drawing drawing(scene, test::front_camera(5.0, 0.6), {64, 64}, moment.time_s);
        const SunMapPlan plan = plan_about(drawing, moment);
        if (before) {
            kept.move(pose::moved_places(drawing.layout, *before, drawing.pose));
        }
        before = drawing.pose;
        const std::vector<uint32_t> texels = kept.draw(drawing, scene, plan);
        const std::vector<uint32_t> wanted = KeptMap(false).draw(drawing, scene, plan);
        ASSERT_EQ(texels.size(), wanted.size());
        size_t other = 0;
        for (size_t i = 0; i < texels.size(); ++i) {
            other += texels[i] == wanted[i] ? 0U : 1U;
        }
        EXPECT_EQ(other, 0U) << "after " << moment.time_s << " s, from " << moment.eye_x << " m";
        few += kept.work.has_still && 2 * kept.work.tile_count < tiles_of(kept.work.squares) ? 1U : 0U;
    }
    EXPECT_GE(few, 5U); // if windows rest, or move a little
}

} // namespace
} // namespace estampe::features
