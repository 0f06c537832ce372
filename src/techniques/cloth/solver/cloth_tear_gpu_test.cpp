// SPDX-License-Identifier: MIT
// When and where sheets tear, and how their parts move.
#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <utility>

#include "gpu/resources.hpp"
#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

std::vector<glm::uvec2> torn_of(Lab& lab)
{
    gpu::Graph graph;
    const auto bytes = test::run_and_read(graph, std::array{lab.cloths().import(graph).torn});
    const auto words = test::items_of<glm::uvec2>(bytes[0]);
    return {words.begin(), words.end()};
}

void start_with(Lab& lab, const std::vector<glm::vec4>& speeds_m_per_s)
{
    gpu::Device& device = test::shared_device();
    gpu::Graph graph;
    const Cloths::Handles handles = lab.cloths().import(graph);
    const auto bytes = test::run_and_read(graph, std::array{handles.places, handles.torn});
    std::vector<gpu::Buffer> state;
    state.push_back(gpu::upload_buffer(device, "places", bytes[0]));
    state.push_back(gpu::upload_buffer(device, "speeds", speeds_m_per_s));
    state.push_back(gpu::upload_buffer(device, "torn", bytes[1]));
    lab.cloths().recall(std::move(state));
}

bool is_any_torn(const std::vector<glm::uvec2>& torn)
{
    return std::ranges::any_of(torn, [](const glm::uvec2& links) { return links != glm::uvec2(0); });
}

bool has_bit(const glm::uvec2& words, uint32_t bit)
{
    return (words[static_cast<int>(bit / 32)] >> (bit % 32) & 1U) != 0;
}

/// The part of the sheet that each particle belongs to by whole edges, named by its lowest particle.
std::vector<uint32_t> parts_of(Lab& lab)
{
    const Sheet& sheet = lab.sheet();
    const Structure structure = build_structure(sheet);
    const std::vector<glm::uvec2> torn = torn_of(lab);
    std::vector<uint32_t> parts(sheet.rest_m.size());
    std::iota(parts.begin(), parts.end(), 0U);
    for (size_t round = 0; round < parts.size(); ++round) {
        for (const glm::uvec3& triangle : sheet.triangles) {
            for (int k = 0; k < 3; ++k) {
                const uint32_t a = triangle[k];
                const uint32_t b = triangle[(k + 1) % 3];
                const uint32_t bit = link_bit(structure, a, b);
                const uint32_t back = link_bit(structure, b, a);
                const bool is_torn = has_bit(torn[a], bit);
                EXPECT_EQ(is_torn, has_bit(torn[b], back));
                if (!is_torn) {
                    parts[a] = parts[b] = std::min(parts[a], parts[b]);
                }
            }
        }
    }
    return parts;
}

/// A sheet that hangs by its upper edge, with a mass that stretches it by half there.
Sheet strip(bool is_grid, float tear)
{
    Sheet sheet = grid_sheet({4, 6}, {0.0F, 0.0F, 0.0F}, {0.3F, 0.0F, 0.0F}, {0.0F, -0.5F, 0.0F},
                             {.stretch_n_m = 200.0F, .damping_per_s = 0.0F, .tear = tear});
    sheet.masses_kg.assign(sheet.rest_m.size(), 3.0F / 24.0F);
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    std::fill_n(sheet.held.begin(), 4, 1.0F);
    return is_grid ? sheet : out_of_rank(sheet, 1e-3F);
}

/// Mean height, and upward speed, of the part that no longer hangs.
glm::dvec2 fall_of(const State& state, const std::vector<uint32_t>& parts)
{
    glm::dvec2 sum(0.0);
    double count = 0.0;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] >= 4) {
            sum += glm::dvec2(state.places_m[i].y, state.speeds_m_per_s[i].y);
            ++count;
        }
    }
    return sum / count;
}

