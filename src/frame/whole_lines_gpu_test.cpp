// SPDX-License-Identifier: MIT
// Lines as a hand draws them: no strokes where the shape has none, and whole strokes where it has one. The
// shapes are those on which lines of a mesh go wrong: normals that do not fit, folds of single triangles,
// scans with noise.
#include <estampe/renderer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr float page_height_mm = 210.0F;
constexpr RenderSettings page{.width = 1188, .height = 840}; // four pixels to a millimetre
constexpr float pen_mm = 0.58F;
constexpr float shortest_mm = 1.5F;

Style lines_only(const std::vector<std::string>& assignments = {})
{
    Style style;
    for (const char* assignment : {"hatch.enabled=false", "picture.ground=false", "paper.height_mm=210",
                                   "paper.margin_mm=0", "sky.enabled=false"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

std::vector<VectorStroke> strokes_of(const Scene& scene, const Camera& camera,
                                     const std::vector<std::string>& assignments = {})
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    return renderer.draw_strokes(camera, lines_only(assignments), page).strokes;
}

float length_mm(const VectorStroke& stroke)
{
    float length = 0.0F;
    for (size_t i = 1; i < stroke.points.size(); ++i) {
        length += glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm);
    }
    return length;
}

/// Gives all vertices at one place the mean normal of the triangles there, weighted by area.
void average_normals(Primitive& primitive)
{
    using Place = std::tuple<float, float, float>;
    const auto place_of = [&](uint32_t v) {
        const glm::vec3& p = primitive.positions[v];
        return Place(p.x, p.y, p.z);
    };
    std::map<Place, glm::vec3> sums;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::vec3 a = primitive.positions[primitive.indices[i]];
        const glm::vec3 normal = glm::cross(primitive.positions[primitive.indices[i + 1]] - a,
                                            primitive.positions[primitive.indices[i + 2]] - a);
        for (size_t k = 0; k < 3; ++k) {
            sums[place_of(primitive.indices[i + k])] += normal;
        }
    }
    primitive.normals.resize(primitive.positions.size());
    for (uint32_t v = 0; v < primitive.positions.size(); ++v) {
        primitive.normals[v] = glm::normalize(sums[place_of(v)]);
    }
}

/// Where a camera sees a point, in millimetres on the page.
glm::vec2 page_mm(const Camera& camera, const glm::dvec3& point)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 way = point - camera.eye;
    const double scale = 0.5 / (std::tan(0.5 * camera.vertical_fov_rad) * glm::dot(way, forward));
    const double aspect = static_cast<double>(page.width) / page.height;
    const glm::dvec2 share(0.5 * aspect + scale * glm::dot(way, right),
                           0.5 - scale * glm::dot(way, glm::cross(right, forward)));
    return glm::vec2(share) * page_height_mm;
}

float distance_to_segment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b)
{
    const glm::vec2 way = b - a;
    const float share = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0F, 1.0F);
    return glm::distance(p, a + share * way);
}

TEST(WholeLines, ABoxWithAveragedNormalsHasLinesAlongItsEdgesOnly)
{
    const Camera camera{.eye = {2.6, 2.1, 3.4}};
    Primitive box = shapes::box({1.0F, 1.0F, 1.0F});
    average_normals(box);
    std::vector<std::pair<glm::vec2, glm::vec2>> edges;
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto corner = [&](int bits) {
                return page_mm(camera, {(bits & 1) - 0.5, (bits >> 1 & 1), (bits >> 2 & 1) - 0.5});
            };
            if ((i >> axis & 1) == 0) {
                edges.emplace_back(corner(i), corner(i | 1 << axis));
            }
        }
    }
    const std::vector<VectorStroke> strokes = strokes_of(test::scene_of(box), camera);
    float whole_mm = 0.0F;
    for (const VectorStroke& stroke : strokes) {
        whole_mm += length_mm(stroke);
        for (const VectorPoint& point : stroke.points) {
            float nearest_mm = 1e6F;
            for (const auto& [from, to] : edges) {
                nearest_mm = std::min(nearest_mm, distance_to_segment(point.page_mm, from, to));
            }
            EXPECT_LT(nearest_mm, pen_mm);
        }
    }
    float seen_mm = 0.0F; // all edges but the three at the corner that is turned away
    for (const auto& [from, to] : edges) {
        const glm::vec2 hidden = page_mm(camera, {-0.5, 0.0, -0.5});
        seen_mm += from == hidden || to == hidden ? 0.0F : glm::distance(from, to);
    }
    EXPECT_NEAR(whole_mm, seen_mm, 0.03F * seen_mm);
}

