// SPDX-License-Identifier: MIT
#include "techniques/cloth/sheet/sheet.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/error.hpp>

#include "techniques/cloth/solids/solids.hpp"

namespace estampe::cloth {
namespace {

Sheet square(uint32_t particles)
{
    return grid_sheet(glm::uvec2(particles), {0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F});
}

TEST(ClothStructure, HangsWhereEveryPieceIsHeld)
{
    Sheet sheet = square(4);
    EXPECT_FALSE(hangs(sheet));
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    sheet.held[3] = 0.9F;
    EXPECT_FALSE(hangs(sheet)) << "gives way";
    sheet.held[3] = 1.0F;
    EXPECT_TRUE(hangs(sheet));
    const auto first = static_cast<uint32_t>(sheet.rest_m.size());
    sheet.rest_m.insert(sheet.rest_m.end(), {{5.0F, 0.0F, 0.0F}, {6.0F, 0.0F, 0.0F}, {5.0F, 1.0F, 0.0F}});
    sheet.triangles.emplace_back(first, first + 1, first + 2);
    sheet.held.resize(sheet.rest_m.size(), 0.0F);
    EXPECT_FALSE(hangs(sheet)) << "a scrap of its own";
    sheet.threads.push_back({.from = 3, .to = first});
    EXPECT_TRUE(hangs(sheet));
}

TEST(ClothStructure, GridsAreFoundOut)
{
    Sheet sheet = grid_sheet({7, 5}, {1.0F, 2.0F, 3.0F}, {0.0F, 0.0F, 3.0F}, {2.0F, 0.0F, 0.0F});
    const auto form = grid_form(sheet);
    ASSERT_TRUE(form);
    EXPECT_EQ(form->columns, 7U);
    EXPECT_EQ(form->rows, 5U);
    EXPECT_NEAR(form->spacing_m.x, 0.5F, 1e-6F);
    EXPECT_NEAR(form->spacing_m.y, 0.5F, 1e-6F);
    EXPECT_EQ(form->winding, 1.0F);
    for (glm::uvec3& triangle : sheet.triangles) {
        std::swap(triangle.y, triangle.z);
    }
    EXPECT_EQ(grid_form(sheet)->winding, -1.0F);
    Sheet bent = sheet;
    bent.rest_m[12].y += 0.01F;
    EXPECT_FALSE(grid_form(bent));
    sheet.triangles.pop_back(); // makes a hole
    EXPECT_FALSE(grid_form(sheet));
}

TEST(ClothStructure, MassIsDensityTimesArea)
{
    Sheet sheet = square(9);
    sheet.cloth.density_kg_m2 = 0.3F;
    const auto masses = build_structure(sheet).masses_kg;
    EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.0F), 0.3F, 1e-5F);
}

TEST(ClothStructure, TethersReachAlongTheSheet)
{
    Sheet sheet = square(17);
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    sheet.held.front() = 1.0F;
    sheet.held[16] = 1.0F;
    const auto check = [](const Sheet& hung) {
        const Lists<Tether> tethers = build_structure(hung).tethers;
        ASSERT_EQ(tethers.width, 2U);
        for (uint32_t k = 0; k < 2; ++k) {
            for (uint32_t i = 0; i < hung.rest_m.size(); ++i) {
                const Tether& tether = tethers.items[k * hung.rest_m.size() + i];
                const float straight_m = glm::distance(hung.rest_m[i], hung.rest_m[tether.held]);
                EXPECT_GE(tether.most_m, 1.003F * straight_m - 1e-4F);
                // Over one or two edges, a path along particles may be a detour.
                EXPECT_LE(tether.most_m, 1.003F * straight_m + (straight_m < 0.25F ? 0.06F : 1e-4F));
            }
        }
    };
    check(sheet);
    for (glm::vec3& place : sheet.rest_m) { // makes it no grid
        place.x += 0.004F * std::sin(30.0F * place.y);
    }
    check(sheet);
}

