// SPDX-License-Identifier: MIT
// Particles and clouds in whole pictures.
#include "features/particles/particles.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

const Camera particle_camera{.eye = {2.0, 1.5, 7.0}, .target = {0.0, 1.5, 0.0}, .vertical_fov_rad = 0.7};
constexpr RenderSettings particle_page{.width = 120, .height = 80};

Scene with_empty(const std::string& name)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    Node node{.name = name};
    node.transform.translation = {0.0, 1.2, 0.0};
    scene.nodes.push_back(node);
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    return scene;
}

RenderSettings moment(double time_s)
{
    RenderSettings settings = particle_page;
    settings.time_s = time_s;
    return settings;
}

TEST(ParticlesInFrame, ComeFromNodesThatArePatternsSay)
{
    const Scene scene = with_empty("emitter of steam");
    const std::vector<size_t> empty{1};
    const std::vector<size_t> none;
    EXPECT_EQ(emitting_nodes(scene, "emitter*"), empty);
    EXPECT_EQ(emitting_nodes(scene, "lamp, *steam"), empty);
    EXPECT_EQ(emitting_nodes(scene, "steam"), none);
    EXPECT_EQ(emitting_nodes(scene, ""), none);
    EXPECT_EQ(emitting_nodes(scene, "*"), empty) << "what has a mesh gives none";
}

TEST(ParticlesInFrame, AreTheSameWhateverWasDrawnBefore)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(with_empty("stand"));
    const Image bare = renderer.render(particle_camera, {}, moment(2.0));
    EXPECT_FALSE(test::has_pass("particles"));
    renderer.set_scene(with_empty("emitter"));
    const Image first = renderer.render(particle_camera, {}, moment(2.0));
    EXPECT_TRUE(test::has_pass("particles"));
    EXPECT_NE(first.rgba, bare.rgba);
    EXPECT_NE(renderer.render(particle_camera, {}, moment(9.0)).rgba, first.rgba);
    EXPECT_EQ(renderer.render(particle_camera, {}, moment(2.0)).rgba, first.rgba);
}

TEST(ParticlesInFrame, GrainsOfSandAreBlownOutwardsByABlast)
{
    particles::ParticleStyle style;
    style.life_s = 4.0F;
    style.per_s = 40.0F;
    const std::vector<particles::Emitter> emitters{{.place = {1.0, 0.0, 0.0}}, {.place = {-1.0, 0.0, 0.0}}};
    const std::vector<Blast> blasts{
        {.centre = {0.0, 0.5, 0.0}, .at_s = 2.0, .start_m3 = 0.1, .growth = 20.0, .rate_per_s = 10.0}};
    for (const double time_s : {1.9, 2.2, 3.0}) {
        const auto calm = particles::particles_at(style, emitters, time_s);
        auto pushed = calm;
        push_away(pushed, style, blasts, time_s);
        size_t moved = 0;
        for (size_t i = 0; i < calm.size(); ++i) {
            const glm::dvec3 away = calm[i].place - blasts[0].centre;
            const glm::dvec3 push = pushed[i].place - calm[i].place;
            const double born_s = time_s - static_cast<double>(calm[i].age * style.life_s);
            const double gained = blasts[0].cubed_radius_m3(time_s) - blasts[0].cubed_radius_m3(born_s);
            if (gained == 0.0) {
                EXPECT_EQ(push, glm::dvec3(0.0));
                continue;
            }
            EXPECT_NEAR(glm::dot(push, glm::normalize(away)), glm::length(push), 1e-9) << "straight outwards";
            EXPECT_GT(glm::length(push), 0.0);
            if (glm::length(away) > 0.5) { // outside of the ball at its start
                const double cube = std::pow(glm::length(pushed[i].place - blasts[0].centre), 3.0);
                EXPECT_NEAR(cube - std::pow(glm::length(away), 3.0), gained, 1e-9);
            }
            EXPECT_GT(glm::dot(pushed[i].velocity - calm[i].velocity, away), 0.0);
            ++moved;
        }
        EXPECT_EQ(moved > 50, time_s > 2.0) << time_s;
    }
    const glm::dvec3 within = blasts[0].centre + glm::dvec3(0.1, 0.0, 0.0); // the ball's radius is 0.29 m
    const double grown = blasts[0].volume_m3(3.0) / blasts[0].volume_m3(1.9);
    EXPECT_NEAR(glm::distance(blasts[0].pushed(within, 1.9, 3.0), blasts[0].centre), 0.1 * std::cbrt(grown),
                1e-12)
        << "air within the ball spreads evenly";
}

TEST(ParticlesInFrame, AreBlownAwayByTheSmokesBlast)
{
    Scene scene = with_empty("emitter");
    Node node{.name = "smoke"};
    scene.nodes.push_back(node);
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    Style style;
    for (const char* assignment :
         {"smoke.enabled=true", "smoke.cells=16", "smoke.age_s=0.1", "smoke.amount_per_s=0",
          "smoke.opacity=0", "smoke.line_mm=0", "smoke.darkness=0"}) {
        style.set(assignment);
    }
    const Image calm = renderer.render(particle_camera, style, moment(2.0));
    style.set("smoke.explodes_above=1");
    EXPECT_EQ(renderer.render(particle_camera, style, moment(2.0)), calm);
    style.set("smoke.blast_at_s=1.5");
    EXPECT_EQ(renderer.render(particle_camera, style, moment(1.4)), [&] {
        Style without = style;
        without.set("smoke.blast_at_s=-1");
        return renderer.render(particle_camera, without, moment(1.4));
    }());
    EXPECT_GT(test::changed_pixels(renderer.render(particle_camera, style, moment(2.0)), calm), 30U);
}