/// Largest angle in degrees between the ways of a stroke over `reach_mm` before and after any of its points
/// that are at least `from_ends_mm` from its ends.
float sharpest_bend_deg(const VectorStroke& stroke, float reach_mm, float from_ends_mm)
{
    std::vector<float> along_mm{0.0F};
    for (size_t i = 1; i < stroke.points.size(); ++i) {
        along_mm.push_back(along_mm.back() +
                           glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm));
    }
    const auto place_at = [&](float mm) {
        const size_t i =
            std::clamp<size_t>(static_cast<size_t>(std::ranges::lower_bound(along_mm, mm) - along_mm.begin()),
                               1, along_mm.size() - 1);
        const float share = (mm - along_mm[i - 1]) / std::max(along_mm[i] - along_mm[i - 1], 1e-6F);
        return glm::mix(stroke.points[i - 1].page_mm, stroke.points[i].page_mm, share);
    };
    float sharpest = 0.0F;
    for (float mm = std::max(from_ends_mm, reach_mm); mm < along_mm.back() - std::max(from_ends_mm, reach_mm);
         mm += 0.1F) {
        const glm::vec2 before = place_at(mm) - place_at(mm - reach_mm);
        const glm::vec2 after = place_at(mm + reach_mm) - place_at(mm);
        const float cosine = glm::dot(before, after) / (glm::length(before) * glm::length(after));
        sharpest = std::max(sharpest, glm::degrees(std::acos(std::clamp(cosine, -1.0F, 1.0F))));
    }
    return sharpest;
}

constexpr float bend_reach_mm = 0.5F;

TEST(WholeLines, TheOutlineOfACoarseBallIsRound)
{
    constexpr uint32_t segments = 40; // facets of 5 mm that turn by 9 degrees
    const Camera camera{.eye = {0.0, 0.0, 7.0}, .target = {0.0, 0.0, 0.0}};
    const glm::vec2 middle = page_mm(camera, {0.0, 0.0, 0.0});
    const float radius_mm = page_height_mm * 0.5F / (std::tan(0.3F) * std::sqrt(48.0F));
    const std::vector<VectorStroke> strokes =
        strokes_of(test::scene_of(shapes::sphere(1.0F, segments, segments / 2)), camera);
    ASSERT_EQ(strokes.size(), 1U);
    const float facet_deg = 360.0F / segments;
    EXPECT_LT(sharpest_bend_deg(strokes[0], bend_reach_mm, 0.0F), 0.25F * facet_deg);
    for (const VectorPoint& point : strokes[0].points) {
        const float sagitta_mm = radius_mm * (1.0F - std::cos(glm::radians(0.5F * facet_deg)));
        EXPECT_NEAR(glm::distance(point.page_mm, middle), radius_mm, sagitta_mm + 0.5F * pen_mm);
    }
}

/// Returns the triangles of `primitive` with flat shading: each vertex has the normal of its triangle.
Primitive flat_shaded(const Primitive& primitive)
{
    Primitive flat;
    for (const uint32_t index : primitive.indices) {
        flat.indices.push_back(static_cast<uint32_t>(flat.positions.size()));
        flat.positions.push_back(primitive.positions[index]);
    }
    for (size_t i = 0; i < flat.positions.size(); i += 3) {
        flat.normals.insert(flat.normals.end(), 3,
                            glm::normalize(glm::cross(flat.positions[i + 1] - flat.positions[i],
                                                      flat.positions[i + 2] - flat.positions[i])));
    }
    return flat;
}

