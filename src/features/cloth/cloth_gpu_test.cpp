// SPDX-License-Identifier: MIT
// Cloth in pictures: what they show, and when two pictures must be equal.
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/long_jobs.hpp"
#include "set_ups.hpp"
#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"

namespace estampe {
namespace {

constexpr RenderSettings cloth_page{.width = 96, .height = 72};

Style settled_style(const ClothScene& set_up, const char* more = nullptr)
{
    Style style;
    for (const std::string& assignment : set_up.style) {
        style.set(assignment);
    }
    style.set("cloth.settle_s=1");
    if (more != nullptr) {
        style.set(more);
    }
    return style;
}

Image film_frame(Renderer& renderer, const ClothScene& set_up, const Style& style, uint32_t frame)
{
    RenderSettings settings = cloth_page;
    settings.time_s = frame / 24.0;
    settings.continuity = frame == 0 ? Continuity::starts : Continuity::follows;
    return renderer.render(set_up.camera, style, settings);
}

TEST(ClothFrame, StillsHaveTheSameBytesWhateverWasDrawnBefore)
{
    const ClothScene set_up = make_set_up("flag", 0.5F);
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(set_up.scene);
    const Image first = renderer.render(set_up.camera, style, cloth_page);
    EXPECT_EQ(renderer.render(set_up.camera, style, cloth_page).rgba, first.rgba);
    RenderSettings later = cloth_page;
    later.time_s = 0.7;
    EXPECT_GT(test::changed_pixels(renderer.render(set_up.camera, style, later), first), 50U); // it blows
    for (uint32_t frame = 0; frame < 3; ++frame) {
        static_cast<void>(film_frame(renderer, set_up, style, frame));
    }
    EXPECT_EQ(renderer.render(set_up.camera, style, cloth_page).rgba, first.rgba);
    renderer.set_scene(set_up.scene);
    EXPECT_EQ(renderer.render(set_up.camera, style, cloth_page).rgba, first.rgba);
}

TEST(ClothFrame, FilmsGoOnAndCanBeTakenUp)
{
    const ClothScene set_up = make_set_up("swing", 0.4F); // held by an animated node
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    const auto film = [&](uint32_t count) {
        renderer.set_scene(set_up.scene);
        std::vector<Image> frames;
        for (uint32_t i = 0; i < count; ++i) {
            frames.push_back(film_frame(renderer, set_up, style, i));
        }
        return frames;
    };
    const std::vector<Image> whole = film(4);
    EXPECT_GT(test::changed_pixels(whole[3], whole[0]), 20U);
    static_cast<void>(film(2));
    const auto memory = renderer.film_memory();
    renderer.set_scene(set_up.scene);
    renderer.recall_film(memory);
    EXPECT_EQ(film_frame(renderer, set_up, style, 2).rgba, whole[2].rgba);
    EXPECT_EQ(film_frame(renderer, set_up, style, 3).rgba, whole[3].rgba);
}

TEST(ClothFrame, AStillThatIsDrawnAgainTakesNoSteps)
{
    const ClothScene set_up = make_set_up("flag", 0.5F);
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(set_up.scene);
    const auto takes_steps = [&](double time_s, double settle_s) {
        Style settled = style;
        settled.set(fmt::format("cloth.settle_s={}", settle_s));
        RenderSettings settings = cloth_page;
        settings.time_s = time_s;
        static_cast<void>(renderer.render(set_up.camera, settled, settings));
        return std::ranges::any_of(renderer.timings(),
                                   [](const PassTiming& pass) { return pass.name == "cloth/small"; });
    };
    for (const double time_s : {0.0, 0.7, 53.1}) {
        for (const double settle_s : {1.0, 0.37}) { // not a multiple of the step
            EXPECT_TRUE(takes_steps(time_s, settle_s)) << time_s << ' ' << settle_s;
            EXPECT_FALSE(takes_steps(time_s, settle_s)) << time_s << ' ' << settle_s;
        }
    }
}

TEST(ClothFrame, GoesOnWhenSomethingElseIsMadeToMove)
{
    ClothScene set_up = make_set_up("flag", 0.5F);
    const auto other = static_cast<Index>(set_up.scene.nodes.size());
    const Transform far_off{.translation = {0.0, 0.0, 40.0}}; // behind the camera
    set_up.scene.roots.push_back(other);
    set_up.scene.nodes.push_back(
        {.name = "pebble", .transform = far_off, .mesh = static_cast<Index>(set_up.scene.meshes.size())});
    Mesh& pebble = set_up.scene.meshes.emplace_back(Mesh{.name = "pebble"});
    pebble.primitives.push_back({.material = 0,
                                 .positions = {{0.0F, 0.0F, 0.0F}, {0.1F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.1F}},
                                 .indices = {0, 2, 1}});
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    const auto film = [&](bool moves_other) {
        renderer.set_scene(set_up.scene);
        std::vector<Image> frames;
        for (uint32_t i = 0; i < 4; ++i) {
            if (i == 2 && moves_other) { // this builds a new layout
                renderer.place(std::vector{NodePlace{.node = other, .transform = far_off}}, i / 24.0);
            }
            frames.push_back(film_frame(renderer, set_up, style, i));
        }
        return frames;
    };
    const std::vector<Image> whole = film(false);
    EXPECT_GT(test::changed_pixels(whole[3], whole[2]), 20U);
    const std::vector<Image> other_moves = film(true);
    EXPECT_EQ(other_moves[2].rgba, whole[2].rgba);
    EXPECT_EQ(other_moves[3].rgba, whole[3].rgba);
}

TEST(ClothFrame, APictureThatIsGivenUpLosesNoStep)
{
    const ClothScene set_up = make_set_up("swing", 0.4F);
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    const auto film = [&](std::optional<uint32_t> given_up) {
        renderer.set_scene(set_up.scene);
        std::vector<Image> frames;
        for (uint32_t i = 0; i < 4; ++i) {
            if (given_up == i) {
                const ProgressWatch watch([](double) { return false; });
                EXPECT_THROW(static_cast<void>(film_frame(renderer, set_up, style, i)), Error);
            }
            frames.push_back(film_frame(renderer, set_up, style, i));
        }
        return frames;
    };
    const std::vector<Image> whole = film(std::nullopt);
    EXPECT_GT(test::changed_pixels(whole[3], whole[2]), 20U);
    for (const uint32_t given_up : {0U, 2U}) {
        const std::vector<Image> other = film(given_up);
        EXPECT_EQ(other[2].rgba, whole[2].rgba) << given_up;
        EXPECT_EQ(other[3].rgba, whole[3].rgba) << given_up;
    }
}

TEST(ClothFrame, APictureOfAFilmTakesStepsAndPosesOnceInItsOwnGraph)
{
    const ClothScene set_up = make_set_up("flag", 0.5F);           // nothing of the cloth is animated
    const Style style = settled_style(set_up, "ink.enabled=true"); // ink depends on the picture before
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(set_up.scene);
    for (uint32_t frame = 0; frame < 3; ++frame) {
        static_cast<void>(film_frame(renderer, set_up, style, frame));
    }
    const auto count = [&](std::string_view name) {
        return std::ranges::count(renderer.timings(), name, &PassTiming::name);
    };
    EXPECT_EQ(count("pose"), 1);
    EXPECT_EQ(count("cloth/snapshot"), 1);
    EXPECT_EQ(count("cloth/small"), 1);
    EXPECT_EQ(count("posed before"), 0);
}

TEST(ClothFrame, TearsAreDrawnAndTakenUpWithTheFilm)
{
    ClothScene set_up = make_set_up("flag", 0.5F);
    Cloth& cloth = *std::ranges::find_if(set_up.scene.nodes, [](const Node& node) {
                        return node.cloth.has_value();
                    })->cloth;
    const ClothScene whole = set_up;
    cloth.tear = 1.08F;
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    const auto film = [&](const ClothScene& scene, uint32_t count) {
        renderer.set_scene(scene.scene);
        std::vector<Image> frames;
        for (uint32_t i = 0; i < count; ++i) {
            frames.push_back(film_frame(renderer, scene, style, i));
        }
        return frames;
    };
    const std::vector<Image> torn = film(set_up, 4);
    EXPECT_EQ(film_frame(renderer, set_up, style, 0).rgba, torn[0].rgba); // it starts whole
    EXPECT_GT(test::changed_pixels(torn[3], film(whole, 4)[3]), 50U);
    static_cast<void>(film(set_up, 2));
    const auto memory = renderer.film_memory();
    renderer.set_scene(set_up.scene);
    renderer.recall_film(memory);
    EXPECT_EQ(renderer.film_memory(), memory);
    EXPECT_EQ(film_frame(renderer, set_up, style, 2).rgba, torn[2].rgba);
    EXPECT_EQ(film_frame(renderer, set_up, style, 3).rgba, torn[3].rgba);
    renderer.set_scene(whole.scene);
    EXPECT_THROW(renderer.recall_film(memory), Error);
}

TEST(ClothFrame, BodiesThatAreSeenAreTakenUpWithTheFilm)
{
    const ClothScene set_up = make_set_up("cape", 0.4F);
    const Style style = settled_style(set_up, "cloth.bodies=depth");
    Renderer& renderer = test::shared_renderer();
    const auto film = [&](uint32_t first, uint32_t end) {
        std::vector<Image> frames;
        for (uint32_t i = first; i < end; ++i) {
            frames.push_back(film_frame(renderer, set_up, style, i));
        }
        return frames;
    };
    renderer.set_scene(set_up.scene);
    const std::vector<Image> whole = film(0, 4);
    static_cast<void>(film(0, 2));
    const auto memory = renderer.film_memory();
    renderer.set_scene(set_up.scene);
    renderer.recall_film(memory);
    const std::vector<Image> taken_up = film(2, 4);
    EXPECT_EQ(taken_up[0].rgba, whole[2].rgba);
    EXPECT_EQ(taken_up[1].rgba, whole[3].rgba);
    EXPECT_GT(test::changed_pixels(whole[3], whole[2]), 20U);
}

/// A flag that comes to rest soon without wind.
ClothScene limp_flag()
{
    ClothScene set_up = make_set_up("flag", 0.3F);
    Node& flag =
        *std::ranges::find_if(set_up.scene.nodes, [](const Node& node) { return node.cloth.has_value(); });
    flag.cloth->damping_per_s = 15.0F;
    set_up.style.emplace_back("wind.speed_m_per_s=0");
    return set_up;
}

TEST(ClothFrame, WhatRestsIsTakenUpAtRestAndWokenByTheStyle)
{
    const ClothScene set_up = limp_flag();
    const Style style = settled_style(set_up, "cloth.settle_s=4");
    Renderer& renderer = test::shared_renderer();
    const auto film = [&](uint32_t count, bool is_taken_up) {
        std::vector<Image> frames;
        for (uint32_t i = 0; i < count; ++i) {
            if (i == 1 && is_taken_up) {
                const auto memory = renderer.film_memory();
                renderer.set_scene(set_up.scene);
                renderer.recall_film(memory);
            }
            frames.push_back(film_frame(renderer, set_up, style, i));
        }
        return frames;
    };
    renderer.set_scene(set_up.scene);
    const std::vector<Image> whole = film(3, false);
    EXPECT_EQ(test::changed_pixels(whole[1], whole[0]), 0U); // it rests
    const Image blown = film_frame(renderer, set_up, settled_style(set_up, "wind.speed_m_per_s=6"), 8);
    EXPECT_GT(test::changed_pixels(blown, whole[2]), 20U);
    const std::vector<Image> taken_up = film(3, true);
    EXPECT_EQ(taken_up[1].rgba, whole[1].rgba);
    EXPECT_EQ(taken_up[2].rgba, whole[2].rgba);
    const Style restless = settled_style(set_up, "cloth.rest_mm_per_s=0");
    static_cast<void>(film_frame(renderer, set_up, restless, 0));
    const Image still = renderer.render(set_up.camera, style, cloth_page);
    EXPECT_EQ(still.rgba, whole[0].rgba); // regardless of what was awake before
}

TEST(ClothFrame, AirOfSmokeBlowsOnIt)
{
    ClothScene set_up = limp_flag();
    Node node{.name = "draught"};
    node.transform.translation = {1.0, 1.5, 0.0};
    node.transform.scale = glm::dvec3(2.5, 2.0, 2.5);
    set_up.scene.roots.push_back(static_cast<Index>(set_up.scene.nodes.size()));
    set_up.scene.nodes.push_back(node);
    for (const char* assignment :
         {"smoke.enabled=true", "smoke.objects=draught", "smoke.cells=16", "smoke.age_s=0.2",
          "smoke.amount_per_s=0", "smoke.wind_m_per_s=5", "wind.towards_deg=90"}) {
        set_up.style.emplace_back(assignment);
    }
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(set_up.scene);
    const Image limp = renderer.render(set_up.camera, settled_style(set_up), cloth_page);
    const Style style = settled_style(set_up, "wind.from=smoke");
    const Image blown = renderer.render(set_up.camera, style, cloth_page);
    EXPECT_GT(test::changed_pixels(blown, limp), 100U);
    EXPECT_EQ(renderer.render(set_up.camera, style, cloth_page).rgba, blown.rgba);
    EXPECT_EQ(film_frame(renderer, set_up, style, 0).rgba, blown.rgba);
    EXPECT_GT(test::changed_pixels(film_frame(renderer, set_up, style, 3), blown), 20U);
    EXPECT_EQ(renderer.render(set_up.camera, settled_style(set_up), cloth_page).rgba, limp.rgba);
}

TEST(ClothFrame, IsPushedAwayByABlastInTheSmoke)
{
    // Motion of the sheet towards -z, summed over the pixels that show it, shortly after the time of a blast.
    // The camera looks along the sheet.
    const auto pushed_px = [](double from_z, const char* blast) {
        ClothScene set_up = limp_flag();
        set_up.camera.eye = {9.0, 2.6, 0.0};
        set_up.camera.target = {0.0, 2.6, 0.0};
        Node node{.name = "smoke"};
        node.transform.translation = {0.4, 2.4, from_z};
        node.transform.scale = glm::dvec3(1.2);
        set_up.scene.roots.push_back(static_cast<Index>(set_up.scene.nodes.size()));
        set_up.scene.nodes.push_back(node);
        for (const char* assignment :
             {"smoke.enabled=true", "smoke.cells=16", "smoke.age_s=0.1", "smoke.amount_per_s=0",
              "smoke.explodes_above=1", blast, "smoke.blast_heat=20", "wind.from=smoke"}) {
            set_up.style.emplace_back(assignment);
        }
        const Style style = settled_style(set_up);
        Renderer& renderer = test::shared_renderer();
        renderer.set_scene(set_up.scene);
        double sum_px = 0.0;
        for (uint32_t frame = 0; frame < 6; ++frame) {
            RenderSettings settings = cloth_page;
            settings.time_s = frame / 24.0;
            settings.continuity = frame == 0 ? Continuity::starts : Continuity::follows;
            settings.motion_since = Moment{.camera = set_up.camera, .time_s = (frame - 1.0) / 24.0};
            static_cast<void>(renderer.render(set_up.camera, style, settings));
            for (const glm::vec4& pixel : renderer.motion().pixels) {
                sum_px += frame > 1 ? static_cast<double>(pixel.x) : 0.0;
            }
        }
        return sum_px;
    };
    // Without a blast, warm air draws the flag along.
    const auto by_blast_px = [&](double from_z) {
        return pushed_px(from_z, "smoke.blast_at_s=0.06") - pushed_px(from_z, "smoke.blast_at_s=-1");
    };
    const double to_back = by_blast_px(0.6);
    const double to_front = by_blast_px(-0.6);
    EXPECT_GT(to_back, 1.0);
    EXPECT_LT(to_front, -1.0);
}

TEST(ClothFrame, MotionIsOfTheSheetToo)
{
    const ClothScene set_up = make_set_up("flag", 0.5F);
    const Style style = settled_style(set_up);
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(set_up.scene);
    RenderSettings settings = cloth_page;
    settings.time_s = 1.0;
    settings.motion_since = Moment{.camera = set_up.camera, .time_s = 0.95};
    static_cast<void>(renderer.render(set_up.camera, style, settings));
    size_t moved = 0;
    float most_px = 0.0F;
    for (const glm::vec4& pixel : renderer.motion().pixels) {
        const glm::vec2 motion(pixel);
        moved += glm::length(motion) > 0.02F ? 1 : 0;
        most_px = std::max(most_px, glm::length(motion));
    }
    EXPECT_GT(moved, 50U);
    EXPECT_LT(moved, renderer.motion().pixels.size() / 3);
    EXPECT_LT(most_px, 15.0F);
}

TEST(ClothFrame, BothSidesHaveTheirMaterial)
{
    ClothScene set_up = make_set_up("flag", 0.5F);
    Node& flag =
        *std::ranges::find_if(set_up.scene.nodes, [](const Node& node) { return node.cloth.has_value(); });
    flag.cloth->back_material = static_cast<Index>(set_up.scene.materials.size());
    set_up.scene.materials.push_back({.name = "lining", .base_color = {0.7F, 0.02F, 0.02F, 1.0F}});
    set_up.style.emplace_back("wind.speed_m_per_s=3");
    set_up.style.emplace_back("wind.gustiness=0");
    set_up.style.emplace_back("wind.turbulence=0");
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(set_up.scene);
    const auto red_from = [&](double z) {
        Camera camera = set_up.camera;
        camera.eye.z = z;
        Style style = Style::load("chirico"); // a style with colours
        style.set("hatch.enabled=false");     // shade would be black
        for (const std::string& assignment : set_up.style) {
            style.set(assignment);
        }
        const Image image = renderer.render(camera, style, cloth_page);
        size_t count = 0;
        for (size_t i = 0; i < image.rgba.size(); i += 4) {
            count += image.rgba[i] > 2 * image.rgba[i + 1] ? 1 : 0;
        }
        return count;
    };
    const size_t front = red_from(9.0);
    const size_t back = red_from(-9.0);
    EXPECT_GT(back, 100U); // the front faces +z
    EXPECT_LT(front, back / 4);
}

TEST(ClothFrame, ScenesWithoutClothHaveNoPassesOfIt)
{
    ClothScene set_up = make_set_up("flag", 0.5F);
    Renderer& renderer = test::shared_renderer();
    for (Node& node : set_up.scene.nodes) {
        node.cloth.reset();
    }
    renderer.set_scene(set_up.scene);
    static_cast<void>(renderer.render(set_up.camera, settled_style(set_up), cloth_page));
    EXPECT_EQ(renderer.graph_dot().find("cloth"), std::string::npos);
    renderer.set_scene(make_set_up("flag", 0.5F).scene);
    static_cast<void>(renderer.render(set_up.camera, settled_style(set_up), cloth_page));
    EXPECT_NE(renderer.graph_dot().find("cloth"), std::string::npos);
}

} // namespace
} // namespace estampe