TEST(ParticlesInFrame, SmokeRisesAndThinsFromFrameToFrame)
{
    gpu::Device& device = test::shared_device();
    gpu::Executor executor(device);
    const particles::SheetImage sheet = smoke_sheet(device, executor);
    EXPECT_EQ(smoke_sheet(device, executor).brightness, sheet.brightness);
    const glm::uvec2 cell_px = sheet.size_px / sheet.frames;
    const auto amount_and_height = [&](uint32_t frame) {
        const glm::uvec2 from = cell_px * glm::uvec2(frame % sheet.frames.x, frame / sheet.frames.x);
        glm::dvec2 sums(0.0);
        for (uint32_t y = 0; y < cell_px.y; ++y) {
            for (uint32_t x = 0; x < cell_px.x; ++x) {
                const float value = sheet.brightness[size_t{from.y + y} * sheet.size_px.x + from.x + x];
                EXPECT_GE(value, 0.0F);
                EXPECT_LE(value, 1.0F);
                sums += static_cast<double>(value) * glm::dvec2(1.0, cell_px.y - y);
            }
        }
        return glm::dvec2(sums.x, sums.y / sums.x / cell_px.y);
    };
    glm::dvec2 before = amount_and_height(0);
    EXPECT_NEAR(before.y, 0.36, 0.03);
    for (const uint32_t frame : {9U, 18U, 27U}) {
        const glm::dvec2 now = amount_and_height(frame);
        EXPECT_GT(now.y, before.y + 0.01) << frame;
        EXPECT_LT(now.x, before.x) << frame;
        EXPECT_GT(now.x, 0.75 * before.x) << frame;
        before = now;
    }
}

TEST(ParticlesInFrame, DifferByTheObjectThatGivesThem)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = with_empty("emitter of smoke");
    Node other{.name = "emitter of ink"};
    other.transform.translation = {2.2, 1.2, 0.0};
    scene.nodes.push_back(other);
    scene.roots.push_back(static_cast<Index>(scene.nodes.size() - 1));
    renderer.set_scene(scene);
    Style style;
    style.set("particles.wind_m_per_s=0");
    style.set("particles.swirl_m_per_s=0");
    const Image alike = renderer.render(particle_camera, style, moment(3.0));
    style.set("object.emitter of ink.particles.look=blots");
    style.set("object.emitter of ink.particles.ink=#c00000");
    const Image apart = renderer.render(particle_camera, style, moment(3.0));
    const auto red_in = [](const Image& image, uint32_t from, uint32_t to) {
        size_t red = 0;
        for (uint32_t y = 0; y < image.height; ++y) {
            for (uint32_t x = from; x < to; ++x) {
                const uint8_t* const pixel = &image.rgba[4 * (size_t{y} * image.width + x)];
                red += pixel[0] > pixel[1] + 60 && pixel[0] > pixel[2] + 60 ? 1 : 0;
            }
        }
        return red;
    };
    EXPECT_EQ(red_in(alike, 0, alike.width), 0U);
    EXPECT_EQ(red_in(apart, 0, apart.width / 2), 0U) << "the other's smoke is as it was";
    EXPECT_GT(red_in(apart, apart.width / 2, apart.width), 40U);
}

TEST(PlacedNodesInFrame, AreDrawnAsIfTheSceneHadThemThere)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    test::add_sun(scene, {1.0, 2.0, 1.5}, 3.0F);
    const NodePlace place{0, {.translation = {1.1, 0.4, -0.5}}};
    Scene moved = scene;
    moved.nodes[0].transform = place.transform;
    renderer.set_scene(moved);
    const Image wanted = renderer.render(particle_camera, {}, moment(2.0));
    renderer.set_scene(scene);
    const Image before = renderer.render(particle_camera, {}, moment(1.0));
    renderer.place(std::span(&place, 1), 2.0);
    const Image after = renderer.render(particle_camera, {}, moment(2.0));
    EXPECT_NE(before.rgba, after.rgba);
    size_t different = 0; // scene bounds may differ, and with them the rounding of depths
    for (size_t i = 0; i < wanted.rgba.size(); ++i) {
        different += std::abs(wanted.rgba[i] - after.rgba[i]) > 12 ? 1 : 0;
    }
    EXPECT_LT(different, wanted.rgba.size() / 100);
    const NodePlace none{77, {}};
    EXPECT_THROW(renderer.place(std::span(&none, 1), 3.0), Error);
}

TEST(CloudsInFrame, AreTheSameInTilesAndCostNothingUnasked)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(with_empty("emitter"));
    Style style;
    style.set("sky.enabled=true");
    style.set("hatch.width_mm=0.5");
    std::ignore = renderer.render(particle_camera, style, moment(2.0));
    EXPECT_FALSE(test::has_pass("clouds"));
    style.set("clouds.coverage=0.5");
    const Camera up{.eye = particle_camera.eye, .target = {0.0, 3.5, 0.0}, .vertical_fov_rad = 0.9};
    RenderSettings settings = moment(2.0);
    settings.width = 320;
    settings.height = 220;
    const Image whole = renderer.render(up, style, settings);
    EXPECT_TRUE(test::has_pass("clouds"));
    settings.tile_px = 200;
    const Image tiled = renderer.render(up, style, settings);
    ASSERT_EQ(whole.rgba.size(), tiled.rgba.size());
    size_t different = 0;
    for (size_t i = 0; i < whole.rgba.size(); ++i) {
        different += std::abs(whole.rgba[i] - tiled.rgba[i]) > 8 ? 1 : 0;
    }
    EXPECT_LT(different, whole.rgba.size() / 200);
}

} // namespace
} // namespace estampe::features