TEST(ClothStructure, WhatMayTearHangsByItsLinksAlone)
{
    Sheet sheet = square(5);
    sheet.held.assign(25, 0.0F);
    sheet.held[0] = 1.0F;
    EXPECT_TRUE(hangs(sheet));
    EXPECT_EQ(build_structure(sheet).tethers.width, 1U);
    sheet.cloth.tear = 1.2F;
    EXPECT_FALSE(hangs(sheet));
    const Structure grid = build_structure(sheet);
    EXPECT_EQ(grid.tethers.width, 0U);
    EXPECT_EQ(link_bit(grid, 6, 7), 13U);
    EXPECT_EQ(link_bit(grid, 6, 2), 8U);
    sheet.rest_m[12] += glm::vec3(0.01F, 0.0F, 0.0F); // makes it no grid
    const Structure lists = build_structure(sheet);
    EXPECT_EQ(lists.links.items[link_bit(lists, 6, 7) * 25 + 6].other, 7U);
    EXPECT_THROW(static_cast<void>(link_bit(lists, 0, 24)), std::logic_error);
}

TEST(ClothStructure, TethersGoRoundHoles)
{
    // In an L-shaped sheet, the distance between the ends of both arms is longer along the sheet than
    // straight.
    Sheet sheet = square(17);
    std::erase_if(sheet.triangles, [](const glm::uvec3& triangle) {
        return triangle.x % 17 >= 4 && triangle.x / 17 >= 4 && triangle.y / 17 >= 4 && triangle.y % 17 >= 4 &&
               triangle.z % 17 >= 4 && triangle.z / 17 >= 4;
    });
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    sheet.held[16] = 1.0F; // end of the upper arm
    const auto tethers = build_structure(sheet).tethers;
    const Tether& far = tethers.items[17 * 16]; // from the end of the lower arm
    EXPECT_GT(far.most_m, 1.45F);               // the straight distance would be 1.41
}

/// Twice the bending energy of rigidity 1.
double energy(const Sheet& sheet, const std::function<glm::dvec3(glm::dvec3)>& bent)
{
    const Structure structure = build_structure(sheet);
    const size_t count = sheet.rest_m.size();
    double sum = 0.0;
    for (size_t k = 0; k < structure.links.width; ++k) {
        for (size_t i = 0; i < count; ++i) {
            const shared::ClothLink& link = structure.links.items[k * count + i];
            if (link.rest_m != 0.0F) {
                const glm::dvec3 way = bent(sheet.rest_m[link.other]) - bent(sheet.rest_m[i]);
                sum += 0.5 * static_cast<double>(link.bending) * glm::dot(way, way); // each link occurs twice
            }
        }
    }
    return sum;
}

TEST(ClothStructure, BendingEnergyIsThatOfAPlate)
{
    Sheet sheet = square(33);
    sheet.triangles.resize(sheet.triangles.size() - 2); // without a corner it is no grid
    constexpr double curvature = 0.7;
    const double bent = energy(sheet, [](glm::dvec3 place) {
        return glm::dvec3(std::sin(curvature * place.x) / curvature, place.y,
                          (1.0 - std::cos(curvature * place.x)) / curvature);
    });
    EXPECT_NEAR(bent, curvature * curvature, 0.1 * curvature * curvature);
    const double moved = energy(sheet, [](glm::dvec3 place) {
        return glm::dvec3(glm::rotate(glm::dmat4(1.0), 1.0, glm::dvec3(1.0, 2.0, 3.0)) *
                          glm::dvec4(place, 1.0));
    });
    EXPECT_NEAR(moved, 0.0, 1e-3);
}

TEST(ClothStructure, NoTwoOfAColourAreLinked)
{
    Sheet sheet = square(11);
    const auto check_all = [](const Structure& structure, size_t count) {
        std::vector<size_t> colour_of(count, count);
        for (size_t colour = 0; colour < structure.colours.size(); ++colour) {
            for (const uint32_t i : structure.colours[colour]) {
                EXPECT_EQ(colour_of[i], count) << "twice";
                colour_of[i] = colour;
            }
        }
        EXPECT_EQ(std::ranges::count(colour_of, count), 0);
        return colour_of;
    };
    const Structure grid = build_structure(sheet);
    const auto of_grid = check_all(grid, sheet.rest_m.size());
    EXPECT_EQ(grid.colours.size(), 9U);
    for (uint32_t i = 0; i < 121; ++i) {
        for (uint32_t k = 0; k < i; ++k) {
            const glm::ivec2 way(glm::ivec2(i % 11, i / 11) - glm::ivec2(k % 11, k / 11));
            if (std::max(std::abs(way.x), std::abs(way.y)) <= 2) {
                ASSERT_NE(of_grid[i], of_grid[k]);
            }
        }
    }
    sheet.triangles.pop_back(); // makes it no grid
    const Structure lists = build_structure(sheet);
    const auto of_lists = check_all(lists, sheet.rest_m.size());
    EXPECT_LE(lists.colours.size(), 20U);
    for (size_t k = 0; k < lists.links.width; ++k) {
        for (size_t i = 0; i < sheet.rest_m.size(); ++i) {
            const shared::ClothLink& link = lists.links.items[k * sheet.rest_m.size() + i];
            if (link.rest_m != 0.0F) {
                ASSERT_NE(of_lists[i], of_lists[link.other]);
            }
        }
    }
}