TEST(WholeLines, TheRimOfACoarseCylinderIsRoundAndAFlatSidedOneKeepsItsCorners)
{
    constexpr uint32_t segments = 24;
    const Camera camera{.eye = {0.0, 6.0, 0.01}, .target = {0.0, 0.0, 0.0}};
    const Primitive round = shapes::cylinder(1.0F, 0.5F, segments);
    const Primitive flat_sided = flat_shaded(round);
    const auto sharpest_deg = [&](const Primitive& primitive) {
        float sharpest = 0.0F;
        for (const VectorStroke& stroke : strokes_of(test::scene_of(primitive), camera)) {
            sharpest = std::max(sharpest, sharpest_bend_deg(stroke, bend_reach_mm, 2.0F));
        }
        return sharpest;
    };
    EXPECT_LT(sharpest_deg(round), 0.5F * 360.0F / segments);
    EXPECT_GT(sharpest_deg(flat_sided), 0.9F * 360.0F / segments);
}

TEST(WholeLines, AVaseThatIsNarrowAtItsFootHasALineWhereItStands)
{
    const Camera camera{.eye = {0.0, 2.0, 5.0}, .target = {0.0, 0.5, 0.0}};
    const std::array<glm::vec2, 4> profile{glm::vec2(0.0F, 0.0F), glm::vec2(0.5F, 0.0F),
                                           glm::vec2(0.9F, 0.5F), glm::vec2(0.9F, 1.2F)};
    const std::vector<VectorStroke> strokes =
        strokes_of(test::scene_of(shapes::lathe(profile, 48)), camera, {"picture.ground=true"});
    int places = 0;
    int drawn = 0;
    for (double angle = 0.6; angle < 2.55; angle += 0.05) { // the front of the foot
        const glm::vec2 place = page_mm(camera, {0.5 * std::cos(angle), 0.0, 0.5 * std::sin(angle)});
        float nearest_mm = 1e6F;
        for (const VectorStroke& stroke : strokes) {
            for (size_t i = 1; i < stroke.points.size(); ++i) {
                nearest_mm = std::min(nearest_mm, distance_to_segment(place, stroke.points[i - 1].page_mm,
                                                                      stroke.points[i].page_mm));
            }
        }
        ++places;
        drawn += nearest_mm < pen_mm ? 1 : 0;
    }
    EXPECT_EQ(drawn, places);
}

/// A quarter of a round bar between two walls at a right angle, in four strips of which two neighbouring
/// triangles never lie in one plane: every second row of vertices is shifted, and the diagonals alternate.
Primitive fillet()
{
    constexpr uint32_t columns = 24;
    constexpr uint32_t strips = 4;
    Primitive result;
    const auto add = [&](double angle_deg, double away, double along) {
        const double angle = glm::radians(angle_deg);
        result.positions.emplace_back(along, std::sin(angle) * 0.3 + away * (angle_deg > 80.0 ? 0.0 : -1.0),
                                      std::cos(angle) * 0.3 + away * (angle_deg > 80.0 ? -1.0 : 0.0));
    };
    const auto unevenness_deg = [](uint32_t row, uint32_t column) {
        return row < 2 || row > strips ? 0.0 : (row + column) % 2 == 0 ? 7.0 : -7.0;
    };
    for (uint32_t row = 0; row <= strips + 2; ++row) {
        const bool is_wall = row == 0 || row == strips + 2;
        const double angle_deg = 90.0 * (std::clamp(row, 1U, strips + 1U) - 1) / strips;
        for (uint32_t i = 0; i <= columns; ++i) {
            const double shift = row % 2 == 0 ? 0.35 : 0.0;
            add(angle_deg + unevenness_deg(row, i), is_wall ? 1.0 : 0.0, 3.0 * (i + shift) / columns - 1.5);
        }
    }
    for (uint32_t row = 0; row < strips + 2; ++row) {
        for (uint32_t i = 0; i < columns; ++i) {
            const uint32_t a = row * (columns + 1) + i;
            const uint32_t c = a + columns + 1;
            const bool turns = (i + row) % 2 == 0;
            const std::array<uint32_t, 6> corners =
                turns ? std::array{a, a + 1, c, a + 1, c + 1, c} : std::array{a, a + 1, c + 1, a, c + 1, c};
            result.indices.insert(result.indices.end(), corners.begin(), corners.end());
        }
    }
    average_normals(result);
    return result;
}

