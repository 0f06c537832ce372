// SPDX-License-Identifier: MIT
// Cloth sheets in air that a fluid simulates.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/resources.hpp"
#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

constexpr glm::uvec3 cells{16, 24, 8};
constexpr float cell_m = 0.25F;

using Speed = std::function<glm::vec3(glm::vec3 at)>; ///< velocity at a place in cells, along the grid's axes

/// A fluid's velocity as the fluid stores it: components on the low faces of cells.
gpu::Image stirred(const Speed& speed)
{
    gpu::Image velocity(
        test::shared_device(), "velocity",
        {.width = cells.x, .height = cells.y, .format = gpu::Format::r32f, .layers = 3 * cells.z});
    gpu::upload_layers(test::shared_device(), velocity, [&](uint32_t layer) {
        std::vector<float> numbers;
        const auto axis = static_cast<int>(layer / cells.z);
        for (uint32_t i = 0; i < cells.x * cells.y; ++i) {
            glm::vec3 at = glm::vec3(i % cells.x, i / cells.x, layer % cells.z) + 0.5F;
            at[axis] -= 0.5F;
            numbers.push_back(speed(at)[axis]);
        }
        const auto bytes = std::as_bytes(std::span(numbers));
        return gpu::LayerPixels{.levels = {{bytes.begin(), bytes.end()}}};
    });
    return velocity;
}

/// A box of air around a centre, rotated about y.
Flow box_about(glm::vec3 middle_m, float turn_rad)
{
    glm::mat4 place_from_cells = glm::translate(glm::mat4(1.0F), middle_m);
    place_from_cells = glm::rotate(place_from_cells, turn_rad, glm::vec3(0.0F, 1.0F, 0.0F));
    place_from_cells = glm::scale(place_from_cells, glm::vec3(cell_m));
    place_from_cells = glm::translate(place_from_cells, -0.5F * glm::vec3(cells));
    return {.cells = cells, .cells_from_place = glm::inverse(place_from_cells)};
}

void fill(Lab& lab, const Flow& box, const Speed& speed)
{
    gpu::Image velocity = stirred(speed);
    lab.cloths().set_flows(test::shared_device(), {&box, 1});
    gpu::Graph graph;
    lab.cloths().add_flow(graph, 0, gpu::import_uploaded(graph, "velocity", velocity));
    gpu::Executor(test::shared_device()).run(graph);
}

Sheet flag(uint32_t side)
{
    Sheet sheet = hanging_square(side);
    for (uint32_t i = 0; i < side; ++i) {
        sheet.held[size_t{i} * side] = 1.0F;
    }
    return sheet;
}

double farthest_apart_m(const State& a, const State& b)
{
    double most_m = 0.0;
    for (size_t i = 0; i < a.places_m.size(); ++i) {
        most_m = std::max(most_m, glm::distance(a.places_m[i], b.places_m[i]));
    }
    return most_m;
}

constexpr glm::vec3 box_middle_m{0.4F, -0.5F, 0.2F};

TEST(ClothFlow, EvenAirInABoxIsAsEvenWind)
{
    for (const uint32_t side : {12U, 33U}) { // a small sheet, and a large one
        const Sheet sheet = flag(side);
        const float turn_rad = 0.7F;
        Lab blown(sheet);
        blown.air.air_kg_m3 = 1.2F;
        blown.air.wind = {.speed_m_per_s = 3.0F, .towards_deg = 40.0F, .gustiness = 0.0F, .turbulence = 0.0F};
        const float angle_rad = glm::radians(50.0F);
        const glm::vec3 wind_m_per_s(3.0F * std::cos(angle_rad), 0.0F, 3.0F * std::sin(angle_rad));
        const glm::mat3 turned_back(glm::rotate(glm::mat4(1.0F), -turn_rad, glm::vec3(0.0F, 1.0F, 0.0F)));
        Lab stirred_lab(sheet);
        stirred_lab.air.air_kg_m3 = 1.2F;
        fill(stirred_lab, box_about(box_middle_m, turn_rad),
             [&](glm::vec3) { return turned_back * wind_m_per_s; });
        const double seconds = side == 12 ? 0.25 : 0.1;
        const State hung = Lab(sheet).run(seconds);
        const State wanted = blown.run(seconds);
        EXPECT_LE(farthest_apart_m(stirred_lab.run(seconds), wanted), 1e-4) << side;
        EXPECT_GT(farthest_apart_m(hung, wanted), side == 12 ? 0.03 : 5e-3) << side;
    }
}

TEST(ClothFlow, IsReadWhereTheSheetIs)
{
    // Shear: high particles move to +z, low ones to -z, and the middle does not move.
    const Sheet sheet = flag(12);
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    lab.air.gravity_m_s2 = {};
    fill(lab, box_about(box_middle_m, 0.0F), [&](glm::vec3 at) {
        return glm::vec3(0.0F, 0.0F, 3.0F * (at.y - 0.5F * static_cast<float>(cells.y)) * cell_m);
    });
    const State state = lab.run(1.0 / 120.0);
    // Of particles that as many triangles meet at, which are by turns.
    const auto speed_at = [&](size_t row) { return state.speeds_m_per_s[12 * row + 8 + (row + 1) % 2].z; };
    EXPECT_GT(speed_at(1), 0.05);
    EXPECT_NEAR(speed_at(10), -speed_at(1), 0.01 * speed_at(1));
    // A pressure goes by the square of the speed: 9 / 22 and 5 / 22 of a metre from the middle.
    EXPECT_NEAR(speed_at(1) / speed_at(3), 81.0 / 25.0, 0.15);
}

TEST(ClothFlow, EndsWithItsBox)
{
    const Sheet sheet = flag(12);
    Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    fill(lab, box_about({10.0F, 0.0F, 0.0F}, 0.0F), [](glm::vec3) { return glm::vec3(5.0F); });
    Lab calm(sheet);
    calm.air.air_kg_m3 = 1.2F;
    EXPECT_TRUE(lab.run(0.2).places_m == calm.run(0.2).places_m);
}

TEST(ClothFlow, WakesASheetThatRests)
{
    Cloth cloth;
    cloth.damping_per_s = 12.0F;
    for (const float self_m : {0.0F, 0.01F}) { // solved as a small sheet, and as a large one
        Sheet sheet = flag(9);
        sheet.held.assign(sheet.rest_m.size(), 0.0F);
        std::fill_n(sheet.held.begin(), 9, 1.0F);
        sheet.cloth = cloth;
        sheet.cloth.self_m = self_m;
        Lab lab(sheet);
        lab.air.air_kg_m3 = 1.2F;
        fill(lab, box_about(box_middle_m, 0.0F), [](glm::vec3) { return glm::vec3(0.0F, 0.0F, 0.02F); });
        ASSERT_EQ(lab.run(2.0).calm_s, shared::cloth_rest_s);
        fill(lab, box_about(box_middle_m, 0.0F), [](glm::vec3) { return glm::vec3(0.0F, 0.0F, 0.5F); });
        EXPECT_EQ(lab.run(0.1).calm_s, 0.0F);
    }
}

} // namespace
} // namespace estampe::cloth
