// SPDX-License-Identifier: MIT
// Smoke in whole pictures and films, through the public header.
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include <array>

#include <gtest/gtest.h>

#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

const Camera smoke_camera{.eye = {3.0, 3.0, 5.0}, .target = {0.0, 1.0, 0.0}};

/// A sunlit box on a floor, with a node above it from which smoke may rise.
Scene smoking_box()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({1.0F, 0.8F, 1.0F}), {0.8F, 0.3F, 0.2F});
    Node node{.name = "smoke of the box"};
    node.transform.translation = {0.0, 0.4, 0.0};
    node.transform.scale = glm::dvec3(0.8, 1.1, 0.8);
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(node);
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style smoking(const std::vector<std::string>& more = {})
{
    Style style;
    for (const char* assignment :
         {"smoke.enabled=true", "smoke.cells=16", "smoke.age_s=0.8", "smoke.rise_s=1"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : more) {
        style.set(assignment);
    }
    return style;
}

constexpr RenderSettings smoke_still{.width = 96, .height = 72, .time_s = 0.25};

std::vector<Image> smoke_film(Renderer& renderer, const Style& style, bool is_measured = false)
{
    std::vector<Image> images;
    for (int number = 0; number < 4; ++number) {
        RenderSettings settings = smoke_still;
        settings.measure_solvers = is_measured;
        settings.time_s = number / 12.0;
        settings.continuity = number == 0 ? Continuity::starts : Continuity::follows;
        images.push_back(renderer.render(smoke_camera, style, settings));
    }
    return images;
}

TEST(RisingSmoke, CostsNothingWhereItIsOff)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    static_cast<void>(renderer.render(smoke_camera, {}, smoke_still)); // poses scene, draws shadow maps
    const Image plain = renderer.render(smoke_camera, {}, smoke_still);
    const std::string graph = renderer.graph_dot();
    Style off;
    off.set("smoke.cells=256");
    EXPECT_EQ(renderer.render(smoke_camera, off, smoke_still), plain);
    EXPECT_EQ(renderer.graph_dot(), graph);
    EXPECT_EQ(graph.find("smoke"), std::string::npos);
}

TEST(RisingSmoke, WantsAnObjectToRiseFrom)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image plain = renderer.render(smoke_camera, {}, smoke_still);
    EXPECT_EQ(renderer.render(smoke_camera, smoking({"smoke.objects=fog*"}), smoke_still), plain);
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_NE(renderer.notes().back().find("fog*"), std::string::npos);
}

TEST(RisingSmoke, AStillStandsForItselfAndAFilmFlowsOn)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image plain = renderer.render(smoke_camera, {}, smoke_still);
    const Image first = renderer.render(smoke_camera, smoking(), smoke_still);
    EXPECT_GT(test::changed_pixels(first, plain), 100U);
    const std::vector<Image> once = smoke_film(renderer, smoking());
    EXPECT_GT(test::changed_pixels(once[2], once[3]), 20U);
    EXPECT_EQ(renderer.render(smoke_camera, smoking(), smoke_still), first);
    EXPECT_EQ(renderer.render(smoke_camera, {}, smoke_still), plain);
    renderer.set_scene(smoking_box());
    EXPECT_EQ(smoke_film(renderer, smoking()), once) << "of the scene loaded anew";
}

TEST(RisingSmoke, BegunWithinAFilmItIsCaughtUpWithPictureByPicture)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image plain = renderer.render(smoke_camera, {}, smoke_still);
    const size_t grown = test::changed_pixels(renderer.render(smoke_camera, smoking(), smoke_still), plain);
    std::vector<size_t> seen;
    for (int number = 0; number < 6; ++number) {
        RenderSettings settings = smoke_still;
        settings.time_s = number / 12.0;
        settings.continuity = number == 0 ? Continuity::starts : Continuity::follows;
        seen.push_back(test::changed_pixels(
            renderer.render(smoke_camera, number == 0 ? Style() : smoking(), settings), plain));
    }
    EXPECT_EQ(seen[0], 0U);
    EXPECT_GT(seen[1], 0U);
    EXPECT_LT(seen[1], grown / 2) << "all of its age at once";
    EXPECT_LT(seen[1], seen[2]);
    EXPECT_GT(seen[5], grown * 3 / 4);
}