// Some edges of the fillet fold by more than 34 degrees, whether or not the shading is smooth across them.
TEST(WholeLines, AFilletWithAlternatingDiagonalsHasNoCreases)
{
    for (const Primitive& primitive : {fillet(), flat_shaded(fillet())}) {
        for (const char* angle : {"60", "34", "25"}) {
            for (const VectorStroke& stroke :
                 strokes_of(test::scene_of(primitive), {.eye = {2.0, 3.0, 4.0}},
                            {"contour.crease.angle_deg=" + std::string(angle)})) {
                EXPECT_NE(stroke.kind, StrokeKind::crease) << angle << " degrees";
                EXPECT_GT(length_mm(stroke), shortest_mm);
            }
        }
    }
}

/// A sphere of triangles of much the same size: an octahedron of which each face is divided `parts` times
/// along each side.
Primitive even_sphere(int parts)
{
    Primitive sphere;
    for (int face = 0; face < 8; ++face) {
        const glm::vec3 signs((face & 1) != 0 ? -1 : 1, (face & 2) != 0 ? -1 : 1, (face & 4) != 0 ? -1 : 1);
        const auto add = [&](int i, int k) {
            sphere.indices.push_back(static_cast<uint32_t>(sphere.positions.size()));
            sphere.positions.push_back(glm::normalize(signs * glm::vec3(i, k, parts - i - k)));
        };
        const bool turns = signs.x * signs.y * signs.z < 0.0F;
        const auto add_triangle = [&](int i, int k, int step) {
            add(i, k);
            add(turns ? i : i + step, turns ? k + step : k);
            add(turns ? i + step : i, turns ? k : k + step);
        };
        for (int i = 0; i < parts; ++i) {
            for (int k = 0; k + i < parts; ++k) {
                add_triangle(i, k, 1);
                if (i + k + 1 < parts) {
                    add_triangle(i + 1, k + 1, -1);
                }
            }
        }
    }
    return sphere;
}

/// A sphere of which each vertex is moved along the normal by up to 0.3 of an edge, as a scanner moves it.
Primitive noisy_sphere(uint32_t seed)
{
    constexpr int parts = 32;
    constexpr float edge = 1.5707963F / parts;
    Primitive sphere = even_sphere(parts);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(-0.3F, 0.3F);
    std::map<std::tuple<int, int, int>, float> moves; // equal at equal places, up to rounding
    for (glm::vec3& position : sphere.positions) {
        const glm::ivec3 place(glm::round(1e4F * position));
        const auto [move, is_new] = moves.try_emplace({place.x, place.y, place.z}, 0.0F);
        if (is_new) {
            move->second = share(random) * edge;
        }
        position = glm::vec3(place) / 1e4F * (1.0F + move->second);
    }
    average_normals(sphere);
    return sphere;
}

TEST(WholeLines, AScanWithNoiseHasAnOutlineAndNothingWithin)
{
    const Camera camera{.eye = {0.0, 0.0, 5.0}};
    const glm::vec2 middle = page_mm(camera, {0.0, 0.0, 0.0});
    const float radius_mm = page_height_mm * 0.5F / (std::tan(0.3F) * std::sqrt(24.0F));
    for (const uint32_t seed : {1U, 2U, 3U}) {
        float outline_mm = 0.0F;
        std::array<bool, 720> has_line{}; // for each half degree around the middle
        for (const VectorStroke& stroke : strokes_of(test::scene_of(noisy_sphere(seed)), camera)) {
            EXPECT_EQ(stroke.kind, StrokeKind::outline);
            outline_mm += length_mm(stroke);
            for (size_t i = 0; i < stroke.points.size(); ++i) {
                const glm::vec2 from = stroke.points[i - (i > 0 ? 1 : 0)].page_mm - middle;
                const glm::vec2 to = stroke.points[i].page_mm - middle;
                EXPECT_NEAR(glm::length(to), radius_mm, 0.05F * radius_mm);
                for (int k = 0; k < 16; ++k) {
                    const glm::vec2 place = glm::mix(from, to, static_cast<float>(k) / 16.0F);
                    const float turns = std::atan2(place.y, place.x) / 6.2831853F + 0.5F;
                    has_line.at(static_cast<size_t>(turns * 719.99F)) = true;
                }
            }
        }
        const auto directions = static_cast<double>(std::ranges::count(has_line, true));
        EXPECT_GT(directions, 0.97 * has_line.size());
        EXPECT_LT(outline_mm, 1.3F * 6.28F * radius_mm);
    }
}

