// SPDX-License-Identifier: MIT
// When sheets rest, and what wakes them.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

constexpr Cloth quick_to_rest{.damping_per_s = 20.0F};

Sheet hung_by_its_edge(uint32_t columns, uint32_t rows, const Cloth& cloth = quick_to_rest)
{
    Sheet sheet = grid_sheet({columns, rows}, {}, {0.5F, 0.0F, 0.0F}, {0.0F, -0.5F, 0.0F}, cloth);
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    std::fill_n(sheet.held.begin(), columns, 1.0F);
    return sheet;
}

struct Kind {
    const char* name;
    Sheet sheet;
    std::optional<ClothSolver> solver;
    bool is_wide = false;
};

/// One sheet for each way of simulation, except the thesis's solver, whose sheets are never quite calm.
std::vector<Kind> kinds()
{
    Cloth keeps_apart = quick_to_rest;
    keeps_apart.self_m = 0.01F;
    return {{"small", hung_by_its_edge(6, 6), {}},
            {"lists", out_of_rank(hung_by_its_edge(6, 6), 1e-3F), {}},
            {"self", hung_by_its_edge(6, 6, keeps_apart), {}},
            {"descent", hung_by_its_edge(6, 6), ClothSolver::block_descent},
            {"wide", hung_by_its_edge(6, 6), {}, true}};
}

constexpr glm::vec3 ball_m{0.25F, -0.25F, 0.3F};
constexpr glm::vec3 far_ball_m{0.25F, -0.25F, 3.0F};

/// A sheet that rests in front of a ball, and another ball far away.
Lab rested(const Kind& kind)
{
    Lab lab(kind.sheet);
    lab.cloths().set_solver(test::shared_device(), kind.solver);
    lab.cloths().set_wide(test::shared_device(), kind.is_wide);
    lab.cloths().set_solids(test::shared_device(), std::array{ball(ball_m, 0.1F), ball(far_ball_m, 0.1F)});
    for (int tries = 0; tries < 12 && lab.run(0.25).calm_s < shared::cloth_rest_s; ++tries) {
    }
    return lab;
}

void place_balls(Lab& lab, glm::vec3 near_m, glm::vec3 far_m)
{
    lab.cloths().set_solids(test::shared_device(), std::array{ball(near_m, 0.1F), ball(far_m, 0.1F)});
}

TEST(ClothRest, ComesAndStaysBitByBit)
{
    for (const Kind& kind : kinds()) {
        Lab lab = rested(kind);
        const State before = lab.run(1.0 / 120.0);
        EXPECT_EQ(before.calm_s, shared::cloth_rest_s) << kind.name;
        place_balls(lab, ball_m, far_ball_m + glm::vec3(0.0F, 0.2F, 0.0F)); // too far away to wake it
        lab.air.air_kg_m3 = 1.2F;
        lab.air.wind.speed_m_per_s = 0.02F; // too weak to wake it
        const State after = lab.run(0.5);
        EXPECT_TRUE(after.places_m == before.places_m) << kind.name;
        EXPECT_TRUE(after.speeds_m_per_s == before.speeds_m_per_s) << kind.name;
    }
}

TEST(ClothRest, IsNotForWhatIsSlowForAMoment)
{
    // A pendulum at its turning point.
    Sheet sheet = hung_by_its_edge(5, 5, {});
    Lab lab(sheet);
    lab.run(1.0);
    lab.carry(glm::rotate(glm::mat4(1.0F), 0.005F, glm::vec3(1.0F, 0.0F, 0.0F)));
    double farthest_m = 0.0;
    double nearest_m = 1.0;
    for (int i = 0; i < 24; ++i) {
        const State state = lab.run(0.1);
        EXPECT_LT(state.calm_s, shared::cloth_rest_s);
        farthest_m = std::max(farthest_m, state.places_m.back().z);
        nearest_m = std::min(nearest_m, state.places_m.back().z);
    }
    EXPECT_GT(farthest_m - nearest_m, 0.003);
    sheet.cloth.damping_per_s = 12.0F;
    Lab never(sheet);
    never.air.rest_m_per_s = 0.0F;
    EXPECT_EQ(never.run(2.0).calm_s, 0.0F);
}

