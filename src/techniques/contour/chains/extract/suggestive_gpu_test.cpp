// SPDX-License-Identifier: MIT
// Suggestive contours, compared with a search through all triangles and with known results for a torus.
#include "techniques/contour/chains/mesh/bending.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "features/lines/lines.hpp"
#include "scene/pose.hpp"
#include "scene/smooth_surface.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

constexpr double ring = 1.0;
constexpr double tube = 0.45;

/// Strength at the zero of radial curvature between two vertices, computed as in the shaders.
float strength_between(const std::vector<glm::vec2>& bends, uint32_t i, uint32_t j)
{
    const glm::vec2 a = bends[std::min(i, j)];
    const glm::vec2 b = bends[std::max(i, j)];
    const float share = std::clamp(a.x / (a.x - b.x), 0.0F, 1.0F);
    return a.y + share * (b.y - a.y);
}

void expect_bends_as_searched(const Scene& scene, const Camera& camera, const std::string& name)
{
    test::Drawing drawing(scene, camera, small_page_px);
    const EdgeMesh mesh = features::edge_mesh_of(drawing.layout);
    const auto lists = drawing.chains({.suggestive = {.width_mm = 0.3F}, .intersection = {.enabled = false}});
    ASSERT_EQ(lists.view_bends.size(), drawing.layout.draw_of_vertex.size()) << name;
    const size_t triangle_words = (mesh.triangles.size() + 31) / 32;
    const size_t first_item = 32 * (lists.marks.size() - triangle_words);
    size_t wrong = 0;
    size_t found = 0;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec4& c = mesh.triangles[t];
        bool is_line = false;
        for (int k = 0; k < 3; ++k) {
            const uint32_t i = c[k];
            const uint32_t j = c[(k + 1) % 3];
            const bool is_crossed = (lists.view_bends[i].x >= 0.0F) != (lists.view_bends[j].x >= 0.0F);
            is_line = is_line || (is_crossed && strength_between(lists.view_bends, i, j) > 0.0F);
        }
        is_line = is_line && c.x != c.y && c.y != c.z && c.z != c.x;
        wrong += bit(lists.marks, first_item + t) != is_line ? 1U : 0U;
        found += is_line ? 1U : 0U;
    }
    EXPECT_EQ(wrong, 0U) << name;
    EXPECT_GT(found, 0U) << name;
}

/// A torus around y, and its curvature as seen from an eye.
class Torus {
public:
    explicit Torus(const glm::dvec3& eye) : eye_(eye) {}

    struct Place {
        glm::dvec3 point{0.0};
        glm::dvec3 normal{0.0};
        glm::dvec3 up{0.0};    ///< along the tube's circle, per angle
        glm::dvec3 along{0.0}; ///< along the big circle, per angle
        double around = 0.0;   ///< distance from the axis
        double cosine = 0.0;   ///< of the angle around the tube
    };

    [[nodiscard]] static Place place(double u, double v)
    {
        const glm::dvec3 out(std::cos(u), 0.0, std::sin(u));
        const glm::dvec3 y(0.0, 1.0, 0.0);
        const double around = ring + tube * std::cos(v);
        return {around * out + tube * std::sin(v) * y,
                std::cos(v) * out + std::sin(v) * y,
                -std::sin(v) * out + std::cos(v) * y,
                glm::dvec3(-std::sin(u), 0.0, std::cos(u)),
                around,
                std::cos(v)};
    }

    [[nodiscard]] double cosine(double u, double v) const
    {
        const Place p = place(u, v);
        return glm::dot(p.normal, glm::normalize(eye_ - p.point));
    }

    [[nodiscard]] double radial(double u, double v) const
    {
        const Place p = place(u, v);
        const glm::dvec2 w = towards_eye(p);
        return w.x * w.x / tube + w.y * w.y * p.cosine / p.around;
    }

    /// Growth of radial curvature towards the eye.
    [[nodiscard]] double growth(double u, double v) const
    {
        constexpr double step = 1e-4;
        const Place p = place(u, v);
        const glm::dvec2 w = towards_eye(p);
        const double du = step * w.y / p.around;
        const double dv = step * w.x / tube;
        return (radial(u + du, v + dv) - radial(u - du, v - dv)) / (2.0 * step);
    }

    /// The two angles of a position.
    [[nodiscard]] static glm::dvec2 angles_at(const glm::dvec3& p)
    {
        return {std::atan2(p.z, p.x), std::atan2(p.y, std::hypot(p.x, p.z) - ring)};
    }

private:
    [[nodiscard]] glm::dvec2 towards_eye(const Place& p) const
    {
        const glm::dvec3 way = glm::normalize(eye_ - p.point);
        return glm::normalize(glm::dvec2(glm::dot(way, p.up), glm::dot(way, p.along)));
    }

    glm::dvec3 eye_;
};

class SuggestiveTorus : public testing::Test {
protected:
    SuggestiveTorus()
        : scene_(test::scene_of(
              subdivided(shapes::torus(static_cast<float>(ring), static_cast<float>(tube), 160, 80), 0))),
          drawing_(scene_, {.eye = eye_, .target = {0.0, 0.0, 0.0}}, small_page_px), torus_(eye_),
          lists_(drawing_.chains(style_))
    {
    }

    [[nodiscard]] double least_growth() const
    {
        const double size = 2.0 * drawing_.layout.bounds.radius();
        return static_cast<double>(style_.suggestive_growth) / (size * size);
    }

