// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "techniques/form/form_test_meshes.hpp"

namespace estampe::form {
namespace {

using namespace test;

float degrees_between_lines(const glm::vec3& a, const glm::vec3& b)
{
    const float cosine = std::abs(glm::dot(glm::normalize(a), glm::normalize(b)));
    return glm::degrees(std::acos(std::min(cosine, 1.0F)));
}

/// The 99th percentile of values.
float percentile_99(std::vector<float> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0F : values[values.size() - 1 - values.size() / 100];
}

/// Largest deviation of lines of equal a from the horizontal, in metres.
float worst_wander(const TestMesh& mesh, const FormField& field, float period_m)
{
    const float sign = gradient(mesh, field, 0, 0).y < 0.0F ? -1.0F : 1.0F;
    float least = 1e9F;
    float most = -1e9F;
    for (size_t t = 0; t < field.corners.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const float offset = sign * field.corners[t][k].x * period_m - mesh.corner(t, k).y;
            least = std::min(least, offset);
            most = std::max(most, offset);
        }
    }
    return most - least;
}

void expect_whole(const TestMesh& mesh, const FormField& field)
{
    for (const int which : {0, 1, 2}) {
        const Seams seams = find_seams(mesh, field, which);
        EXPECT_GT(seams.edges, 0);
        EXPECT_EQ(seams.breaks, 0) << "coordinate " << which;
        EXPECT_LT(seams.jumps, seams.edges / 10) << "coordinate " << which;
    }
}

TEST(FormJudge, SeesABreakAJumpAndASign)
{
    const TestMesh mesh = cylinder();
    FormField field = follow(mesh, 0.5F);
    const Seams before = find_seams(mesh, field, 0, true);
    ASSERT_EQ(before.breaks, 0);
    const size_t inner = field.corners.size() / 2;
    FormField broken = field;
    broken.corners[inner][1].x += 0.01F;
    EXPECT_EQ(find_seams(mesh, broken, 0, true).breaks, 2);
    EXPECT_EQ(find_seams(mesh, broken, 1, true).breaks, 0);
    FormField jumping = field;
    for (glm::vec2& corner : jumping.corners[inner]) {
        corner.x += 3.0F;
    }
    EXPECT_EQ(find_seams(mesh, jumping, 0, true).breaks, 0);
    EXPECT_GT(find_seams(mesh, jumping, 0, true).jumps, before.jumps);
    FormField mirrored = field;
    for (glm::vec2& corner : mirrored.corners[inner]) {
        corner = -corner;
    }
    EXPECT_EQ(find_seams(mesh, mirrored, 0, true).breaks, 0);
    EXPECT_GT(find_seams(mesh, mirrored, 0, true).jumps, before.jumps);
}

TEST(Form, GoesRoundACylinder)
{
    const TestMesh mesh = cylinder();
    for (const float period_m : {0.25F, 0.5F, 1.0F}) {
        const FormField field = follow(mesh, period_m);
        ASSERT_TRUE(field.follows_form);
        EXPECT_EQ(field.faults.branch_triangles_a, 0U);
        EXPECT_EQ(field.faults.branch_triangles_b, 0U);
        EXPECT_EQ(field.faults.singular_triangles, 0U);
        std::vector<float> turns;
        std::vector<float> stretches;
        for (size_t t = 0; t < field.corners.size(); ++t) {
            const glm::vec3 up_lines = gradient(mesh, field, t, 0);
            turns.push_back(degrees_between_lines(up_lines, {0.0F, 1.0F, 0.0F}));
            stretches.push_back(std::abs(glm::length(up_lines) * period_m - 1.0F));
        }
        EXPECT_LT(percentile_99(turns), 5.0F) << period_m;
        EXPECT_LT(worst_wander(mesh, field, period_m), 0.03F) << period_m;
        EXPECT_LT(percentile_99(stretches), 0.05F) << period_m;
        expect_whole(mesh, field);
    }
}

TEST(Form, GoesRoundTheTubeOfATorusAndClosesUpInside)
{
    const TestMesh mesh = torus();
    const float period_m = 0.5F;
    const FormField field = follow(mesh, period_m);
    EXPECT_EQ(field.faults.branch_triangles_a, 0U);
    EXPECT_EQ(field.faults.branch_triangles_b, 0U);
    EXPECT_EQ(field.faults.singular_triangles, 0U);
    EXPECT_FLOAT_EQ(field.faults.index_sum, 0.0F);
    std::vector<float> turns;
    std::vector<float> around; // periods per radian about the axis
    for (size_t t = 0; t < field.corners.size(); ++t) {
        const glm::vec3 place = mesh.centroid(t);
        const glm::vec3 along = gradient(mesh, field, t, 0);
        turns.push_back(degrees_between_lines(along, glm::cross(place, {0.0F, 1.0F, 0.0F})));
        around.push_back(glm::length(along) * glm::length(glm::vec2(place.x, place.z)));
    }
    EXPECT_LT(percentile_99(turns), 5.0F);
    std::sort(around.begin(), around.end());
    const float middle = around[around.size() / 2];
    EXPECT_NEAR(middle, 2.0F / period_m, 0.1F * 2.0F / period_m);
    EXPECT_NEAR(around[around.size() / 50], middle, 0.1F * middle);
    EXPECT_NEAR(around[around.size() - around.size() / 50], middle, 0.1F * middle);
    expect_whole(mesh, field);
}

TEST(Form, IsWholeOnABallButForFaultsWhoseIndicesSumToTwo)
{
    const TestMesh mesh = ball(24, [](const glm::vec3& p) { return p; });
    const FormField field = follow(mesh, 0.25F);
    EXPECT_EQ(field.faults.crease_edges, 0U);
    EXPECT_FLOAT_EQ(field.faults.index_sum, 2.0F);
    EXPECT_LE(field.faults.singular_triangles, 8U);
    EXPECT_LE(field.faults.branch_triangles_a, 4U);
    EXPECT_LE(field.faults.branch_triangles_b, 24U);
    expect_whole(mesh, field);
    std::vector<float> turns;
    for (size_t t = 0; t < field.corners.size(); ++t) {
        const glm::vec3 place = mesh.centroid(t);
        if (std::abs(place.y) < 0.7F) {
            const glm::vec3 level = glm::cross(place, {0.0F, 1.0F, 0.0F});
            turns.push_back(90.0F - degrees_between_lines(gradient(mesh, field, t, 0), level));
        }
    }
    EXPECT_LT(percentile_99(turns), 8.0F);
}

TEST(Form, IsWholeOnARoughStone)
{
    const TestMesh mesh = ball(30, [](const glm::vec3& p) {
        const float bumps = std::sin(5.0F * p.x + 1.0F) * std::sin(4.0F * p.y) + std::sin(6.0F * p.z + p.x);
        return glm::vec3(1.5F * p.x, p.y, 0.8F * p.z) * (1.0F + 0.08F * bumps);
    });
    const FormField field = follow(mesh, 0.3F);
    expect_whole(mesh, field);
    const auto triangles = static_cast<uint32_t>(mesh.indices.size() / 3);
    const auto& faults = field.faults;
    EXPECT_FLOAT_EQ(faults.index_sum, 2.0F);
    EXPECT_LT(faults.singular_triangles + faults.branch_triangles_a + faults.branch_triangles_b,
              triangles / 100);
    // A faulty triangle breaks on one edge at most.
    const Seams all = find_seams(mesh, field, 0, true);
    EXPECT_LE(all.breaks, static_cast<int>(faults.singular_triangles + faults.branch_triangles_a));
}

// Without smoothing, the lines on a rough ball turn about many triangles.
TEST(Form, IsSlicedWhereItsLinesWouldBeATangle)
{
    const TestMesh mesh = ball(40, [](const glm::vec3& p) {
        const float bumps = std::sin(31.0F * p.x) * std::sin(37.0F * p.y) * std::sin(41.0F * p.z + 1.0F);
        return p * (1.0F + 0.02F * bumps);
    });
    FormOptions options{.period_m = 0.1F, .smoothing = 0.05F};
    const FormField tangle = follow_form(mesh.positions, mesh.indices, options);
    ASSERT_TRUE(tangle.follows_form);
    options.most_singular_share = 0.5F * static_cast<float>(tangle.faults.singular_triangles) /
                                  static_cast<float>(tangle.corners.size());
    ASSERT_GT(tangle.faults.singular_triangles, 64U);
    const FormField field = follow_form(mesh.positions, mesh.indices, options);
    EXPECT_FALSE(field.follows_form);
    for (size_t t = 0; t < field.corners.size(); ++t) {
        EXPECT_EQ(field.is_faulty[t], 0);
        const glm::vec2 slope = field.corners[t][1] - field.corners[t][0];
        const glm::vec3 way = mesh.positions[mesh.indices[3 * t + 1]] - mesh.positions[mesh.indices[3 * t]];
        EXPECT_NEAR(slope.x, glm::dot(way, glm::vec3(0.2998F, 0.8995F, -0.3198F)) / 0.1F, 1e-3F);
    }
}

TEST(Form, IsStraightAndLevelOnAWall)
{
    const TestMesh mesh = make_grid({.columns = 30, .rows = 20},
                                    [](float u, float v) { return glm::vec3(3.0F * u, 2.0F * v, 5.0F); });
    const FormField field = follow(mesh, 0.4F);
    EXPECT_EQ(field.faults.branch_triangles_a + field.faults.branch_triangles_b, 0U);
    const glm::vec3 first = gradient(mesh, field, 0, 0);
    for (size_t t = 0; t < field.corners.size(); ++t) {
        EXPECT_LT(glm::distance(gradient(mesh, field, t, 0) * 0.4F, first * 0.4F), 0.02F);
        EXPECT_LT(degrees_between_lines(gradient(mesh, field, t, 0), {0.0F, 1.0F, 0.0F}), 1.0F);
        EXPECT_LT(degrees_between_lines(gradient(mesh, field, t, 1), {1.0F, 0.0F, 0.0F}), 1.0F);
    }
    EXPECT_NEAR(glm::length(first), 2.5F, 0.02F);
}

TEST(Form, IsStraightOnALevelFloor)
{
    const TestMesh mesh = make_grid({.columns = 20, .rows = 20},
                                    [](float u, float v) { return glm::vec3(2.0F * u, 0.0F, -2.0F * v); });
    const FormField field = follow(mesh, 0.4F);
    for (size_t t = 0; t < field.corners.size(); ++t) {
        EXPECT_LT(degrees_between_lines(gradient(mesh, field, t, 0), {0.0F, 0.0F, 1.0F}), 1.0F);
    }
}

TEST(Form, KeepsToTheEdgesOfACube)
{
    const glm::mat3 turn(glm::rotate(glm::mat4(1.0F), 0.6F, glm::normalize(glm::vec3(1.0F, 2.0F, 3.0F))));
    for (const glm::mat3& pose : {glm::mat3(1.0F), turn}) {
        for (const int cells : {1, 8}) {
            TestMesh mesh = ball(cells, [](const glm::vec3& p) {
                return p / std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            });
            for (glm::vec3& p : mesh.positions) {
                p = pose * p;
            }
            const FormField field = follow(mesh, 0.5F);
            EXPECT_EQ(field.faults.crease_edges, 12U * static_cast<uint32_t>(cells));
            EXPECT_EQ(field.faults.branch_triangles_a + field.faults.branch_triangles_b, 0U);
            for (size_t t = 0; t < field.corners.size(); ++t) {
                float least = 90.0F;
                for (int axis = 0; axis < 3; ++axis) {
                    least = std::min(least, degrees_between_lines(gradient(mesh, field, t, 0), pose[axis]));
                }
                ASSERT_LT(least, 2.0F) << cells;
            }
        }
    }
}

TEST(Form, TurnsWithTheMesh)
{
    const TestMesh mesh = torus();
    const FormField field = follow(mesh, 0.5F);
    const glm::mat3 turn(glm::rotate(glm::mat4(1.0F), 1.1F, glm::normalize(glm::vec3(3.0F, 1.0F, 2.0F))));
    TestMesh turned = mesh;
    for (glm::vec3& p : turned.positions) {
        p = turn * p + glm::vec3(10.0F, -20.0F, 30.0F);
    }
    const FormField again = follow_form(turned.positions, turned.indices,
                                        {.period_m = 0.5F, .up = turn * glm::vec3(0.0F, 1.0F, 0.0F)});
    for (size_t t = 0; t < field.corners.size(); ++t) {
        for (const int which : {0, 1}) {
            const glm::vec3 was = turn * gradient(mesh, field, t, which);
            const glm::vec3 is = gradient(turned, again, t, which);
            ASSERT_LT(std::min(glm::distance(was, is), glm::distance(was, -is)), 0.02F * glm::length(was));
        }
    }
}

TEST(Form, IsTheSameEveryTime)
{
    const TestMesh mesh = ball(12, [](const glm::vec3& p) { return glm::vec3(2.0F, 1.0F, 1.0F) * p; });
    EXPECT_EQ(follow(mesh, 0.3F).corners, follow(mesh, 0.3F).corners);
}

TEST(Form, FollowsBothFacesOfADoubledSheet)
{
    TestMesh mesh = cylinder();
    const size_t count = mesh.indices.size();
    for (size_t i = 0; i < count; i += 3) {
        mesh.indices.insert(mesh.indices.end(), {mesh.indices[i], mesh.indices[i + 2], mesh.indices[i + 1]});
    }
    const FormField field = follow(mesh, 0.5F);
    EXPECT_EQ(field.faults.singular_triangles, 0U);
    std::vector<float> turns;
    for (size_t t = 0; t < field.corners.size(); ++t) {
        turns.push_back(degrees_between_lines(gradient(mesh, field, t, 0), {0.0F, 1.0F, 0.0F}));
    }
    EXPECT_LT(percentile_99(turns), 5.0F);
    TestMesh front = mesh;
    front.indices.resize(count);
    FormField of_front = field;
    of_front.corners.resize(count / 3);
    expect_whole(front, of_front);
}

} // namespace
} // namespace estampe::form
