// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <gtest/gtest.h>

namespace estampe::app {
namespace {

/// The bounds row of `info` for a triangle between two corners of a box.
std::string bounds_between(const glm::vec3& low, const glm::vec3& high, const glm::dvec3& place = {})
{
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back(
        {.primitives = {{.positions = {low, high, {low.x, high.y, low.z}}, .indices = {0, 1, 2}}}});
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].transform.translation = place;
    scene.roots = {0};
    const std::string text = report_scene(scene, "scene", false);
    const size_t row = text.find("bounds");
    const size_t words = text.find('(', row);
    return text.substr(words, text.find('\n', row) - words);
}

TEST(Report, BoundsHaveFourDigits)
{
    EXPECT_EQ(bounds_between({0, 0, 0}, {1, 2, 3}), "(0, 0, 0) to (1, 2, 3) m");
    EXPECT_EQ(bounds_between({-1.23456F, 0, 0}, {1.0F / 3.0F, 2, 0}), "(-1.235, 0, 0) to (0.3333, 2, 0) m");
    EXPECT_EQ(bounds_between({5, 5, 5}, {5, 5, 5}), "(5, 5, 5) to (5, 5, 5) m");
}

TEST(Report, FarBoundsHaveTheStepOfTheBox)
{
    EXPECT_EQ(bounds_between({0, 0, 0}, {1.25F, 0.5F, 2}, {6378137.5, -456789.25, 0.125}),
              "(6378137.5, -456789.25, 0.125) to (6378138.75, -456788.75, 2.125) m");
    EXPECT_EQ(bounds_between({0, 0, 0}, {0.0125F, 0.005F, 0.02F}, {100, 0, 0}),
              "(100, 0, 0) to (100.0125, 0.005, 0.02) m");
    EXPECT_EQ(bounds_between({0, 0, 0}, {250, 20, 3}, {500000.0625, 0, 0}),
              "(500000.1, 0, 0) to (500250.1, 20, 3) m")
        << "a tenth of a metre is the fourth digit of the length";
    EXPECT_EQ(bounds_between({0, 0, 0}, {0.5F, 0, 0}, {0.1 + 1e15, 0, 0}).substr(0, 21),
              "(1000000000000000.1, ")
        << "no more digits than a double has";
}

TEST(Report, ProtectionsThatAKernelLacksAreNamed)
{
    EXPECT_EQ(report_protections(""), "");
    const std::string line = report_protections("seccomp");
    EXPECT_NE(line.find("decoded without seccomp"), std::string::npos);
    EXPECT_EQ(line.find('\n'), line.size() - 1);
}

} // namespace
} // namespace estampe::app