/// The lines of a lying half pipe that is open at both ends, whose triangles face outwards or inwards.
std::map<StrokeKind, float> lines_of_shell(bool faces_in)
{
    constexpr uint32_t segments = 24;
    Primitive shell;
    for (uint32_t i = 0; i <= segments; ++i) {
        const float angle = 3.14159265F * static_cast<float>(i) / segments;
        for (const float x : {-1.0F, 1.0F}) {
            shell.normals.emplace_back(0.0F, std::sin(angle), std::cos(angle));
            shell.positions.push_back(glm::vec3(x, 0.0F, 0.0F) + 0.6F * shell.normals.back());
        }
    }
    for (uint32_t a = 0; a < 2 * segments; a += 2) {
        shell.indices.insert(shell.indices.end(), {a, a + 2, a + 1, a + 1, a + 2, a + 3});
    }
    if (faces_in) {
        for (size_t i = 0; i < shell.indices.size(); i += 3) {
            std::swap(shell.indices[i], shell.indices[i + 1]);
        }
        for (glm::vec3& normal : shell.normals) {
            normal = -normal;
        }
    }
    Scene scene = test::scene_of(shell);
    scene.materials.at(0).double_sided = true;
    std::map<StrokeKind, float> sums;
    for (const VectorStroke& stroke : strokes_of(scene, {.eye = {1.4, 1.1, 4.0}})) {
        sums[stroke.kind] += length_mm(stroke);
    }
    return sums;
}

TEST(WholeLines, ASurfaceWhoseFrontLooksInwardsHasTheLinesOfOneThatLooksOutwards)
{
    const std::map<StrokeKind, float> outwards = lines_of_shell(false);
    const std::map<StrokeKind, float> inwards = lines_of_shell(true);
    EXPECT_GT(outwards.at(StrokeKind::outline), 80.0F); // the ridge of the roof, two metres at four metres
    EXPECT_GT(outwards.at(StrokeKind::border), 150.0F);
    ASSERT_EQ(inwards.size(), outwards.size());
    for (const auto& [kind, sum_mm] : outwards) {
        EXPECT_NEAR(inwards.at(kind), sum_mm, 0.02F * sum_mm);
    }
}

/// The lines of a square board behind five posts.
std::vector<VectorStroke> board_behind_posts(float post_mm, float gap_mm,
                                             const std::vector<std::string>& assignments = {})
{
    const Camera camera{.eye = {0.0, 0.0, 4.0}, .orthographic_half_height_m = 0.105}; // 1 mm is 1 mm
    Scene scene = test::scene_of(shapes::quad(0.1F, 0.1F));
    for (int i = 0; i < 5; ++i) {
        const double x = 1e-3 * (static_cast<double>(post_mm) + static_cast<double>(gap_mm)) * (i - 2);
        test::add_object(scene, shapes::quad(1e-3F * post_mm, 0.19F), glm::vec3(0.5F), {x, -0.05, 0.1});
    }
    return strokes_of(scene, camera, assignments);
}

/// The number of strokes that run along the upper edge of the board.
int along_the_top(const std::vector<VectorStroke>& strokes)
{
    const glm::vec2 top(0.5F * page_height_mm * page.width / page.height, 0.5F * page_height_mm - 100.0F);
    const auto is_on_top = [&](const VectorPoint& point) {
        const glm::vec2 away = glm::abs(point.page_mm - top);
        return away.y < 0.5F && away.x < 49.0F;
    };
    return static_cast<int>(std::ranges::count_if(strokes, [&](const VectorStroke& stroke) {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
            const glm::vec2 way = stroke.points[i].page_mm - stroke.points[i - 1].page_mm;
            if (is_on_top(stroke.points[i]) && std::abs(way.y) < 0.1F * std::abs(way.x)) {
                return true;
            }
        }
        return false;
    }));
}

TEST(WholeLines, AGapNarrowerThanThePenDoesNotCutAStroke)
{
    EXPECT_EQ(along_the_top(board_behind_posts(0.4F, 8.0F)), 1);
    EXPECT_EQ(along_the_top(board_behind_posts(2.0F, 8.0F)), 6);
}

TEST(WholeLines, APartThatIsShorterThanTheShortestStrokeIsNotDrawn)
{
    EXPECT_EQ(along_the_top(board_behind_posts(4.0F, 4.0F)), 6); // two long parts, four short ones
    EXPECT_EQ(along_the_top(board_behind_posts(4.0F, 1.0F)), 2);
}