/// Passes of the last picture's graph that belong to fluid steps.
size_t steps_within(const Renderer& renderer)
{
    const std::string graph = renderer.graph_dot();
    size_t count = 0;
    for (size_t at = graph.find("fluid/advect"); at != std::string::npos;
         at = graph.find("fluid/advect", at + 1)) {
        ++count;
    }
    return count;
}

TEST(RisingSmoke, TakesItsLastStepsBesideThePictureAsItWouldBefore)
{
    Scene scene = smoking_box();
    Node other = scene.nodes.back();
    other.transform.translation = {1.5, 0.0, -0.5};
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(other);
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const std::vector<Image> beside = smoke_film(renderer, smoking());
    EXPECT_GT(steps_within(renderer), 0U);
    renderer.set_scene(scene);
    EXPECT_EQ(smoke_film(renderer, smoking(), true), beside); // measured: one graph per step
    EXPECT_EQ(steps_within(renderer), 0U);
}

TEST(RisingSmoke, RisesByEachSolverAndAdvectionAsTheStyleSays)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image usual = renderer.render(smoke_camera, smoking(), smoke_still);
    // These choices select the defaults by name.
    EXPECT_EQ(renderer.render(smoke_camera, smoking({"smoke.solver=spectral", "smoke.advection=maccormack"}),
                              smoke_still),
              usual);
    EXPECT_LT(test::changed_pixels(
                  renderer.render(smoke_camera, smoking({"smoke.solver=multigrid"}), smoke_still), usual),
              60U);
    for (const char* other : {"smoke.solver=jacobi", "smoke.advection=linear", "smoke.advection=cubic",
                              "smoke.stepping=reflect"}) {
        EXPECT_GT(test::changed_pixels(renderer.render(smoke_camera, smoking({other}), smoke_still), usual),
                  10U)
            << other;
    }
    // Pictures while the smoke rises.
    std::vector<Image> images = smoke_film(renderer, smoking());
    RenderSettings settings = smoke_still;
    settings.time_s = 4.0 / 12.0;
    settings.continuity = Continuity::follows;
    const Image by_other = renderer.render(smoke_camera, smoking({"smoke.solver=multigrid"}), settings);
    EXPECT_LT(test::changed_pixels(by_other, images.back()),
              test::changed_pixels(by_other, renderer.render(smoke_camera, {}, smoke_still)))
        << "it goes on";
    EXPECT_NO_THROW(renderer.render(smoke_camera, smoking({"smoke.solver=spectral", "smoke.obstacles=true"}),
                                    smoke_still));
}

TEST(RisingSmoke, ExplodesAtItsTimeAndCostsNothingIfItDoesNot)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image calm = renderer.render(smoke_camera, smoking(), smoke_still);
    EXPECT_EQ(renderer.graph_dot().find("fluid/swell"), std::string::npos);
    // No air is so warm.
    EXPECT_EQ(renderer.render(smoke_camera, smoking({"smoke.explodes_above=50"}), smoke_still), calm);
    EXPECT_NE(renderer.graph_dot().find("fluid/swell"), std::string::npos);
    const std::vector<std::string> blast{"smoke.explodes_above=5", "smoke.blast_heat=60",
                                         "smoke.blast_at_s=0.1"};
    EXPECT_GT(test::changed_pixels(renderer.render(smoke_camera, smoking(blast), smoke_still), calm), 200U);
    std::vector<std::string> later = blast;
    later.back() = "smoke.blast_at_s=0.26";
    EXPECT_EQ(renderer.render(smoke_camera, smoking(later), smoke_still), calm) << "not yet";
    const std::vector<Image> film = smoke_film(renderer, smoking(blast));
    const std::vector<Image> calm_film = smoke_film(renderer, smoking({"smoke.explodes_above=50"}));
    EXPECT_EQ(film[1], calm_film[1]) << "before 0.1 s";
    EXPECT_GT(test::changed_pixels(film[2], calm_film[2]), 100U);
    EXPECT_EQ(smoke_film(renderer, smoking(blast), true), film) << "measured: one graph per step";
    EXPECT_TRUE(renderer.notes().empty());
}

