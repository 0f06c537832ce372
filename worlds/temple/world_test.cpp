// SPDX-License-Identifier: MIT
#include "temple/world.hpp"

#include <string>
#include <tuple>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

#include "temple/cameras.hpp"

namespace temple {
namespace {

estampe::Camera seen_from(const World& world, const std::string& name)
{
    estampe::Camera camera;
    for (const Viewpoint& view : find_viewpoints(world.plan(), world.site(), world.desert())) {
        if (view.name == name) {
            camera.eye = glm::dvec3(view.eye_m);
            camera.target = glm::dvec3(view.target_m);
        }
    }
    return camera;
}

TEST(TempleWorld, TheSunStandsAtItsUsualHourWhereTheSceneHasIt)
{
    World world(1, {.hour = 16.67F});
    const estampe::Camera camera = seen_from(world, "court");
    world.go_to(0.0, camera);
    const estampe::SunBearing sun = world.style(estampe::Style::load("temple-day"), camera).sun_bearing();
    EXPECT_TRUE(sun.rules);
    EXPECT_NEAR(sun.azimuth_deg, 66.0, 1.5);
    EXPECT_NEAR(sun.elevation_deg, 17.0, 1.0);
}

TEST(TempleWorld, AStormClosesTheViewOutsideAndNotInTheHalls)
{
    World world(1, {.kind = WeatherKind::storm});
    const estampe::Style day = estampe::Style::load("temple-day");
    const estampe::Camera outside = seen_from(world, "court");
    world.go_to(0.0, outside);
    const estampe::Style stormy = world.style(day, outside);
    EXPECT_LT(stormy.number("haze.reach_m"), 20.0);
    EXPECT_LT(stormy.number("haze.start_m"), 5.0);
    EXPECT_GT(stormy.color("sky.zenith").x, day.color("sky.zenith").x + 0.2F);
    const estampe::Style within = world.style(day, seen_from(world, "last hall"));
    EXPECT_GT(within.number("haze.reach_m"), 0.6 * day.number("haze.reach_m"));

    World calm(1, {.kind = WeatherKind::calm});
    calm.go_to(0.0, outside);
    const estampe::Style clear = calm.style(day, outside);
    EXPECT_NEAR(clear.number("haze.reach_m"), day.number("haze.reach_m"), 0.01);
    EXPECT_NEAR(clear.number("haze.start_m"), day.number("haze.start_m"), 0.01);
}

TEST(TempleWorld, EveryPresetTakesItsWeather)
{
    World world(1, {.kind = WeatherKind::tornado, .hour = 9.0F});
    const estampe::Camera camera = seen_from(world, "avenue");
    world.go_to(1.0, camera);
    for (const std::string& preset : estampe::Style::presets()) {
        const estampe::Style style = world.style(estampe::Style::load(preset), camera);
        EXPECT_EQ(style.number("wind.speed_m_per_s"), static_cast<double>(world.weather().wind_m_per_s))
            << preset;
        EXPECT_EQ(style.number("ink.enabled"), 1.0) << preset;
    }
    EXPECT_THROW(std::ignore = estampe::Style().number("haze.length"), estampe::Error);
    EXPECT_THROW(std::ignore = estampe::Style().number("sky.horizon"), estampe::Error);
    EXPECT_THROW(std::ignore = estampe::Style().color("haze.reach_m"), estampe::Error);
    EXPECT_THROW(std::ignore = estampe::Style().text("haze.reach_m"), estampe::Error);
}

TEST(TempleWorld, ExposesForItsSunWhereAPresetWouldMeterItsLamps)
{
    World world(1);
    const estampe::Camera camera = seen_from(world, "court");
    world.go_to(0.0, camera);
    const auto shown = [&](const std::string& metering) {
        estampe::Style base = estampe::Style::load("comic");
        base.set("light.metering=" + metering);
        base.set("light.ev100=3");
        return world.style(base, camera);
    };
    EXPECT_EQ(shown("lights").text("light.metering"), "manual");
    EXPECT_LT(shown("lights").number("light.ev100"), 0.0);
    EXPECT_EQ(shown("page").text("light.metering"), "page");
    EXPECT_EQ(shown("manual").text("light.metering"), "manual");
    EXPECT_EQ(shown("manual").number("light.ev100"), 3.0);
}

TEST(TempleWorld, IsTheSameInOneLeapAndPictureByPicture)
{
    World leaping(1);
    World walking(1);
    const estampe::Camera camera = seen_from(leaping, "court");
    for (int frame = 0; frame <= 72; ++frame) {
        walking.go_to(frame / 24.0, camera);
    }
    leaping.go_to(3.0, camera);
    for (size_t i = 0; i < leaping.demons().all().size(); ++i) {
        const glm::vec3 off = leaping.demons().all()[i].head() - walking.demons().all()[i].head();
        EXPECT_LT(glm::length(off), 0.02F) << "but for how the wind is sampled";
    }
    EXPECT_EQ(leaping.weather().wind_m_per_s, walking.weather().wind_m_per_s);
    // Going back in time restarts the simulation.
    walking.go_to(1.0, camera);
    walking.go_to(3.0, camera);
    EXPECT_EQ(walking.demons().all()[0].place_m(), leaping.demons().all()[0].place_m());
}

TEST(TempleWorld, AFilmHasALensAnOpenShutterAndSmokeAndAPictureHasNot)
{
    World world(1);
    const estampe::Camera camera = seen_from(world, "last hall");
    world.go_to(0.0, camera);
    estampe::Style base = estampe::Style::load("temple-day");
    const estampe::Style picture = world.style(base, camera);
    EXPECT_EQ(picture.number("lens.enabled"), 0.0);
    EXPECT_EQ(picture.number("motion_blur.enabled"), 0.0);
    EXPECT_EQ(picture.number("smoke.enabled"), 0.0);
    world.film();
    const estampe::Style film = world.style(base, camera);
    EXPECT_EQ(film.number("lens.enabled"), 1.0);
    EXPECT_EQ(film.number("motion_blur.enabled"), 1.0);
    EXPECT_EQ(film.number("smoke.enabled"), 1.0);
    EXPECT_EQ(film.number("smoke.cells"), 64.0);
    // Settings that the style has already are kept.
    base.set("lens.enabled=true");
    base.set("lens.mode=separable");
    base.set("motion_blur.enabled=true");
    base.set("motion_blur.mode=own");
    base.set("smoke.enabled=true");
    base.set("smoke.puff=0.3");
    const estampe::Style own = world.style(base, camera);
    EXPECT_EQ(own.text("lens.mode"), "separable");
    EXPECT_EQ(own.text("motion_blur.mode"), "own");
    EXPECT_EQ(own.number("smoke.puffs"), 1.0);
    EXPECT_NEAR(own.number("smoke.puff"), 0.3, 1e-6);
}

TEST(TempleWorld, WhoCameBeforeWentAroundWhatStandsThere)
{
    for (uint64_t seed = 1; seed <= 10; ++seed) {
        const Plan plan = make_plan(seed);
        const Site site = make_site(seed);
        const Desert desert(plan, seed);
        EXPECT_TRUE(desert.with({}).description().tracks.empty());
        const std::vector<estampe::TerrainTrack> tracks = desert.with({}, true).description().tracks;
        ASSERT_EQ(tracks.size(), 1U);
        const std::vector<glm::dvec2>& path_m = tracks.front().path_m;
        for (size_t i = 0; i + 1 < path_m.size(); ++i) {
            for (double share = 0.0; share <= 1.0; share += 0.02) {
                const glm::dvec2 at_m = glm::mix(path_m[i], path_m[i + 1], share);
                for (const glm::vec3& drum : site.drums) {
                    EXPECT_GT(glm::distance(at_m, glm::dvec2(drum)), 1.8) << seed;
                }
                for (const StandingColumn& column : site.columns) {
                    EXPECT_GT(glm::distance(at_m, glm::dvec2(column.place_m)), 1.2) << seed;
                }
            }
        }
    }
}

TEST(TempleWorld, OnlyASceneOfItsOwnIsMet)
{
    World world(1);
    EXPECT_THROW(world.meet(estampe::Scene{}), estampe::Error);
    EXPECT_NO_THROW(world.meet(world.scene()));
}

} // namespace
} // namespace temple