TEST(WholeLines, WhatIsLeftOutIsNoHiddenLine)
{
    // Behind posts with gaps of 1.4 mm, the upper edge of the board is hidden or left out, but for its two
    // ends.
    const auto dashes_mm = [](float gap_mm) {
        float sum_mm = 0.0F;
        for (const VectorStroke& stroke : board_behind_posts(4.0F, gap_mm, {"contour.hidden.enabled=true"})) {
            sum_mm += stroke.is_hidden ? length_mm(stroke) : 0.0F;
        }
        return sum_mm;
    };
    // Five posts hide 20 mm of both the upper edge and the lower edge of the board.
    EXPECT_NEAR(dashes_mm(8.0F), 40.0F, 8.0F);
    EXPECT_NEAR(dashes_mm(1.4F), 40.0F, 8.0F);
}

TEST(WholeLines, ASmallThingKeepsItsOnlyLine)
{
    const Camera camera{.eye = {0.0, 0.0, 4.0}, .orthographic_half_height_m = 0.105};
    const std::vector<VectorStroke> strokes =
        strokes_of(test::scene_of(shapes::sphere(2e-4F, 16, 8)), camera); // 1.3 mm around
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_TRUE(strokes[0].is_closed);
    EXPECT_GT(length_mm(strokes[0]), 1.0F); // of a triangle in the circle, which three samples make
}

/// How near the lines of the board's upper edge come to the posts before it, in millimetres.
float least_gap_mm(const std::vector<VectorStroke>& strokes, float post_mm, float between_mm)
{
    const float middle = 0.5F * page_height_mm * page.width / page.height;
    const float top = 0.5F * page_height_mm - 100.0F;
    float least = 1e6F;
    for (const VectorStroke& stroke : strokes) {
        for (const VectorPoint& point : stroke.points) {
            const float x = std::abs(point.page_mm.x - middle);
            const float pitch = post_mm + between_mm;
            const float from_post = std::abs(x - pitch * std::round(x / pitch)) - 0.5F * post_mm;
            if (std::abs(point.page_mm.y - top) < 0.05F && x < 45.0F && point.width_mm > 0.05F) {
                least = std::min(least, from_post);
            }
        }
    }
    return least;
}

TEST(WholeLines, AFarLineStopsShortOfANearerOneByTheGapOfTheStyle)
{
    EXPECT_LT(least_gap_mm(board_behind_posts(6.0F, 12.0F, {"contour.taper_mm=0"}), 6.0F, 12.0F), 0.6F);
    const float gap_mm = least_gap_mm(
        board_behind_posts(6.0F, 12.0F, {"contour.taper_mm=0", "contour.gap_mm=2"}), 6.0F, 12.0F);
    EXPECT_GT(gap_mm, 1.4F); // steps between samples are 0.75 mm
    EXPECT_LT(gap_mm, 3.0F);
}

TEST(WholeLines, LostLinesAreOpenInTheLightAndClosedInTheShade)
{
    const Camera camera{.eye = {0.0, 0.0, 7.0}, .target = {0.0, 0.0, 0.0}};
    const glm::vec2 middle = page_mm(camera, {0.0, 0.0, 0.0});
    const auto length_by_side = [&](const char* lost) {
        // Length of the outline towards the sun, which is on the left, and away from it.
        glm::vec2 sides(0.0F);
        for (const VectorStroke& stroke :
             strokes_of(test::scene_of(shapes::sphere(1.0F, 64, 32)), camera,
                        {"light.sun_azimuth_deg=-90", "light.sun_elevation_deg=10", lost})) {
            for (size_t i = 1; i < stroke.points.size(); ++i) {
                const float step = glm::distance(stroke.points[i].page_mm, stroke.points[i - 1].page_mm);
                sides[stroke.points[i].page_mm.x < middle.x ? 0 : 1] += step;
            }
        }
        return sides;
    };
    const glm::vec2 all = length_by_side("contour.lost=0");
    EXPECT_NEAR(all.x, all.y, 0.02F * all.y);
    const glm::vec2 left = length_by_side("contour.lost=0.8");
    EXPECT_LT(left.x, 0.35F * all.x);
    EXPECT_GT(left.y, 0.9F * all.y);
}

} // namespace
} // namespace estampe
