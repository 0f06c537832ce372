// SPDX-License-Identifier: MIT
// Collisions with bodies that are known by their front and back surfaces.
#include <gtest/gtest.h>

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::cloth {
namespace {

constexpr uint32_t nodes = 97; // per axis

/// A sphere of radius 1 as triangles.
struct Globe {
    std::vector<glm::vec3> positions;
    Body body{.nodes = glm::uvec2(nodes)};
};

Globe globe()
{
    constexpr uint32_t around = 96;
    constexpr uint32_t down = 48;
    Globe globe;
    for (uint32_t row = 0; row <= down; ++row) {
        for (uint32_t i = 0; i < around; ++i) {
            const float polar = std::numbers::pi_v<float> * static_cast<float>(row) / down;
            const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / around;
            globe.positions.emplace_back(std::sin(polar) * std::cos(turn), std::cos(polar),
                                         std::sin(polar) * std::sin(turn));
            if (row < down) {
                const uint32_t next = (i + 1) % around;
                const glm::uvec4 corners(row * around + i, row * around + next, (row + 1) * around + i,
                                         (row + 1) * around + next);
                globe.body.triangles.emplace_back(corners.x, corners.y, corners.z);
                globe.body.triangles.emplace_back(corners.y, corners.w, corners.z);
            }
        }
    }
    return globe;
}

/// An ellipsoid in a lab, given as a mesh.
class SeenGlobe {
public:
    SeenGlobe(Lab& lab, glm::vec3 radii_m) : lab_(lab), radii_m_(radii_m)
    {
        lab_.cloths().set_bodies(test::shared_device(), {&globe_.body, 1});
    }

    glm::vec3 spare_m{0.0F}; ///< room around the mesh for its motion

    [[nodiscard]] Solid solid(glm::vec3 centre_m, glm::quat rotation) const
    {
        return {.kind = SolidKind::seen,
                .half_m = 1.15F * radii_m_ + spare_m,
                .centre_m = centre_m,
                .rotation = rotation};
    }

    /// Sets its place at the end of the next run; the solids `others` follow it.
    void go_to(glm::vec3 centre_m, glm::quat rotation = {1.0F, 0.0F, 0.0F, 0.0F},
               glm::vec3 mesh_way_m = glm::vec3(0.0F))
    {
        std::vector<shared::PosedVertex> vertices;
        for (const glm::vec3& position : globe_.positions) {
            vertices.push_back({.position = centre_m + mesh_way_m + rotation * (radii_m_ * position)});
        }
        posed_ = gpu::upload_buffer(test::shared_device(), "posed", vertices);
        lab_.cloths().set_solids(test::shared_device(), std::array{solid(centre_m, rotation)});
        lab_.at_first = [this](gpu::Graph& graph, Cloths::Handles& handles) {
            lab_.cloths().add_bodies(graph, handles, gpu::import_whole(graph, "posed", posed_));
        };
    }

    /// The front and the back at each node, and the node's distance inside the outline.
    [[nodiscard]] std::vector<glm::vec3> seen()
    {
        gpu::Graph graph;
        Cloths::Handles handles = lab_.cloths().import(graph);
        std::exchange(lab_.at_first, nullptr)(graph, handles);
        const auto bytes = test::run_and_read(graph, std::array{handles.seen[1]});
        const auto texels = test::items_of<glm::vec4>(bytes[0]);
        std::vector<glm::vec3> ends;
        for (size_t i = shared::cloth_seen_head; i < texels.size(); ++i) {
            ends.emplace_back(texels[i].x + texels[i].y, texels[i].x - texels[i].y, texels[i].z);
        }
        return ends;
    }

private:
    Lab& lab_;
    Globe globe_ = globe();
    glm::vec3 radii_m_;
    gpu::Buffer posed_;
};

TEST(ClothBodies, AnEllipsoidHasItsFrontAndItsBack)
{
    Lab lab(lying_square(4, 1.0F));
    const glm::vec3 radii_m(0.3F, 0.4F, 0.2F);
    SeenGlobe globe(lab, radii_m);
    const glm::quat rotation = glm::angleAxis(0.7F, glm::normalize(glm::vec3(1.0F, 2.0F, 0.5F)));
    const Solid solid = globe.solid({0.4F, -0.2F, 0.9F}, rotation);
    globe.go_to(solid.centre_m, rotation);
    const std::vector<glm::vec3> ends = globe.seen();
    ASSERT_EQ(ends.size(), size_t{nodes} * nodes);
    double farthest_m = 0.0;
    double off_outline_m = 0.0;
    const double texel_m = 2.0 * 1.15 * 0.4 / (nodes - 1.0);
    for (size_t i = 0; i < ends.size(); ++i) {
        const glm::dvec2 share = 2.0 * glm::dvec2(i % nodes, i / nodes) / (nodes - 1.0) - 1.0;
        const glm::dvec2 place = share * glm::dvec2(solid.half_m) / glm::dvec2(radii_m);
        const double left = 1.0 - glm::dot(place, place);
        if (left > 0.15) {
            const double half_m = double{radii_m.z} * std::sqrt(left);
            farthest_m = std::max({farthest_m, std::abs(ends[i].x - half_m), std::abs(ends[i].y + half_m)});
        }
        if (std::abs(ends[i].z) < 0.02F) {
            const glm::dvec2 slope = -2.0 * place / glm::dvec2(radii_m);
            off_outline_m = std::max(off_outline_m, std::abs(left / glm::length(slope) - double{ends[i].z}));
        }
    }
    EXPECT_LE(farthest_m, 1e-3); // error of a circle of 96 chords
    EXPECT_LE(off_outline_m, texel_m);
}

/// A sheet that fell on a ball.
State draped(bool is_seen)
{
    constexpr float radius_m = 0.3F;
    Lab lab(lying_square(28, 0.35F, {.damping_per_s = 2.0F, .friction = 0.8F}));
    SeenGlobe globe(lab, glm::vec3(radius_m));
    if (is_seen) {
        globe.go_to({});
    } else {
        lab.cloths().set_solids(test::shared_device(), std::array{ball({}, radius_m)});
    }
    return lab.run(2.0);
}

TEST(ClothBodies, ABallThatIsSeenIsLainOnAsABall)
{
    const State beside = draped(false);
    const State state = draped(true);
    double deepest_m = 0.0;
    double apart_m = 0.0; // on the whole
    size_t touching = 0;
    for (size_t i = 0; i < state.places_m.size(); ++i) {
        const double away_m = glm::length(state.places_m[i]) - 0.3;
        deepest_m = std::max(deepest_m, -away_m);
        touching += away_m < 0.02 ? 1 : 0;
        apart_m +=
            glm::distance(state.places_m[i], beside.places_m[i]) / static_cast<double>(state.places_m.size());
    }
    EXPECT_LE(deepest_m, 1e-3);
    EXPECT_GE(touching, 300U);
    EXPECT_LE(apart_m, 0.02);
}

/// Largest depth of a hanging sheet's particles in a ball that moves forth and back.
double deepest_m(glm::vec3 way_m, bool solid_stays, uint32_t side = 20)
{
    constexpr float radius_m = 0.2F;
    Sheet sheet = hanging_square(side);
    std::fill_n(sheet.held.begin(), side, 1.0F);
    Lab lab(sheet);
    SeenGlobe globe(lab, glm::vec3(radius_m));
    globe.spare_m = solid_stays ? 0.5F * glm::abs(way_m) : glm::vec3(0.0F);
    double deepest_m = 0.0;
    for (int i = 0; i <= 30; ++i) {
        const float share = std::sin(std::numbers::pi_v<float> * static_cast<float>(i) / 30.0F);
        const glm::vec3 centre_m = glm::vec3(0.5F, -0.6F, 0.0F) + (share - 0.5F) * way_m;
        const glm::vec3 middle_m(0.5F, -0.6F, 0.0F);
        if (solid_stays) {
            globe.go_to(middle_m, {1.0F, 0.0F, 0.0F, 0.0F}, centre_m - middle_m);
        } else {
            globe.go_to(centre_m);
        }
        for (const glm::dvec3& place : lab.run(1.0 / 30.0).places_m) {
            deepest_m = std::max(deepest_m, double{radius_m} - glm::distance(place, glm::dvec3(centre_m)));
        }
    }
    return deepest_m;
}

TEST(ClothBodies, WhatMovesIsNotEntered)
{
    for (const uint32_t side : {20U, 40U}) { // a small sheet, and a large one
        for (const bool solid_stays : {false, true}) {
            EXPECT_LE(deepest_m({0.0F, 0.0F, -1.2F}, solid_stays, side), 1e-3); // at up to 1.9 m/s
            EXPECT_LE(deepest_m({0.3F, 0.0F, -0.6F}, solid_stays, side), 1e-3);
        }
    }
}

enum class Way { as_ellipsoid, with_solid, by_itself };

/// A sheet on a flat body that moves along z.
State carried(Way way)
{
    const bool solid_stays = way == Way::by_itself;
    const glm::vec3 radii_m(0.8F, 0.2F, 0.8F);
    Lab lab(grid_sheet({12, 12}, {-0.1F, 0.21F, -0.1F}, {0.0F, 0.0F, 0.2F}, {0.2F, 0.0F, 0.0F},
                       {.friction = 0.9F}));
    SeenGlobe globe(lab, radii_m);
    globe.spare_m = {0.0F, 0.0F, solid_stays ? 0.3F : 0.0F};
    State state;
    for (int i = 0; i <= 45; ++i) { // half a second at rest
        const glm::vec3 way_m(0.0F, 0.0F, 0.01F * static_cast<float>(std::max(i - 15, 0)));
        if (way == Way::as_ellipsoid) {
            lab.cloths().set_solids(
                test::shared_device(),
                std::array{Solid{.kind = SolidKind::ellipsoid, .half_m = radii_m, .centre_m = way_m}});
        } else {
            globe.go_to(solid_stays ? glm::vec3(0.0F) : way_m, {1.0F, 0.0F, 0.0F, 0.0F},
                        solid_stays ? way_m : glm::vec3(0.0F));
        }
        state = lab.run(1.0 / 30.0);
    }
    return state;
}

double middle_z_m(const State& state)
{
    double sum_m = 0.0;
    for (const glm::dvec3& place : state.places_m) {
        sum_m += place.z;
    }
    return sum_m / static_cast<double>(state.places_m.size());
}

TEST(ClothBodies, WhatMovesCarriesWhatLiesOnIt)
{
    // The sheet lies where the body is seen edge-on, and slides more than on the exact ellipsoid.
    const double most_m = middle_z_m(carried(Way::as_ellipsoid));
    const State by_itself = carried(Way::by_itself);
    EXPECT_NEAR(most_m, 0.3, 0.02);
    EXPECT_GT(middle_z_m(by_itself), 0.5 * most_m);
    EXPECT_NEAR(middle_z_m(by_itself), middle_z_m(carried(Way::with_solid)), 0.01);
    EXPECT_TRUE(carried(Way::by_itself).places_m == by_itself.places_m); // bit-identical
}

} // namespace
} // namespace estampe::cloth
