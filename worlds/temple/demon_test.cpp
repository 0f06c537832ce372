// SPDX-License-Identifier: MIT
#include "temple/demons.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace temple {
namespace {

constexpr float nobody_m = 1e4F;

/// An open square of 20 m on a floor at height 0.
Haunt open_haunt()
{
    return {.low_m = glm::vec2(-10.0F), .high_m = glm::vec2(10.0F), .pillars = {}};
}

Demon demon_in(const Haunt& haunt, uint64_t seed = 1)
{
    return {haunt, [](const glm::vec2&) { return 0.0F; }, Dice(seed, 200)};
}

void go_on(Demon& demon, float seconds, const glm::vec3& walker)
{
    for (int i = 0; i < static_cast<int>(std::lround(60.0F * seconds)); ++i) {
        demon.step(walker, {3.0F, 1.0F});
    }
}

glm::vec3 beside(const Demon& demon, float away_m)
{
    return demon.head() + glm::vec3(away_m, -0.4F, 0.0F);
}

/// Depth of a place inside a wall of the plan, without doorways; 0 outside of all walls.
float within_walls_m(const Plan& plan, const glm::vec3& place)
{
    float deepest = 0.0F;
    for (const WallRun& wall : plan.walls) {
        const glm::vec2 half(0.5F * wall.thickness_m);
        const glm::vec2 low = glm::min(wall.from_m, wall.to_m) - half;
        const glm::vec2 high = glm::max(wall.from_m, wall.to_m) + half;
        const glm::vec2 at(place.x, place.z);
        const glm::vec2 in = glm::min(at - low, high - at);
        if (wall.door) {
            const Door& door = plan.doors[*wall.door];
            const float along =
                wall.is_along_x ? std::abs(at.x - door.place_m.x) : std::abs(at.y - door.place_m.y);
            if (along < door.half_m) {
                continue;
            }
        }
        deepest = std::max(deepest, std::min(in.x, in.y));
    }
    return deepest;
}

TEST(Demons, AreHeldInCellsAndSomeAreFree)
{
    for (uint64_t seed = 1; seed <= 100; ++seed) {
        const Plan plan = make_plan(seed);
        const std::vector<Haunt> haunts = find_haunts(plan, make_site(1));
        const auto cells = std::ranges::count_if(haunts, &Haunt::is_cell);
        const auto free =
            std::ranges::count_if(haunts, [](const Haunt& haunt) { return !haunt.is_on_floor; });
        EXPECT_GE(cells, 2) << seed;
        EXPECT_EQ(free, 5);
        for (const Haunt& haunt : haunts) {
            EXPECT_TRUE(glm::all(glm::lessThan(haunt.low_m + 1.0F, haunt.high_m))) << seed;
        }
    }
}

TEST(Demons, StayWhereTheyAreHeldWhoeverComes)
{
    for (const uint64_t seed : {1U, 2U, 3U}) {
        const Plan plan = make_plan(seed);
        Demons demons(plan, make_site(seed), make_desert(plan, seed), seed);
        Dice dice(seed, 5);
        glm::dvec3 walker(0.0);
        for (int i = 0; i < 360; ++i) {
            if (i % 10 == 0) { // sometimes a visitor stands right beside one of them
                const auto which = static_cast<size_t>(dice.below(static_cast<int>(demons.all().size())));
                const glm::vec3 off(dice.between(-2.6F, 2.6F), -0.4F, dice.between(-2.6F, 2.6F));
                walker = glm::dvec3(demons.all()[which].head() + off);
            }
            demons.step(0.25, walker, {-9.0F, 3.0F});
            for (const Demon& demon : demons.all()) {
                const Haunt& haunt = demon.haunt();
                const glm::vec2 place = demon.place_m();
                ASSERT_TRUE(glm::all(glm::greaterThanEqual(place, haunt.low_m)));
                ASSERT_TRUE(glm::all(glm::lessThanEqual(place, haunt.high_m)));
                for (const glm::vec3& pillar : haunt.pillars) {
                    ASSERT_GT(glm::distance(place, glm::vec2(pillar)), pillar.z - 0.05F) << seed;
                }
                for (int strand = 0; haunt.is_on_floor && strand < strand_count; ++strand) {
                    for (const glm::vec3& joint : demon.joints(strand)) {
                        ASSERT_EQ(within_walls_m(plan, joint), 0.0F) << seed;
                    }
                }
            }
        }
    }
}

TEST(Demons, WanderWhileNobodyIsNear)
{
    Demon demon = demon_in(open_haunt());
    glm::vec2 low = demon.place_m();
    glm::vec2 high = low;
    for (int second = 0; second < 60; ++second) {
        go_on(demon, 1.0F, glm::vec3(nobody_m));
        EXPECT_EQ(demon.mood(), Mood::wander);
        EXPECT_LT(glm::length(demon.velocity_m_per_s()), 0.8F);
        low = glm::min(low, demon.place_m());
        high = glm::max(high, demon.place_m());
    }
    EXPECT_GT(glm::length(high - low), 5.0F);
}

TEST(Demons, WatchWhoComes)
{
    Demon demon = demon_in(open_haunt());
    go_on(demon, 5.0F, glm::vec3(nobody_m));
    const glm::vec3 walker = demon.head() + glm::vec3(-7.0F, -0.4F, 7.0F);
    go_on(demon, 4.0F, walker);
    EXPECT_EQ(demon.mood(), Mood::watch);
    EXPECT_LT(glm::length(demon.velocity_m_per_s()), 0.1F);
    const glm::vec3 to_walker = walker - demon.head();
    EXPECT_NEAR(std::remainder(demon.yaw_rad() - std::atan2(to_walker.x, to_walker.z), 6.2831853F), 0.0F,
                0.05F);
}

TEST(Demons, ShyFromWhoIsTooNearAndComeToRestWhenItGoes)
{
    for (const uint64_t seed : {1U, 2U, 3U, 4U}) {
        Demon demon = demon_in(open_haunt(), seed);
        go_on(demon, 2.0F, glm::vec3(nobody_m));
        const glm::vec3 walker = beside(demon, 2.6F);
        demon.step(walker, {});
        EXPECT_EQ(demon.mood(), Mood::shy);
        go_on(demon, 4.0F, walker);
        EXPECT_GT(glm::distance(demon.head(), walker), Demon::shies_m * 0.95F) << seed;
        EXPECT_NE(demon.mood(), Mood::dissolve);
        go_on(demon, 1.0F, glm::vec3(nobody_m));
        EXPECT_EQ(demon.mood(), Mood::wander);
    }
}

TEST(Demons, DissolveWhenTheyCannotGetAwayAndLoseAllTheirInk)
{
    Haunt corner = open_haunt();
    corner.high_m = corner.low_m + 1.0F;
    Demon demon = demon_in(corner);
    const glm::vec3 walker = glm::vec3(-9.5F, 1.7F, -9.5F);
    go_on(demon, Demon::despairs_s - 0.5F, walker);
    EXPECT_EQ(demon.mood(), Mood::shy);
    EXPECT_EQ(demon.spilled(), 0.0F);
    go_on(demon, 1.0F, walker);
    EXPECT_EQ(demon.mood(), Mood::dissolve);
    float before = demon.spilled();
    float widest_m = 0.0F;
    const float resting_m = 0.6F * demon.haunt().size;
    for (int i = 0; i < 60 * static_cast<int>(Demon::dissolves_s + 1.0F); ++i) {
        demon.step(walker, {});
        EXPECT_GE(demon.spilled(), before);
        EXPECT_LT(demon.spilled() - before, 0.02F) << "it runs out, and does not vanish";
        EXPECT_FLOAT_EQ(demon.spilled() + demon.body(), 1.0F);
        before = demon.spilled();
        widest_m = std::max(widest_m, demon.stain_m());
    }
    EXPECT_EQ(demon.mood(), Mood::gone);
    EXPECT_EQ(demon.spilled(), 1.0F);
    EXPECT_EQ(demon.stain_m(), 0.0F);
    EXPECT_GT(widest_m, 9.0F * resting_m) << "its ink rushes over the page";
    demon.dissolve();
    EXPECT_EQ(demon.mood(), Mood::gone);
}

TEST(Demons, DriftSmoothlyAndHangTogether)
{
    Demon demon = demon_in(open_haunt(), 7);
    const auto joints_of = [&] {
        std::vector<glm::vec3> all;
        for (int strand = 0; strand < strand_count; ++strand) {
            all.insert(all.end(), demon.joints(strand).begin(), demon.joints(strand).end());
        }
        return all;
    };
    std::vector<glm::vec3> before = joints_of();
    for (int i = 0; i < 900; ++i) {
        // A visitor comes and goes repeatedly.
        const glm::vec3 walker = (i / 200) % 2 == 0 ? beside(demon, 4.0F) : glm::vec3(nobody_m);
        demon.step(walker, {-8.0F, 4.0F});
        const std::vector<glm::vec3> now = joints_of();
        for (size_t k = 0; k < now.size(); ++k) {
            ASSERT_LT(glm::distance(now[k], before[k]), 0.2F) << k;
        }
        for (int strand = 0; strand < strand_count; ++strand) {
            const std::vector<glm::vec3>& joints = demon.joints(strand);
            for (size_t k = 1; k < joints.size(); ++k) {
                const float length_m = strands()[static_cast<size_t>(strand)].length_m;
                ASSERT_LT(glm::distance(joints[k], joints[k - 1]), 1.21F * length_m);
            }
        }
        before = now;
    }
}

TEST(Demons, AreTheSameHoweverTimeIsCut)
{
    const Plan plan = make_plan(1);
    const Site site = make_site(1);
    const estampe::Terrain desert = make_desert(plan, 1);
    Demons at_once(plan, site, desert, 1);
    Demons in_parts(plan, site, desert, 1);
    const glm::dvec3 walker(2.0, 2.0, 12.0);
    at_once.step(6.0, walker, {});
    for (int i = 0; i < 144; ++i) {
        in_parts.step(1.0 / 24.0, walker, {});
    }
    for (size_t i = 0; i < at_once.all().size(); ++i) {
        EXPECT_EQ(at_once.all()[i].place_m(), in_parts.all()[i].place_m());
        EXPECT_EQ(at_once.all()[i].joints(3).back(), in_parts.all()[i].joints(3).back());
    }
    Demons other(plan, site, desert, 2);
    other.step(6.0, walker, {});
    EXPECT_NE(at_once.all()[0].place_m(), other.all()[0].place_m());
}

TEST(Demons, PressTheSandWhereTheyAre)
{
    const Plan plan = make_plan(1);
    const Desert desert(plan, 1);
    const estampe::Terrain still = desert.with({});
    Demons demons(plan, make_site(1), still, 1);
    demons.step(3.0, glm::dvec3(1e4), {});
    const std::vector<Hollow> hollows = demons.hollows();
    ASSERT_EQ(hollows.size(), most_hollows);
    const estampe::Terrain pressed = desert.with(hollows);
    for (const Hollow& hollow : hollows) {
        const auto sunk_m = [&](float away_m) {
            const glm::dvec2 at = glm::dvec2(hollow.place_m) + glm::dvec2(away_m, 0.0);
            return still.sample(at.x, at.y).height_m - pressed.sample(at.x, at.y).height_m;
        };
        EXPECT_NEAR(sunk_m(0.0F), static_cast<double>(hollow.depth_m), 0.01);
        EXPECT_LT(sunk_m(1.35F * hollow.radius_m), -0.2 * static_cast<double>(hollow.depth_m)) << "a rim";
        EXPECT_NEAR(sunk_m(3.0F * hollow.radius_m), 0.0, 0.002);
    }
}

TEST(Demons, AreNodesOfASceneThatStandWhereTheyAre)
{
    const Plan plan = make_plan(1);
    Demons demons(plan, make_site(1), make_desert(plan, 1), 1);
    estampe::Scene scene;
    scene.materials.emplace_back();
    scene.nodes.push_back({.name = "other"});
    scene.roots.push_back(0);
    demons.add_to(scene);
    demons.step(2.0, glm::dvec3(0.0, 2.0, 0.0), {});
    const std::vector<estampe::NodePlace> places = demons.places(1);
    EXPECT_EQ(places.size(), scene.nodes.size() - 1);
    for (const estampe::NodePlace& place : places) {
        scene.nodes[place.node].transform = place.transform;
    }
    const estampe::ScenePose pose = estampe::pose_scene(scene, 0.0);
    size_t bodies = 0;
    for (const estampe::Node& node : scene.nodes) {
        if (node.skin == estampe::no_index) {
            continue;
        }
        const Demon& demon = demons.all()[bodies++];
        const estampe::Skin& skin = scene.skins[node.skin];
        size_t joint = 0;
        for (int strand = 0; strand < strand_count; ++strand) {
            for (const glm::vec3& wanted : demon.joints(strand)) {
                const glm::dvec3 found(pose.world_from_node[skin.joints[joint++]][3]);
                EXPECT_LT(glm::distance(found, glm::dvec3(wanted)), 1e-3);
            }
        }
    }
    EXPECT_EQ(bodies, demons.all().size());
}

} // namespace
} // namespace temple