TEST(RisingSmoke, SaysWhyABlastDoesNotHappen)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    static_cast<void>(renderer.render(smoke_camera, smoking({"smoke.blast_at_s=0.1"}), smoke_still));
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_NE(renderer.notes().back().find("smoke.explodes_above is 0"), std::string::npos);
    static_cast<void>(renderer.render(
        smoke_camera, smoking({"smoke.blast_at_s=0.1", "smoke.explodes_above=50"}), smoke_still));
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_NE(renderer.notes().back().find("smoke.blast_heat"), std::string::npos);
}

TEST(RisingSmoke, ATiledPageIsTheSame)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    RenderSettings settings{.width = 200, .height = 120};
    const Image whole = renderer.render(smoke_camera, smoking(), settings);
    settings.tile_px = 120;
    EXPECT_LT(test::changed_pixels(renderer.render(smoke_camera, smoking(), settings), whole), 20U);
}

TEST(RisingSmoke, HasALayerOfItsOwn)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Style style = smoking({"smoke.shadow=0"}); // other layers would show the shadow
    const LayeredImage with = renderer.render_layers(smoke_camera, style, smoke_still);
    ASSERT_FALSE(with.layers.empty());
    EXPECT_EQ(with.layers.back().name, "smoke");
    EXPECT_EQ(with.picture, renderer.render(smoke_camera, style, smoke_still));
    const LayeredImage without = renderer.render_layers(smoke_camera, {}, smoke_still);
    ASSERT_EQ(with.layers.size(), without.layers.size() + 1);
    EXPECT_EQ(with.layers[with.layers.size() - 2].image.pixels, without.layers.back().image.pixels);
}

TEST(RisingSmoke, FlowsAroundWhatStandsInItsBox)
{
    Scene scene = smoking_box();
    test::add_object(scene, shapes::box({0.9F, 0.1F, 0.9F}), {0.5F, 0.5F, 0.5F}, {0.0, 1.2, 0.0});
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Image through = renderer.render(smoke_camera, smoking(), smoke_still);
    const Image around = renderer.render(smoke_camera, smoking({"smoke.obstacles=true"}), smoke_still);
    EXPECT_GT(test::changed_pixels(through, around), 50U);
}

TEST(RisingSmoke, RisesInSeveralBoxesEachItsOwnWay)
{
    const auto render = [](const std::vector<glm::dvec3>& places) {
        Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
        for (const glm::dvec3& place : places) {
            scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
            scene.nodes.push_back(
                {.name = "smoke", .transform = {.translation = place, .scale = glm::dvec3(0.5)}});
        }
        test::add_sun(scene, {1.0, 2.0, 1.5});
        test::shared_renderer().set_scene(scene);
        return test::shared_renderer().render({.eye = {0.0, 1.0, 6.0}, .target = {0.0, 0.5, 0.0}}, smoking(),
                                              smoke_still);
    };
    const Image none = render({});
    const Image left = render({{-1.5, 0.0, 0.0}});
    const Image right = render({{1.5, 0.0, 0.0}});
    const Image both = render({{-1.5, 0.0, 0.0}, {1.5, 0.0, 0.0}});
    size_t as_left = 0;
    size_t in_left = 0;
    size_t in_right = 0;
    size_t otherwise = 0;
    for (uint32_t i = 0; i < smoke_still.width * smoke_still.height; ++i) {
        const auto differ = [&](const Image& a, const Image& b) {
            return !std::equal(&a.rgba[4 * i], &a.rgba[4 * i] + 4, &b.rgba[4 * i]);
        };
        const bool is_left = i % smoke_still.width < smoke_still.width / 2;
        in_left += is_left && differ(left, none) ? 1 : 0;
        as_left += is_left && differ(left, none) && !differ(left, both) ? 1 : 0;
        in_right += !is_left && differ(both, none) ? 1 : 0;
        otherwise += !is_left && differ(both, right) ? 1 : 0;
    }
    EXPECT_GT(in_left, 50U);
    EXPECT_GT(static_cast<double>(as_left), 0.95 * static_cast<double>(in_left));
    EXPECT_GT(in_right, 50U);
    EXPECT_GT(otherwise, 20U) << "the second is no copy of the first";
}