    [[nodiscard]] std::vector<glm::dvec3> line_points() const
    {
        std::vector<glm::dvec3> points;
        for (const shared::ChainPoint& point : lists_.points) {
            if (point.source >> 28U == shared::line_suggestive) {
                points.push_back(glm::dvec3(point.anchor) + drawing_.layout.anchor);
            }
        }
        return points;
    }

    const glm::dvec3 eye_{0.6, 1.4, 4.2};
    const ContourStyle style_{
        .suggestive = {.width_mm = 0.3F}, .suggestive_growth = 2.0F, .suggestive_deg = 15.0F};
    Scene scene_;
    test::Drawing drawing_;
    Torus torus_;
    test::ChainLists lists_;
};

TEST(SuggestiveContours, AreThoseOfASearch)
{
    Scene scene = shapes_scene();
    test::add_object(scene, subdivided(shapes::torus(0.9F, 0.3F, 24, 12), 1), glm::vec3(0.5F),
                     {-0.6, 1.1, 1.4});
    expect_bends_as_searched(scene, view_from_above(), "shapes");
}

TEST(SuggestiveContours, OfModelsAreThoseOfASearch)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    for (const char* name :
         {"suzanne.gltf", "spot.obj", "stanford-bunny.obj", "CesiumMan/glTF-Binary/CesiumMan.glb"}) {
        if (folder != nullptr && std::filesystem::exists(std::filesystem::path(folder) / name)) {
            const Scene scene = load_scene(std::filesystem::path(folder) / name);
            const Camera camera = framing_camera(scene, pose_scene(scene, 0.0, no_index), 4.0 / 3.0);
            expect_bends_as_searched(scene, camera, name);
        }
    }
}

TEST_F(SuggestiveTorus, BendsToTheEyeAsItShould)
{
    const double size = 2.0 * drawing_.layout.bounds.radius();
    std::vector<double> errors;
    for (size_t v = 0; v < lists_.view_bends.size(); ++v) {
        const glm::dvec3 p =
            glm::dvec3(drawing_.layout.stroke_coordinates[v]) * drawing_.layout.stroke_unit_m +
            drawing_.layout.anchor;
        const glm::dvec2 at = Torus::angles_at(p);
        if (v < 160 * 80 && std::abs(torus_.cosine(at.x, at.y)) < 0.9) {
            errors.push_back(
                std::abs(static_cast<double>(lists_.view_bends[v].x) / size - torus_.radial(at.x, at.y)));
        }
    }
    std::ranges::sort(errors);
    ASSERT_GT(errors.size(), 5000U);
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.05); // the curvatures are 2.2, and from -1.8 to 0.7
}

TEST_F(SuggestiveTorus, HasItsLinesWhereRadialCurvatureIsZeroAndGrows)
{
    const std::vector<glm::dvec3> points = line_points();
    ASSERT_GT(points.size(), 40U);
    size_t outside = 0;
    for (const glm::dvec3& p : points) {
        const glm::dvec2 at = Torus::angles_at(p);
        const double growth = torus_.growth(at.x, at.y);
        const double off = std::abs(torus_.radial(at.x, at.y)) / std::max(growth, 1e-9);
        outside += growth > 0.0 && off < 0.02 && torus_.cosine(at.x, at.y) > -0.02 ? 0U : 1U;
    }
    EXPECT_LE(outside, points.size() / 50);
}

TEST_F(SuggestiveTorus, HasAllOfThem)
{
    const std::vector<glm::dvec3> points = line_points();
    constexpr int steps = 800;
    constexpr double step = 2.0 * std::numbers::pi / steps;
    size_t expected = 0;
    size_t missing = 0;
    for (int i = 0; i < steps * steps; ++i) {
        const int row = i / steps;
        const double u = step * (i % steps);
        const double v = step * row;
        const double cosine = torus_.cosine(u, v);
        if ((torus_.radial(u, v) < 0.0) == (torus_.radial(u, v + step) < 0.0) || cosine < 0.05 ||
            std::sqrt(1.0 - cosine * cosine) < std::sin(glm::radians(18.0)) ||
            torus_.growth(u, v) < 1.5 * least_growth()) {
            continue;
        }
        const glm::dvec3 p = Torus::place(u, v + 0.5 * step).point;
        const bool is_near = std::ranges::any_of(
            points, [&](const glm::dvec3& point) { return glm::distance(point, p) < 0.06; });
        ++expected;
        missing += is_near ? 0U : 1U;
    }
    EXPECT_GT(expected, 50U);
    EXPECT_LE(missing, expected / 50);
}

TEST(SuggestiveContours, AreNoneUnlessAskedFor)
{
    test::Drawing drawing(shapes_scene(), view_from_above(), small_page_px);
    const auto lists = drawing.chains({.intersection = {.enabled = false}});
    EXPECT_TRUE(lists.view_bends.empty());
    const auto with_lines =
        drawing.chains({.suggestive = {.width_mm = 0.3F}, .intersection = {.enabled = false}});
    const size_t words = (drawing.layout.triangles.size() + 31) / 32;
    EXPECT_EQ(lists.marks.size() + words, with_lines.marks.size());
    for (size_t i = 0; i < lists.marks.size(); ++i) {
        EXPECT_EQ(lists.marks[i], with_lines.marks[i]); // the outlines are unchanged
    }
}

} // namespace
} // namespace estampe::contour
