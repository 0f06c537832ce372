// SPDX-License-Identifier: MIT
// A film that is drawn in two runs equals the film drawn in one.
#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include <estampe/renderer.hpp>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr uint32_t frame_count = 8;

Scene smoking_still_life()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F}, {-0.6, 0.0, 0.0});
    test::add_object(scene, shapes::torus(0.6F, 0.25F, 32, 16), {0.2F, 0.4F, 0.7F}, {0.8, 0.6, 0.5});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back({.name = "smoke", .transform = {.translation = {-0.6, 0.75, 0.0}}});
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back({.name = "smoke of another size",
                           .transform = {.translation = {1.6, 0.0, -0.5}, .scale = {0.4, 0.8, 0.4}}});
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style inked()
{
    Style style;
    for (const char* assignment :
         {"contour.hidden.enabled=true", "contour.brush=pencil", "contour.brush_fit=stretch",
          "light.metering=page", "light.adapt_stops_per_s=0.5", "ink.enabled=true", "ink.age_s=0.5",
          "ink.solved=0.7", "smoke.enabled=true", "smoke.cells=16", "smoke.age_s=0.5", "smoke.rise_s=1"}) {
        style.set(assignment);
    }
    return style;
}

Image frame(Renderer& renderer, const Style& style, uint32_t number)
{
    const double angle = 0.4 + 0.006 * number;
    const Camera camera{.eye = {6.0 * std::sin(angle), 3.0 - 0.01 * number, 6.0 * std::cos(angle)},
                        .target = {0.0, 0.4, 0.0}};
    return renderer.render(camera, style,
                           {.width = 240,
                            .height = 180,
                            .time_s = number / 24.0,
                            .continuity = number == 0 ? Continuity::starts : Continuity::follows});
}

TEST(FilmMemory, AnotherRunGoesOnToTheByte)
{
    Renderer& renderer = test::shared_renderer();
    const Style style = inked();
    const Scene scene = smoking_still_life();
    renderer.set_scene(scene);
    std::vector<Image> film;
    std::vector<std::byte> memory;
    for (uint32_t number = 0; number < frame_count; ++number) {
        film.push_back(frame(renderer, style, number));
        if (number == 3) {
            memory = renderer.film_memory();
        }
    }
    ASSERT_FALSE(memory.empty());

    renderer.set_scene(scene);
    renderer.recall_film(memory);
    EXPECT_EQ(renderer.film_memory(), memory);
    for (uint32_t number = 4; number < frame_count; ++number) {
        EXPECT_TRUE(frame(renderer, style, number) == film[number]) << "frame " << number;
    }

    renderer.set_scene(scene);
    EXPECT_FALSE(frame(renderer, style, 4) == film[4]) << "without its memory it is another";
}