TEST(ClothRest, BeginsAtTheSameStepHoweverStepsAreCutIntoRuns)
{
    for (const Kind& kind : {kinds()[0], kinds()[1], kinds()[2]}) {
        const bool lies = kind.sheet.cloth.self_m == 0.0F; // on a ball it takes longer
        Lab at_once(kind.sheet);
        Lab in_parts(kind.sheet);
        at_once.cloths().set_solver(test::shared_device(), kind.solver);
        in_parts.cloths().set_solver(test::shared_device(), kind.solver);
        if (lies) {
            at_once.cloths().set_solids(test::shared_device(), std::array{ball(ball_m, 0.32F)});
            in_parts.cloths().set_solids(test::shared_device(), std::array{ball(ball_m, 0.32F)});
        }
        const State whole = at_once.run(lies ? 4.0 : 2.0);
        ASSERT_EQ(whole.calm_s, shared::cloth_rest_s) << kind.name;
        State last;
        for (int i = 0; i < (lies ? 48 : 24); ++i) {
            last = in_parts.run(10.0 / 120.0);
        }
        EXPECT_TRUE(last.places_m == whole.places_m) << kind.name;
        EXPECT_TRUE(last.speeds_m_per_s == whole.speeds_m_per_s) << kind.name;
        at_once.cloths().set_grids(test::shared_device(), {}); // wakes the sheet, and changes nothing else
        EXPECT_EQ(at_once.run(0.75).calm_s, shared::cloth_rest_s) << kind.name;
    }
}

struct Reason {
    const char* name;
    std::function<void(Lab&)> gives;
};

std::vector<Reason> reasons()
{
    return {
        {"wind",
         [](Lab& lab) {
             lab.air.air_kg_m3 = 1.2F;
             lab.air.wind = {.speed_m_per_s = 1.0F, .towards_deg = 0.0F};
         }},
        {"a held edge",
         [](Lab& lab) { lab.move_to([](glm::vec3 rest) { return rest + glm::vec3(0.0F, 0.0F, 2e-3F); }); }},
        {"a ball that comes",
         [](Lab& lab) { place_balls(lab, ball_m - glm::vec3(0.0F, 0.0F, 0.25F), far_ball_m); }},
        {"a ball that passes through",
         [](Lab& lab) { place_balls(lab, ball_m - glm::vec3(0.0F, 0.0F, 0.6F), far_ball_m); }},
        {"a ball less", [](Lab& lab) { lab.cloths().set_solids(test::shared_device(), {}); }},
        {"another ground", [](Lab& lab) { lab.cloths().set_grids(test::shared_device(), {}); }},
        {"being carried",
         [](Lab& lab) { lab.carry(glm::rotate(glm::mat4(1.0F), 0.02F, glm::vec3(1.0F, 0.0F, 0.0F))); }},
        {"gravity",
         [](Lab& lab) {
             lab.air.gravity_m_s2 = {0.0F, -9.81F, 1.0F};
         }},
        {"effort", [](Lab& lab) { lab.air.effort = 2.0F; }},
        {"another solver", [](Lab& lab) {
             lab.cloths().set_solver(test::shared_device(), ClothSolver::verlet);
             lab.cloths().set_solver(test::shared_device(), ClothSolver::small_steps);
         }}};
}

TEST(ClothRest, EndsAtOnceForAReason)
{
    const std::vector<Kind> all = kinds();
    for (const Kind& kind : all) {
        const bool is_first = &kind == &all.front(); // the others share what finds reasons
        for (const Reason& reason : is_first ? reasons() : std::vector{reasons()[0], reasons()[1]}) {
            Lab lab = rested(kind);
            ASSERT_EQ(lab.run(1.0 / 120.0).calm_s, shared::cloth_rest_s) << kind.name;
            reason.gives(lab);
            EXPECT_LT(lab.run(1.0 / 120.0).calm_s, shared::cloth_rest_s) << kind.name << ": " << reason.name;
        }
    }
}

} // namespace
} // namespace estampe::cloth