TEST(ClothStructure, BadSheetsAreErrors)
{
    Sheet sheet = square(4);
    sheet.triangles.push_back({0, 1, 99});
    EXPECT_THROW(static_cast<void>(build_structure(sheet)), Error);
    sheet = square(4);
    sheet.rest_m[3].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(build_structure(sheet)), Error);
    sheet = square(4);
    sheet.cloth.density_kg_m2 = 0.0F;
    EXPECT_THROW(static_cast<void>(build_structure(sheet)), Error);
    Sheet fan;
    fan.rest_m.assign(100, glm::vec3(0.0F));
    for (uint32_t i = 1; i < 100; ++i) {
        fan.rest_m[i] = {std::cos(0.06F * static_cast<float>(i)), std::sin(0.06F * static_cast<float>(i)),
                         0.0F};
        fan.triangles.emplace_back(0, i, i % 99 + 1);
    }
    EXPECT_THROW(static_cast<void>(build_structure(fan)), Error);
    EXPECT_THROW(static_cast<void>(build_structure(Sheet{})), Error);
    sheet = square(4);
    for (const float tear : {1.0F, 0.5F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        sheet.cloth.tear = tear;
        EXPECT_THROW(static_cast<void>(build_structure(sheet)), Error) << tear;
    }
    Sheet disc{.rest_m = {glm::vec3(0.0F)}}; // 40 edges at its middle, and links to particles beyond
    for (uint32_t i = 0; i < 40; ++i) {
        const glm::vec3 way{std::cos(0.157F * static_cast<float>(i)),
                            std::sin(0.157F * static_cast<float>(i)), 0.0F};
        disc.rest_m.insert(disc.rest_m.end(), {way, 2.0F * way});
        const uint32_t a = 2 * i + 1;
        const uint32_t b = 2 * ((i + 1) % 40) + 1;
        disc.triangles.insert(disc.triangles.end(), {{0, a, b}, {a, a + 1, b}, {b, a + 1, b + 1}});
    }
    static_cast<void>(build_structure(disc));
    disc.cloth.tear = 1.2F;
    EXPECT_THROW(static_cast<void>(build_structure(disc)), Error);
}

TEST(PlacedSolids, BallsBecomeEllipsoidsUnderAnyMatrix)
{
    glm::dmat4 place = glm::rotate(glm::dmat4(1.0), 0.8, glm::dvec3(1.0, -2.0, 0.5)) *
                       glm::scale(glm::dmat4(1.0), glm::dvec3(0.5, 2.0, 1.0));
    place[1] += 0.7 * place[0]; // and sheared
    place[3] = {1.0, 2.0, 3.0, 1.0};
    const Solid solid = placed(ball({}, 0.3F), place);
    const glm::dmat3 back = glm::transpose(glm::dmat3(glm::mat3_cast(glm::dquat(solid.rotation))));
    for (int i = 0; i < 50; ++i) {
        const double n = i;
        const glm::dvec3 on_ball =
            0.3 * glm::normalize(glm::dvec3(std::sin(2.1 * n), std::cos(3.7 * n), std::sin(5.3 * n)));
        const glm::dvec3 moved(place * glm::dvec4(on_ball, 1.0));
        const glm::dvec3 own = back * (moved - glm::dvec3(solid.centre_m));
        EXPECT_NEAR(glm::length(own / glm::dvec3(solid.half_m)), 1.0, 1e-5);
    }
}

} // namespace
} // namespace estampe::cloth