/// Coarse smoke without lines, with further assignments.
Style coarse_smoke(const std::vector<std::string>& more)
{
    Style style;
    for (const char* assignment : {"contour.enabled=false", "smoke.enabled=true", "smoke.cells=16",
                                   "smoke.age_s=0.5", "smoke.rise_s=1"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : more) {
        style.set(assignment);
    }
    return style;
}

/// The mass of the air and of the water are part of the film's memory.
TEST(FilmMemory, KeepsTheMassOfFluidsThatAreSolvedByIt)
{
    Renderer& renderer = test::shared_renderer();
    const Scene scene = smoking_still_life();
    renderer.set_scene(scene);
    const Style style = coarse_smoke(
        {"smoke.solver=mass", "ink.enabled=true", "ink.solved=1", "ink.solver=mass", "ink.age_s=0.5"});
    static_cast<void>(frame(renderer, style, 0));
    static_cast<void>(frame(renderer, style, 1));
    const std::vector<std::byte> memory = renderer.film_memory();
    const Image second = frame(renderer, style, 2);
    const std::vector<std::byte> memory_of_second = renderer.film_memory();
    renderer.set_scene(scene);
    renderer.recall_film(memory);
    EXPECT_EQ(renderer.film_memory(), memory);
    EXPECT_TRUE(frame(renderer, style, 2) == second);
    EXPECT_EQ(renderer.film_memory(), memory_of_second) << "air and water to the bit";
}

TEST(FilmMemory, KeepsHowFarSmokeIsBehindThatWasBegunWithinTheFilm)
{
    Renderer& renderer = test::shared_renderer();
    const Scene scene = smoking_still_life();
    renderer.set_scene(scene);
    const Style style = coarse_smoke({"smoke.age_s=2"});
    static_cast<void>(frame(renderer, coarse_smoke({"smoke.enabled=false"}), 0));
    static_cast<void>(frame(renderer, style, 1));
    const std::vector<std::byte> memory = renderer.film_memory();
    const Image second = frame(renderer, style, 2);
    const Image third = frame(renderer, style, 3);
    renderer.set_scene(scene);
    renderer.recall_film(memory);
    EXPECT_TRUE(frame(renderer, style, 2) == second);
    EXPECT_TRUE(frame(renderer, style, 3) == third);
}

TEST(FilmMemory, GoesOnWithoutLinesToo)
{
    Renderer& renderer = test::shared_renderer();
    const Style style = coarse_smoke({"light.metering=page", "light.adapt_stops_per_s=0.5"});
    const Scene scene = smoking_still_life();
    renderer.set_scene(scene);
    static_cast<void>(frame(renderer, style, 0));
    static_cast<void>(frame(renderer, style, 1));
    const std::vector<std::byte> memory = renderer.film_memory();
    const Image next = frame(renderer, style, 2);
    ASSERT_FALSE(memory.empty());
    constexpr size_t smoke_bytes = 20 * (16 * 16 * 16 + 8 * 16 * 8);
    EXPECT_LT(memory.size(), smoke_bytes + 2000) << "lines that nobody draws are not kept";

    renderer.set_scene(scene);
    renderer.recall_film(memory);
    EXPECT_EQ(renderer.film_memory(), memory);
    EXPECT_TRUE(frame(renderer, style, 2) == next);
    renderer.set_scene(scene);
    EXPECT_FALSE(frame(renderer, style, 2) == next) << "without its memory it is another";
    static_cast<void>(renderer.render({.eye = {6.0, 3.0, 0.0}}, style, {.width = 96, .height = 64}));
    EXPECT_TRUE(renderer.film_memory().empty()) << "a picture that stands for itself leaves nothing";
}

TEST(FilmMemory, KeepsFuelAndWaterOfSmoke)
{
    Renderer& renderer = test::shared_renderer();
    Style style = coarse_smoke({"smoke.fuel_per_s=8", "smoke.humidity=2", "smoke.cloud_base=0.2"});
    const Scene scene = smoking_still_life();
    renderer.set_scene(scene);
    static_cast<void>(frame(renderer, style, 0));
    static_cast<void>(frame(renderer, style, 1));
    const std::vector<std::byte> memory = renderer.film_memory();
    const Image next = frame(renderer, style, 2);
    const Image after_that = frame(renderer, style, 3);
    constexpr size_t numbers_a_cell = 3 + 5;
    EXPECT_GT(memory.size(), sizeof(float) * numbers_a_cell * (16 * 16 * 16 + 8 * 16 * 8));
    renderer.set_scene(scene);
    renderer.recall_film(memory);
    EXPECT_EQ(renderer.film_memory(), memory);
    EXPECT_TRUE(frame(renderer, style, 2) == next);
    EXPECT_TRUE(frame(renderer, style, 3) == after_that);
    renderer.set_scene(scene);
    EXPECT_FALSE(frame(renderer, style, 2) == next) << "without its memory it is another";
    // Smoke restarts when it has to carry another quantity.
    renderer.recall_film(memory);
    style.set("smoke.humidity=0");
    EXPECT_NO_THROW(frame(renderer, style, 2));
}

TEST(FilmMemory, RefusesWhatIsNone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(smoking_still_life());
    EXPECT_TRUE(renderer.film_memory().empty());
    static_cast<void>(frame(renderer, inked(), 0));
    std::vector<std::byte> memory = renderer.film_memory();
    for (const size_t size : {size_t{0}, size_t{7}, size_t{100}, memory.size() - 1}) {
        EXPECT_THROW(renderer.recall_film(std::span(memory).first(size)), Error) << size;
    }
    memory.push_back(std::byte{0});
    EXPECT_THROW(renderer.recall_film(memory), Error) << "too long";
    memory.pop_back();
    memory[0] ^= std::byte{1};
    EXPECT_THROW(renderer.recall_film(memory), Error) << "of another kind";
}

/// Offset of the version that follows the section `name` in a film's memory.
size_t version_of(const std::vector<std::byte>& memory, std::string_view name)
{
    const auto bytes = std::as_bytes(std::span(name));
    const auto found = std::search(memory.begin(), memory.end(), bytes.begin(), bytes.end());
    return static_cast<size_t>(found - memory.begin()) + name.size();
}

TEST(FilmMemory, NamesTheFeatureWhoseVersionItDoesNotRead)
{
    Renderer& renderer = test::shared_renderer();
    const Scene scene = smoking_still_life();
    renderer.set_scene(scene);
    static_cast<void>(frame(renderer, inked(), 0));
    const std::vector<std::byte> memory = renderer.film_memory();
    for (const char* name : {"lines", "exposure", "ink", "smoke"}) {
        const size_t at = version_of(memory, name);
        ASSERT_LT(at + 4, memory.size()) << name << " has no section";
        std::vector<std::byte> later = memory;
        later.at(at) = std::byte{99};
        try {
            renderer.recall_film(later);
            FAIL() << name << " of another version was taken";
        } catch (const Error& problem) {
            EXPECT_NE(std::string(problem.what()).find(std::string(name) + " in version 99"),
                      std::string::npos)
                << problem.what();
        }
    }
    EXPECT_EQ(renderer.film_memory(), memory) << "what was refused changed nothing";
}

} // namespace
} // namespace estampe