TEST(ClothTear, LoadedStripTearsInTwoAndTheLowerPartFalls)
{
    for (const bool is_grid : {true, false}) {
        for (const ClothSolver solver : {ClothSolver::small_steps, ClothSolver::block_descent}) {
            Lab lab(strip(is_grid, 1.3F));
            lab.cloths().set_solver(test::shared_device(), solver);
            lab.air.effort = 0.25F; // far from the origin, rounding hides shorter small steps
            const State before = lab.run(1.0);
            const std::vector<uint32_t> parts = parts_of(lab);
            std::vector<uint32_t> kinds = parts;
            std::ranges::sort(kinds);
            kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
            ASSERT_EQ(kinds.size(), 2U) << is_grid << " " << static_cast<int>(solver);
            const glm::dvec2 from = fall_of(before, parts);
            constexpr double seconds = 0.5;
            const glm::dvec2 to = fall_of(lab.run(seconds), parts);
            const double exact_m = 0.5 * gravity_m_s2 * seconds * seconds;
            EXPECT_NEAR(from.x + from.y * seconds - to.x, exact_m, 0.02 * exact_m);
            EXPECT_NEAR(from.y - to.y, gravity_m_s2 * seconds, 0.02 * gravity_m_s2 * seconds);
        }
    }
}

TEST(ClothTear, NothingIsTornByLess)
{
    for (const bool is_grid : {true, false}) {
        Lab lab(strip(is_grid, 3.0F));
        lab.run(1.0);
        EXPECT_FALSE(is_any_torn(torn_of(lab)));
        // What falls on a ball is the same to the byte whatever it tears at, and, but for rounding of another
        // shader, as one that never tears; of more particles than go in one workgroup.
        const auto fallen = [&](float tear) {
            const Sheet lying = lying_square(34, 0.0F, {.tear = tear});
            Lab falling(is_grid ? lying : out_of_rank(lying, 1e-3F));
            falling.air.air_kg_m3 = 1.2F;
            falling.air.effort = tear > 0.0F ? 1.0F : 4.0F; // as many small steps
            falling.air.wind = {.speed_m_per_s = 3.0F, .towards_deg = 70.0F};
            falling.cloths().set_solids(test::shared_device(), std::array{ball({0.1F, -0.4F, 0.0F}, 0.2F)});
            return falling.run(0.22).places_m;
        };
        const std::vector<glm::dvec3> places_m = fallen(1.3F);
        EXPECT_TRUE(places_m == fallen(1e4F));
        const std::vector<glm::dvec3> never_m = fallen(0.0F);
        for (size_t i = 0; i < places_m.size(); ++i) {
            ASSERT_LE(glm::distance(places_m[i], never_m[i]), 5e-4);
        }
    }
}

/// A square with one corner pulled away and the opposite side held, in a steady wind.
struct Pulled {
    State state;
    std::vector<glm::uvec2> torn;
};

Pulled pull(float side, ClothSolver solver)
{
    Sheet sheet = grid_sheet({13, 13}, {0.0F, 0.0F, 0.0F}, {side * 0.6F, 0.0F, 0.0F}, {0.0F, -0.6F, 0.1F},
                             {.tear = 1.3F});
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    for (size_t i = 0; i < 13; ++i) {
        sheet.held[13 * i] = 1.0F;
    }
    sheet.held[12] = 1.0F;
    Lab lab(sheet);
    lab.cloths().set_solver(test::shared_device(), solver);
    lab.air.air_kg_m3 = 1.2F;
    lab.air.wind = {.speed_m_per_s = 3.0F,
                    .towards_deg = side > 0.0F ? 40.0F : -40.0F,
                    .gustiness = 0.0F,
                    .turbulence = 0.0F};
    for (int i = 1; i <= 20; ++i) {
        lab.move_to([&](glm::vec3 rest) {
            const float way_m = std::abs(rest.x) > 0.59F ? 0.02F * static_cast<float>(i) : 0.0F;
            return rest + glm::vec3(side * way_m, way_m, 0.0F);
        });
        lab.run(1.0 / 60.0);
    }
    return {.state = lab.run(0.2), .torn = torn_of(lab)};
}