TEST(RisingSmoke, SaysHowManyBoxesAreTooMany)
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    for (int i = 0; i < 9; ++i) {
        scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
        scene.nodes.push_back({.name = "smoke", .transform = {.scale = glm::dvec3(0.1)}});
    }
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    static_cast<void>(renderer.render(smoke_camera, smoking({"smoke.age_s=0"}), smoke_still));
    ASSERT_FALSE(renderer.notes().empty());
    EXPECT_EQ(renderer.notes().back(), "smoke rises from the first 8 of 9 objects");
}

/// A sunlit plain, with or without a wall behind it, and a node for smoke.
Scene plain_with_smoke(bool has_roof)
{
    Scene scene = test::scene_of(shapes::plane(12.0F, 12.0F));
    if (has_roof) {
        test::add_object(scene, shapes::box({6.0F, 0.2F, 6.0F}), {0.5F, 0.5F, 0.5F}, {2.0, 5.0, 3.0});
    }
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back({.name = "smoke"});
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

double darkness(const Image& image)
{
    double sum = 0.0;
    for (const uint8_t byte : image.rgba) {
        sum += 255.0 - byte;
    }
    return sum;
}

TEST(RisingSmoke, ThrowsItsShadowOnTheSceneAndLiesInTheScenes)
{
    Renderer& renderer = test::shared_renderer();
    const std::vector<std::string> flat{"smoke.medium=wash", "smoke.line_mm=0", "contour.enabled=false"};
    const auto render = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = flat;
        all.insert(all.end(), more.begin(), more.end());
        return renderer.render({.eye = {-2.6, 3.0, 2.2}, .target = {-0.5, 0.3, -0.5}}, smoking(all),
                               smoke_still);
    };
    renderer.set_scene(plain_with_smoke(false));
    const Image with = render({});
    const Image without = render({"smoke.shadow=0"});
    EXPECT_GT(test::changed_pixels(with, without), 100U);
    EXPECT_GT(darkness(with), darkness(without));
    EXPECT_EQ(without, render({"smoke.shadow=0", "smoke.shaded=false"})) << "nothing stands in the sun's way";
    renderer.set_scene(plain_with_smoke(true));
    const Image in_shade = render({"smoke.shadow=0"});
    const Image unshaded = render({"smoke.shadow=0", "smoke.shaded=false"});
    EXPECT_GT(test::changed_pixels(in_shade, unshaded), 100U);
    EXPECT_GT(darkness(in_shade), darkness(unshaded));
}

TEST(RisingSmoke, BeginsWhereItRisesFrom)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    // Seen from the side: 72 pixels are one metre, and the box ends 0.05 m below the middle.
    Camera level{.eye = {0.0, 0.45, 6.0}, .target = {0.0, 0.45, 0.0}};
    level.orthographic_half_height_m = 0.5;
    const std::vector<std::string> flat{"smoke.medium=wash", "smoke.line_mm=0", "smoke.shadow=0",
                                        "paper.margin_mm=0"};
    Style bare;
    bare.set(flat.back());
    RenderSettings settings = smoke_still;
    for (const double time_s : {0.0, 0.06, 0.12, 0.18}) {
        settings.time_s = time_s;
        const Image with = renderer.render(level, smoking(flat), settings);
        const Image without = renderer.render(level, bare, settings);
        size_t covered = 0;
        for (uint32_t y = 32; y < 39; ++y) {
            for (uint32_t x = 40; x < 56; ++x) {
                const size_t byte = size_t{4} * (y * settings.width + x);
                covered += std::equal(&with.rgba[byte], &with.rgba[byte] + 4, &without.rgba[byte]) ? 0 : 1;
            }
        }
        EXPECT_GT(covered, 7U * 16U * 8U / 10U) << "a tenth of a metre above the box, at " << time_s << " s";
    }
}

