// SPDX-License-Identifier: MIT
#include "registry.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "test_world.hpp"

namespace worlds {
namespace {

std::string registry_refusal(Registry& worlds, Description description)
{
    const size_t count = worlds.all().size();
    try {
        worlds.add(std::move(description));
    } catch (const estampe::Error& problem) {
        EXPECT_EQ(worlds.all().size(), count) << "what is refused is not kept";
        return problem.what();
    }
    return "taken";
}

TEST(WorldRegistry, FindsWorldsByName)
{
    Registry worlds;
    EXPECT_EQ(worlds.find("box"), nullptr);
    worlds.add(test::box_description());
    const Description* const box = worlds.find("box");
    ASSERT_NE(box, nullptr);
    EXPECT_EQ(worlds.find("bo"), nullptr);
    EXPECT_EQ(worlds.find("Box"), nullptr);
    EXPECT_EQ(worlds.find(""), nullptr);
    Description other = test::box_description();
    other.name = "box-2";
    worlds.add(other);
    EXPECT_EQ(worlds.find("box"), box) << "a world stays where it is";
    const Values wide(box->options, std::vector<std::string>{"width=3"});
    const estampe::Scene scene = box->make(wide)->scene();
    const estampe::Bounds bounds = scene_bounds(scene, pose_scene(scene, 0.0, estampe::no_index));
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(scene.nodes.at(1).name, "box");
}

TEST(WorldRegistry, RefusesWhatCannotBeToldApartOrMade)
{
    Registry worlds;
    EXPECT_EQ(registry_refusal(worlds, test::box_description()), "taken");
    EXPECT_EQ(registry_refusal(worlds, test::box_description()), "box: there are two worlds of this name");
    for (const char* name : {"", "Box", "box.glb", "a/b", "-o", "two words"}) {
        Description named = test::box_description();
        named.name = name;
        EXPECT_NE(registry_refusal(worlds, named), "taken") << name;
    }
    Description twice = test::box_description();
    twice.name = "twice";
    twice.options.push_back(twice.options.front());
    EXPECT_NE(registry_refusal(worlds, twice).find("the option \"width\""), std::string::npos);
    Description outside = test::box_description();
    outside.name = "outside";
    outside.options.front().initial = "99";
    EXPECT_NE(registry_refusal(worlds, outside).find("width=99: 99 is out of range"), std::string::npos);
    Description unmade = test::box_description();
    unmade.name = "unmade";
    unmade.make = nullptr;
    EXPECT_NE(registry_refusal(worlds, unmade), "taken");
}

TEST(WorldRegistry, HasTheProgramsWorlds)
{
    const Description* const temple = registry().find("temple");
    ASSERT_NE(temple, nullptr) << "worlds/CMakeLists.txt lists it";
    EXPECT_EQ(keys_of(temple->options), "seed, weather, hour");
    for (const Description& world : registry().all()) {
        for (const std::string& style : world.styles) {
            EXPECT_NO_THROW(static_cast<void>(estampe::Style::load(style))) << world.name << ", " << style;
        }
        EXPECT_NE(world.make(Values(world.options, {})), nullptr) << world.name;
    }
}

TEST(WorldRegistry, AWorldThatMakesAScenePromisesNothingElse)
{
    struct Bare final : World {
        [[nodiscard]] estampe::Scene scene() const override { return {}; }
    };

    Bare bare;
    bare.begin({}, {});
    bare.go_to(1.0, {});
    bare.end_at(2.0);
    EXPECT_EQ(bare.film_camera({}), nullptr);
    EXPECT_EQ(bare.visit({}), nullptr);
    estampe::Style style;
    style.set("drawing.seed=7");
    EXPECT_EQ(bare.style(style, {}).to_toml(), style.to_toml());
}

} // namespace
} // namespace worlds
