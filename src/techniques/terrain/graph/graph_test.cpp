// SPDX-License-Identifier: MIT
#include <numbers>

#include <estampe/error.hpp>
#include <estampe/terrain.hpp>
#include <gtest/gtest.h>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "support/folder.hpp"
#include "techniques/terrain/graph/compile.hpp"
#include "techniques/terrain/graph/program.hpp"
#include "techniques/terrain/graph/test_graphs.hpp"

namespace estampe {
namespace {

using test::all_graphs;

Terrain made_of(const std::string& height, const std::string& rest = {})
{
    return Terrain(parse_terrain("[terrain]\nheight = '" + height + "'\n" + rest, "test.toml"));
}

double height_of(const std::string& expression, double x = 0.0, double z = 0.0, double t = 0.0)
{
    return made_of(expression).sample(x, z, t).height_m;
}

std::string problem_of(const std::string& toml)
{
    try {
        const Terrain terrain(parse_terrain(toml, "bad.toml"));
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST(HeightGraph, Arithmetic)
{
    EXPECT_DOUBLE_EQ(height_of("1 + 2 * 3 - 8 / 4"), 5.0);
    EXPECT_NEAR(height_of("2 ^ 3 ^ 0.5"), std::pow(2.0, std::sqrt(3.0)), 1e-6);
    EXPECT_DOUBLE_EQ(height_of("-(2 - 5) * -1"), -3.0);
    EXPECT_DOUBLE_EQ(height_of("max(min(x, 3), z)", 7.0, 2.0), 3.0);
    EXPECT_DOUBLE_EQ(height_of("lerp(10, 20, 0.25)"), 12.5);
    EXPECT_DOUBLE_EQ(height_of("smoothstep(0, 2, x)", 1.0), 0.5);
    EXPECT_NEAR(height_of("sin(x) + cos(z)", 1.0, 2.0), std::sin(1.0) + std::cos(2.0), 1e-7);
    EXPECT_NEAR(height_of("sqrt(abs(x))", -9.0), 3.0, 1e-12);
    EXPECT_DOUBLE_EQ(height_of("curve(x, 0, 0, 1, 10, 2, 10)", 1.5), 10.0);
    EXPECT_NEAR(height_of("sin(time * pi)", 0.0, 0.0, 0.5), 1.0, 1e-8);
}

TEST(HeightGraph, CoordinatesChange)
{
    EXPECT_DOUBLE_EQ(height_of("translate(x, 3, 0)", 5.0), 2.0);
    EXPECT_DOUBLE_EQ(height_of("translate(x, 3 * time + 1, 0)", 5.0, 0.0, 2.0), -2.0);
    EXPECT_NEAR(height_of("rotate(x, 90)", 0.0, 4.0), 4.0, 1e-12);
    EXPECT_DOUBLE_EQ(height_of("scale(x, 2)", 6.0), 3.0);
    EXPECT_NEAR(height_of("polar(x, 1, 2)", 4.0, 6.0), 5.0, 1e-12);
    EXPECT_NEAR(height_of("polar(z, 0, 0, 10)", 0.0, 2.0), 10.0 * std::numbers::pi / 2.0, 1e-6);
    EXPECT_DOUBLE_EQ(height_of("warp(x, z, 0)", 1.0, 2.0), 3.0);
    // A warp affects the nodes inside it: after the rotation, (1 + 2, 0) lies on -z.
    EXPECT_NEAR(height_of("warp(rotate(z, 90), 2, 0)", 1.0), -3.0, 1e-12);
    EXPECT_NEAR(height_of("rotate(warp(x, 2, 0), 90)", 0.0, 4.0), 6.0, 1e-12);
}

/// Compares slopes and rates with differences of heights.
TEST(HeightGraph, DerivativesAreExact)
{
    for (const auto& [name, toml] : all_graphs()) {
        const Terrain terrain(parse_terrain(toml, name));
        int wrong = 0;
        for (int i = 0; i < 400; ++i) {
            const double x = 0.37 + 1.913 * i, z = 0.11 - 2.741 * i, t = 0.05 * i, e = 1e-5;
            const HeightSample here = terrain.sample(x, z, t);
            const auto slope = [&](double dx, double dz, double dt) {
                return (terrain.sample(x + dx, z + dz, t + dt).height_m -
                        terrain.sample(x - dx, z - dz, t - dt).height_m) /
                       (2.0 * e);
            };
            const glm::dvec3 exact(here.slope, here.rate_m_per_s);
            const glm::dvec3 measured(slope(e, 0, 0), slope(0, e, 0), slope(0, 0, e));
            wrong += glm::length(exact - measured) > 1e-3 * std::max(1.0, glm::length(exact)) ? 1 : 0;
        }
        // On an edge, the slopes of the two sides differ.
        EXPECT_LE(wrong, 2) << name;
    }
}

/// If periods divide the distance, the pattern 10^6 m away equals that at the origin, in the GPU's precision.
TEST(HeightGraph, IsTheSameAMillionMetresAway)
{
    const Terrain terrain(parse_terrain(test::periodic_graph, "periodic.toml"));
    const auto here = terrain::place_words(terrain.program(), {0.0, 0.0}, 0.0);
    const auto there = terrain::place_words(terrain.program(), {1e6, -1e6}, 0.0);
    for (int i = 0; i < 500; ++i) {
        const glm::vec2 local(0.25F * static_cast<float>(i), 1.5F * static_cast<float>(i));
        EXPECT_EQ(terrain::evaluate_single(terrain.program(), here, local),
                  terrain::evaluate_single(terrain.program(), there, local));
    }
}

/// After a quarter turn, sand only depends on one axis.
TEST(HeightGraph, QuarterTurnsAreExact)
{
    for (int quarter = -3; quarter <= 6; ++quarter) {
        const glm::dvec2 turn = terrain::cosine_and_sine(quarter * std::numbers::pi / 2.0);
        EXPECT_EQ(turn.x * turn.y, 0.0) << quarter;
        EXPECT_EQ(std::abs(turn.x + turn.y), 1.0) << quarter;
    }
}

TEST(HeightGraph, SinglePrecisionAgreesWithDouble)
{
    for (const auto& [name, toml] : all_graphs()) {
        const Terrain terrain(parse_terrain(toml, name));
        // A form around a point is precise only near that point.
        const glm::dvec2 origin =
            name == "polar" ? glm::dvec2(20.0, -10.0) : glm::dvec2(1234567.0, -7654321.0);
        const auto places = terrain::place_words(terrain.program(), origin, 12.5);
        for (int i = 0; i < 300; ++i) {
            const glm::vec2 local(0.21F * static_cast<float>(i), 30.0F - 0.17F * static_cast<float>(i));
            const double exact = terrain::evaluate(terrain.program(), places, local).x;
            const double single =
                static_cast<double>(terrain::evaluate_single(terrain.program(), places, local).x);
            EXPECT_NEAR(single, exact, 1e-5 * std::max(10.0, std::abs(exact))) << name;
        }
    }
}

TEST(HeightGraph, NodesAreMadeOnce)
{
    std::string nodes = "[terrain]\nheight = 'a12'\n[nodes]\na0 = 'fbm(50)'\n";
    for (int i = 1; i <= 12; ++i) {
        nodes += "a" + std::to_string(i) + " = 'a" + std::to_string(i - 1) + " + a" + std::to_string(i - 1) +
                 "'\n";
    }
    const Terrain terrain(parse_terrain(nodes, "doubled.toml"));
    EXPECT_EQ(terrain.program().instructions.size(), 13U);
    EXPECT_NEAR(terrain.sample(3.0, 4.0).height_m, 4096.0 * height_of("fbm(50)", 3.0, 4.0), 1e-9);
}

TEST(HeightGraph, SaysWhatIsWrong)
{
    const auto of = [](const std::string& height) {
        return problem_of("[terrain]\nheight = '" + height + "'\n");
    };
    EXPECT_EQ(of("fbm(400"),
              "bad.toml:2:10: node \"height\", character 8: a comma or a closing bracket is missing");
    EXPECT_EQ(of("2 $ 3"), "bad.toml:2:10: node \"height\", character 3: \"$\" was not expected here");
    EXPECT_EQ(
        problem_of("[terrain]\nheight = '1'\n[nodes]\n'a b' = '1'\n"),
        "bad.toml:4:9: \"a b\" cannot name a node; a name has letters, digits and _, and begins with no "
        "digit");
    EXPECT_EQ(of("fmb(400)"), "bad.toml:2:10: node \"height\", character 1: there is no node or function "
                              "\"fmb\"; did you mean \"fbm\"?");
    EXPECT_EQ(of("fbm(400, octave = 3)"), "bad.toml:2:10: node \"height\", character 19: fbm takes no "
                                          "\"octave\"; did you mean \"octaves\"?");
    EXPECT_EQ(of("fbm(0)"),
              "bad.toml:2:10: node \"height\", character 5: wavelength of fbm lies between 0.001 "
              "and 1000000, not at 0");
    EXPECT_EQ(of("fbm()"),
              "bad.toml:2:10: node \"height\", character 1: fbm wants wavelength, octaves, gain, "
              "seed");
    EXPECT_EQ(of("fbm(x)"), "bad.toml:2:10: node \"height\", character 5: this must be a number that stands "
                            "still and is the same everywhere");
    EXPECT_EQ(of("1 / (2 - 2)"),
              "bad.toml:2:10: node \"height\": the result is no number; look for a division by 0");
    EXPECT_EQ(of("1 / max(x, 0)"),
              "bad.toml:2:10: node \"height\" is no number at x = 0.000, z = 0.000; look "
              "for a division by what may be 0, or heights beyond 100 km");
    EXPECT_EQ(of("texture(\"nowhere.png\", 10)"), "bad.toml:2:10: node \"height\", character 1: nowhere.png: "
                                                  "cannot open: No such file or directory");
    EXPECT_EQ(problem_of("[terrain]\nheight = 'a'\n[nodes]\na = 'b + 1'\nb = '2 * a'\n"),
              "bad.toml:5:5: node \"b\", character 5: \"a\" leads back to itself; a height cannot be made of "
              "itself");
    EXPECT_EQ(problem_of("[terrain]\nheight = '1'\nheigth = 2\n"),
              "bad.toml:3:1: unknown key or section \"heigth\"; did you mean \"height\"?");
    EXPECT_EQ(problem_of("[terrain]\nheight = '1'\n[wind]\ndirection_deg = 20\n"),
              "bad.toml:4:1: this key of older files counted from +x; write towards_deg = 90 - "
              "direction_deg, which counts from +z like all bearings");
    EXPECT_EQ(problem_of("[nodes]\na = '1'\n"),
              "bad.toml: no node \"height\"; say what the height is: height = \"6 * fbm(400)\"");
    EXPECT_EQ(problem_of("[terrain]\nheight = '1'\n[nodes]\nfbm = '1'\n"),
              "bad.toml:4:7: \"fbm\" is a word of the language and cannot name a node; choose another name");
}

TEST(HeightGraph, IsSavedAsItWas)
{
    const std::string toml =
        "[terrain]\nheight = \"swell + texture('a\\\\b.png', 3)\"\n[nodes]\nswell = \"4\"\n"
        "[wind]\ntowards_deg = 60\n[mesh]\ncells = 64\n";
    const TerrainDescription once = parse_terrain(toml, "saved.toml");
    const TerrainDescription again = parse_terrain(terrain_toml(once), "saved.toml");
    ASSERT_EQ(again.nodes.size(), 2U);
    EXPECT_EQ(again.nodes[0].expression, once.nodes[0].expression);
    EXPECT_EQ(again.nodes[1].expression, once.nodes[1].expression);
    EXPECT_EQ(again.wind, once.wind);
    EXPECT_EQ(again.meshing, once.meshing);
    EXPECT_EQ(again.look, once.look);
    const std::string zero = "[terrain]\nheight = \"4\"\n[ripples]\nheight_m = -0.0\n";
    const std::string written = terrain_toml(parse_terrain(zero, "zero.toml"));
    EXPECT_EQ(terrain_toml(parse_terrain(written, "zero.toml")), written) << "a negative zero has no sign";
    const std::string odd = "[terrain]\nheight = \"4\"\n[nodes]\n' #\\' = \"5\"\n\"a\\u0007\" = \"6\"\n";
    const TerrainDescription named = parse_terrain(odd, "odd.toml");
    EXPECT_EQ(parse_terrain(terrain_toml(named), "odd.toml").nodes.at(1).name, " #\\");
    EXPECT_EQ(parse_terrain(terrain_toml(named), "odd.toml").nodes.at(2).name, "a\a");
}

TEST(HeightGraph, APictureOfSixteenBitsHasNoTerraces)
{
    const test::Folder folder;
    std::vector<uint16_t> ramp; // 4 x 4 texels of three equal channels, one step apart
    for (uint16_t i = 0; i < 48; ++i) {
        ramp.push_back(static_cast<uint16_t>(30000 + i / 3));
    }
    write_file_atomically(folder / "ramp.png", encode_png(4, 4, 3, ramp));
    const Terrain terrain(
        parse_terrain("[terrain]\nheight = '65535 * texture(\"ramp.png\", 4, filter = \"bilinear\")'\n",
                      "ramp.toml", folder.path()));
    for (int i = 0; i < 3; ++i) {
        const double x = 0.5 + i;
        EXPECT_NEAR(terrain.sample(x + 1.0, 0.5, 0.0).height_m - terrain.sample(x, 0.5, 0.0).height_m, 1.0,
                    0.01);
        EXPECT_NEAR(terrain.sample(x, 0.5, 0.0).height_m, 30000.0 + i, 20.0);
    }
}

TEST(HeightGraph, RaysMeetTheGround)
{
    const Terrain terrain = made_of("0.5 * x");
    const auto hit = terrain.hit({0.0, 10.0, 3.0}, glm::normalize(glm::dvec3(1.0, -1.0, 0.0)), 100.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->x, 20.0 / 3.0, 1e-6);
    EXPECT_NEAR(hit->y, 10.0 / 3.0, 1e-6);
    EXPECT_FALSE(terrain.hit({0.0, 10.0, 3.0}, {0.0, 1.0, 0.0}, 100.0));
    EXPECT_FALSE(terrain.hit({0.0, -1.0, 3.0}, {0.0, 1.0, 0.0}, 100.0));
}

/// A mask marks the ground that a program painted.
TEST(HeightGraph, MasksArePainted)
{
    Terrain terrain = made_of("2 * mask(\"demons\", 64, texels = 16)");
    EXPECT_DOUBLE_EQ(terrain.sample(1.0, 1.0).height_m, 0.0);
    std::vector<float> heights(256, 0.0F);
    heights[8 * 16 + 8] = 1.0F;
    terrain.paint_mask("demons", heights);
    EXPECT_NEAR(terrain.sample(2.0, 2.0).height_m, 2.0, 1e-9); // the middle of that texel
    EXPECT_NEAR(terrain.sample(14.0, 2.0).height_m, 0.0, 1e-9);
    EXPECT_THROW(terrain.paint_mask("angels", heights), Error);
    EXPECT_THROW(terrain.paint_mask("demons", {1.0F}), Error);
}

TEST(Dunes, SlipAtTheAngleOfReposeAndGoWithTheWind)
{
    const Terrain terrain = made_of("dunes(80, 7, celerity = 2, repose = 32)", "[wind]\ntowards_deg = 70\n");
    int steep = 0, beyond = 0, slipping = 0;
    double steepest = 0.0;
    for (int i = 0; i < 40000; ++i) {
        const HeightSample here = terrain.sample(3.1 * (i % 200), 3.7 * (i / 200));
        const double angle = std::atan(glm::length(here.slope)) * 180.0 / std::numbers::pi;
        steepest = std::max(steepest, angle);
        steep += angle > 20.0 ? 1 : 0;
        slipping += angle >= 30.0 && angle <= 34.0 ? 1 : 0;
        beyond += angle > 34.0 ? 1 : 0;
    }
    EXPECT_GT(steep, 2000);
    EXPECT_GT(slipping, steep * 9 / 10);
    EXPECT_LE(beyond, 400) << steepest;
    const double wind = 20.0 * std::numbers::pi / 180.0;
    for (int i = 0; i < 100; ++i) {
        const double x = 13.0 * i, z = 7.0 * i;
        EXPECT_NEAR(terrain.sample(x, z, 0.0).height_m,
                    terrain.sample(x + 20.0 * std::cos(wind), z + 20.0 * std::sin(wind), 10.0).height_m,
                    1e-9);
    }
}

TEST(HeightGraph, CoordinatesBeyondAllIntegersHaveAHeight)
{
    const Terrain ground(parse_terrain(
        "[terrain]\nheight = \"warp(dunes(814, 10, meander = 0.35), 14 * noise(260), 4e32) + noise(3)\"\n",
        "far.toml"));
    for (const double place_m : {0.0, 0.37, -1234.5, 1e6}) {
        EXPECT_FALSE(std::isnan(ground.sample(place_m, -0.7 * place_m, 3.25).height_m)) << place_m;
    }
}

} // namespace
} // namespace estampe