TEST(RisingSmoke, TellsWhatItsSolverLeft)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image usual = renderer.render(smoke_camera, smoking(), smoke_still);
    EXPECT_TRUE(renderer.solver_reports().empty());
    EXPECT_EQ(renderer.timings().end(),
              std::ranges::find(renderer.timings(), "fluid/measure", &PassTiming::name));
    RenderSettings measured = smoke_still;
    measured.measure_solvers = true;
    const auto report_of = [&](const std::vector<std::string>& more) {
        static_cast<void>(renderer.render(smoke_camera, smoking(more), measured));
        const std::vector<SolverReport> reports = renderer.solver_reports();
        return reports.size() == 1 ? reports.front() : SolverReport{};
    };
    EXPECT_EQ(renderer.render(smoke_camera, smoking(), measured), usual) << "the picture is the same";
    const SolverReport direct = report_of({});
    EXPECT_EQ(direct.fluid, "smoke");
    EXPECT_EQ(direct.solver, "spectral");
    EXPECT_EQ(direct.steps, 20U) << "0.8 seconds, 24 each";
    EXPECT_GT(direct.divergence_left, 0.0);
    EXPECT_LT(direct.divergence_left, 1e-2);
    double of_all = 0.0;
    for (const PassTiming& pass : renderer.timings()) {
        of_all += pass.gpu_ms;
    }
    EXPECT_GT(direct.gpu_ms, 0.0);
    EXPECT_LT(direct.gpu_ms, of_all);
    const SolverReport cycles = report_of({"smoke.solver=multigrid"});
    EXPECT_EQ(cycles.solver, "multigrid");
    EXPECT_LT(cycles.divergence_left, 1e-2);
    const SolverReport rounds = report_of({"smoke.solver=jacobi"});
    EXPECT_EQ(rounds.solver, "jacobi");
    EXPECT_GT(rounds.divergence_left, 10.0 * direct.divergence_left);
    EXPECT_GT(report_of({"smoke.solver=jacobi", "smoke.jacobi_passes=10"}).divergence_left,
              2.0 * rounds.divergence_left);
    EXPECT_EQ(report_of({"smoke.solver=jacobi", "smoke.jacobi_passes=100", "smoke.stepping=reflect"}).steps,
              direct.steps)
        << "the most passes fit into one graph";
    // A page in tiles is prepared twice if ink flows too.
    measured.tile_px = 64;
    static_cast<void>(renderer.render(
        smoke_camera, smoking({"ink.enabled=true", "ink.age_s=0.2", "ink.solved=1"}), measured));
    const std::vector<SolverReport> both = renderer.solver_reports();
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0].divergence_left, direct.divergence_left);
    EXPECT_EQ(both[0].steps, direct.steps);
    EXPECT_EQ(both[1].fluid, "ink");
    EXPECT_GT(both[1].divergence_left, 0.0);
    EXPECT_LT(both[1].divergence_left, 1e-2);
    static_cast<void>(renderer.render(smoke_camera, {}, smoke_still));
    EXPECT_TRUE(renderer.solver_reports().empty());
}

/// Number of pixels that differ in rows `first` to `last`, without `last`.
size_t changed_between(const Image& a, const Image& b, uint32_t first, uint32_t last)
{
    size_t count = 0;
    for (size_t i = size_t{4} * a.width * first; i < size_t{4} * a.width * last; i += 4) {
        count += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]) ? 0 : 1;
    }
    return count;
}

/// Side view of a box 2 m high and wide: 72 pixels are 2.4 m, and the floor is row 66.
struct SideView {
    Camera camera{.eye = {0.0, 1.0, 6.0}, .target = {0.0, 1.0, 0.0}};