TEST(ClothTear, MirroredSetUpsTearMirrored)
{
    const Pulled right = pull(1.0F, ClothSolver::small_steps);
    const Pulled left = pull(-1.0F, ClothSolver::small_steps);
    EXPECT_TRUE(is_any_torn(right.torn));
    for (size_t i = 0; i < right.state.places_m.size(); ++i) {
        const glm::dvec3 mirrored = right.state.places_m[i] * glm::dvec3(-1.0, 1.0, 1.0);
        ASSERT_LE(glm::distance(left.state.places_m[i], mirrored), 1e-4);
    }
}

TEST(ClothTear, AllSolversTearAndSameRunsGiveSameBytes)
{
    for (const ClothSolver solver :
         {ClothSolver::small_steps, ClothSolver::verlet, ClothSolver::block_descent}) {
        const Pulled first = pull(1.0F, solver);
        const Pulled second = pull(1.0F, solver);
        EXPECT_TRUE(is_any_torn(first.torn));
        EXPECT_EQ(first.torn, second.torn);
        EXPECT_EQ(first.state.places_m, second.state.places_m);
    }
}

/// Energy, for particles of one kilogram.
double energy_of(const State& state)
{
    return std::accumulate(
        state.speeds_m_per_s.begin(), state.speeds_m_per_s.end(), 0.0,
        [](double sum, const glm::dvec3& speed) { return sum + 0.5 * glm::dot(speed, speed); });
}

/// Links in lists that only one of their ends has marked as torn.
size_t torn_at_one_end(const Structure& structure, const std::vector<glm::uvec2>& torn)
{
    const size_t count = structure.masses_kg.size();
    std::set<std::pair<size_t, size_t>> links;
    for (uint32_t k = 0; k < structure.links.width; ++k) {
        for (size_t i = 0; i < count; ++i) {
            const shared::ClothLink& link = structure.links.items[k * count + i];
            if (link.rest_m != 0.0F && has_bit(torn[i], k)) {
                links.emplace(i, link.other);
            }
        }
    }
    return static_cast<size_t>(std::ranges::count_if(links, [&](const auto& link) {
        return !links.contains({link.second, link.first});
    }));
}

TEST(ClothTear, EnergyNeverGrowsAndACarryMendsAll)
{
    for (const auto& [is_grid, bending_n_m] :
         {std::pair(true, 1e-3F), std::pair(false, 1e-3F), std::pair(false, 0.1F)}) {
        // Half of a sheet flies off, and nothing is near it.
        Sheet sheet = lying_square(
            16, 0.0F,
            {.stretch_n_m = 200.0F, .bending_n_m = bending_n_m, .damping_per_s = 0.0F, .tear = 1.2F});
        sheet = is_grid ? sheet : out_of_rank(sheet, 1e-3F);
        const Structure structure = build_structure(sheet);
        Lab lab(sheet);
        lab.air.gravity_m_s2 = glm::vec3(0.0F);
        std::vector<glm::vec4> speeds(lab.cloths().particle_count());
        State state;
        for (size_t i = 0; i < sheet.rest_m.size(); ++i) {
            const glm::vec3& rest = sheet.rest_m[i];
            speeds[i] = {rest.x > 0.0F ? 20.0F + 4.0F * rest.z : 0.0F, rest.x, 0.0F, 0.0F};
            state.speeds_m_per_s.emplace_back(speeds[i]);
        }
        start_with(lab, speeds);
        const double first = energy_of(state); // all that there is: links are as long as at rest
        for (int i = 0; i < 60; ++i) {
            state = lab.run(1.0 / 120.0);
            ASSERT_LE(energy_of(state), first) << "in step " << i;
            ASSERT_EQ(torn_at_one_end(structure, torn_of(lab)), 0U) << "in step " << i;
        }
        EXPECT_TRUE(is_any_torn(torn_of(lab)));
        double before = energy_of(state);
        for (int i = 0; i < 20; ++i) {
            const double energy = energy_of(lab.run(0.1));
            ASSERT_LE(energy, 1.02 * before) << "after " << 0.1 * i << " s";
            before = std::min(before, energy);
        }
        lab.carry(glm::mat4(0.0F));
        EXPECT_FALSE(is_any_torn(torn_of(lab)));
    }
}

} // namespace
} // namespace estampe::cloth
