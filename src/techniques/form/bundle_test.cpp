// SPDX-License-Identifier: MIT
#include "techniques/form/bundle.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace estampe::form {
namespace {

glm::dvec2 carried(const Link& link, glm::dvec2 z)
{
    const double c = std::cos(link.turn_rad);
    const double s = std::sin(link.turn_rad);
    const glm::dvec2 turned(c * z.x - s * z.y, s * z.x + c * z.y);
    return link.mirrors ? glm::dvec2(turned.x, -turned.y) : turned;
}

/// Transforms a vector backwards over a link: the transpose.
glm::dvec2 carried_back(const Link& link, glm::dvec2 z)
{
    const glm::dvec2 unmirrored = link.mirrors ? glm::dvec2(z.x, -z.y) : z;
    return carried({.turn_rad = -link.turn_rad}, unmirrored);
}

/// A square lattice whose links transform a hidden field of unit vectors from node to node, up to an error in
/// the angle.
std::vector<Link> lattice(uint32_t side, double error_rad)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(0.0, 2.0 * std::numbers::pi);
    std::uniform_real_distribution<double> error(-error_rad, error_rad);
    std::vector<double> angles(side * side);
    for (double& angle : angles) {
        angle = any(random);
    }
    std::vector<Link> links;
    const auto link = [&](uint32_t from, uint32_t to) {
        const bool mirrors = random() % 4 == 0;
        const double turn = mirrors ? -angles[to] - angles[from] : angles[to] - angles[from];
        links.push_back({from, to, 0.1 + any(random), turn + error(random), mirrors});
    };
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            if (x + 1 < side) {
                link(y * side + x, y * side + x + 1);
            }
            if (y + 1 < side) {
                link(y * side + x, y * side + x + side);
            }
        }
    }
    return links;
}

TEST(FormBundle, SolvesItsEquations)
{
    constexpr uint32_t side = 40;
    const std::vector<Link> links = lattice(side, 1.0);
    std::vector<double> pulls(side * side);
    Vectors targets(side * side);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (size_t i = 0; i < targets.size(); ++i) {
        targets[i] = {any(random), any(random)};
        pulls[i] = i % 7 == 0 ? 0.05 : 0.0;
    }
    Bundle bundle(side * side, links, std::vector<double>(side * side, 1.0));
    const Vectors z = bundle.attract(pulls, targets, 1e-5);
    Vectors residual(z.size());
    double right = 0.0;
    for (size_t i = 0; i < z.size(); ++i) {
        residual[i] = pulls[i] * (targets[i] - z[i]);
        right += glm::dot(pulls[i] * targets[i], pulls[i] * targets[i]);
    }
    for (const Link& link : links) {
        residual[link.to] -= link.weight * (z[link.to] - carried(link, z[link.from]));
        residual[link.from] -= link.weight * (z[link.from] - carried_back(link, z[link.to]));
    }
    double rest = 0.0;
    for (const glm::dvec2& r : residual) {
        rest += glm::dot(r, r);
    }
    EXPECT_LT(std::sqrt(rest / right), 1e-4);
}

TEST(FormBundle, FindsAFieldThatAllLinksAgreeOn)
{
    constexpr uint32_t side = 50;
    const std::vector<Link> links = lattice(side, 0.0);
    Bundle bundle(side * side, links, std::vector<double>(side * side, 1.0));
    for (const uint32_t seed : {1U, 2U, 3U}) {
        const Vectors z = bundle.relax(10.0, seed);
        for (const Link& link : links) {
            ASSERT_LT(glm::distance(z[link.to], carried(link, z[link.from])), 0.02);
        }
    }
}

TEST(FormBundle, LeavesNodesWithoutLinksAtUnitLength)
{
    Bundle bundle(3, {}, {1.0, 1.0, 1.0});
    for (const glm::dvec2& z : bundle.relax(1.0, 1)) {
        EXPECT_NEAR(glm::length(z), 1.0, 1e-12);
    }
}

} // namespace
} // namespace estampe::form