    SideView() { camera.orthographic_half_height_m = 1.2; }
};

TEST(RisingSmoke, KeysOfFireAndWaterDoNothingWhereThereIsNone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_box());
    const Image usual = renderer.render(smoke_camera, smoking(), smoke_still);
    EXPECT_EQ(renderer.graph_dot().find("smoke/seen"), std::string::npos);
    EXPECT_EQ(renderer.render(smoke_camera,
                              smoking({"smoke.burn_s=3", "smoke.burn_heat=9", "smoke.soot=7", "smoke.flame=9",
                                       "smoke.cloud_base=0", "smoke.humidity_outside=1",
                                       "smoke.latent_heat=9", "smoke.flame_color=#000000"}),
                              smoke_still),
              usual);
    EXPECT_NE(renderer.render(smoke_camera, smoking({"smoke.fuel_per_s=8"}), smoke_still), usual);
    EXPECT_NE(renderer.graph_dot().find("smoke/seen"), std::string::npos);
}

TEST(RisingSmoke, WhatBurnsIsSeenAsFlamesAboveItsSource)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(plain_with_smoke(false));
    const std::vector<std::string> fire{"smoke.amount_per_s=0", "smoke.fuel_per_s=20",
                                        "smoke.flame_color=#ff0000", "paper.margin_mm=0"};
    const auto red_rows = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = fire;
        all.insert(all.end(), more.begin(), more.end());
        const Image image = renderer.render(SideView().camera, smoking(all), smoke_still);
        std::array<size_t, 2> count{}; // in the upper and the lower half of the box
        for (uint32_t i = 0; i < smoke_still.width * 66; ++i) {
            const uint8_t* const texel = &image.rgba[size_t{4} * i];
            const bool is_red = texel[0] > 150 && texel[1] < 70 && texel[2] < 70;
            count.at(i / smoke_still.width < 36 ? 0 : 1) += is_red ? 1 : 0;
        }
        return count;
    };
    const auto rows = red_rows({"smoke.burn_s=0.1"});
    EXPECT_GT(rows[1], 40U);
    EXPECT_LT(rows[0], rows[1] / 4) << "above is smoke";
    EXPECT_EQ(red_rows({"smoke.flame=0"})[1], 0U);
    EXPECT_GT(red_rows({"smoke.burn_s=1"})[0], 20U) << "what burns longer is higher";
}

TEST(RisingSmoke, AMoistPlumeIsUnseenUpToItsCloud)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(plain_with_smoke(false));
    const std::vector<std::string> flat{"smoke.medium=wash", "smoke.shadow=0", "smoke.age_s=2",
                                        "smoke.amount_per_s=0", "paper.margin_mm=0"};
    const auto render = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = flat;
        all.insert(all.end(), more.begin(), more.end());
        return renderer.render(SideView().camera, smoking(all), smoke_still);
    };
    const Image dry = render({});
    const Image high = render({"smoke.humidity=2", "smoke.cloud_base=0.5"});
    EXPECT_GT(changed_between(high, dry, 0, 36), 60U);
    EXPECT_EQ(changed_between(high, dry, 38, 72), 0U) << "below the base, but for an edge";
    const Image low = render({"smoke.humidity=2", "smoke.cloud_base=0.2"});
    EXPECT_GT(changed_between(low, dry, 38, 72), 20U);
}

TEST(RisingSmoke, ItsFireIsALamp)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(plain_with_smoke(true));
    const Camera above{.eye = {-3.0, 3.0, 5.0}, .target = {0.0, 0.3, 0.0}};
    const std::string exposed = "tone.curve=linear";
    const Image dark = renderer.render(above, smoking({exposed}), smoke_still);
    const Image lit = renderer.render(above, smoking({exposed, "smoke.glow=3"}), smoke_still);
    EXPECT_GT(test::changed_pixels(dark, lit), 200U);
    EXPECT_LT(darkness(lit), darkness(dark));
}

} // namespace
} // namespace estampe
