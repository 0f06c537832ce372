// SPDX-License-Identifier: MIT
// All primitive modes of glTF: tests what is visible where, and the ink that the lines draw.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>

#include "scene/gltf/test_file.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::pose {
namespace {

const std::vector<glm::dvec2> corners{{-1.0, 0.8}, {-0.5, -0.8}, {0.0, 0.8}, {0.5, -0.8}, {1.0, 0.8}};

/// The corners as a primitive of one glTF mode.
Scene in_mode(int mode)
{
    gltf::TestFile file = gltf::triangle_file();
    std::vector<float> positions;
    for (const glm::dvec2& corner : corners) {
        positions.insert(positions.end(), {static_cast<float>(corner.x), static_cast<float>(corner.y), 0.0F});
    }
    file.primitive().erase("indices");
    file.attributes() = {{"POSITION", file.add<float>(positions, "VEC3")}};
    file.primitive()["mode"] = mode;
    return file.load();
}

/// The corners that each mode joins, by the glTF specification.
struct Mode {
    int number = 0;
    std::vector<std::pair<size_t, size_t>> lines;
};

const std::vector<Mode> line_modes{{1, {{0, 1}, {2, 3}}},
                                   {2, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}},
                                   {3, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}}};

double distance_to(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b)
{
    const glm::dvec2 way = b - a;
    const double t = std::clamp(glm::dot(point - a, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::distance(point, a + t * way);
}

double distance_to(const glm::dvec2& point, const Mode& mode)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : mode.lines) {
        nearest = std::min(nearest, distance_to(point, corners[from], corners[to]));
    }
    return nearest;
}

constexpr uint32_t side_px = 160;
constexpr double half_height_m = 0.04;
constexpr double wire_m = 3e-3; // share of the scene's radius

Camera magnifier(const glm::dvec2& middle)
{
    return {.eye = {middle, 5.0}, .target = {middle, 0.0}, .orthographic_half_height_m = half_height_m};
}

glm::dvec2 place_of(size_t i, const glm::dvec2& middle)
{
    const size_t row = i / side_px;
    const glm::dvec2 px(static_cast<double>(i % side_px) + 0.5, static_cast<double>(row) + 0.5);
    const glm::dvec2 ndc = 2.0 * px / static_cast<double>(side_px) - 1.0;
    return middle + half_height_m * glm::dvec2(ndc.x, -ndc.y);
}

TEST(DrawnLines, AreSeenWhereTheyShouldBeAtTheirWidth)
{
    for (const Mode& mode : line_modes) {
        const Scene scene = in_mode(mode.number);
        for (const auto& [from, to] : mode.lines) {
            const glm::dvec2 middle = glm::mix(corners[from], corners[to], 0.4); // away from other lines
            test::Drawing drawing(scene, magnifier(middle), glm::uvec2(side_px));
            const double radius_m = wire_m * drawing.layout.bounds.radius();
            const double pixel_m = 2.0 * half_height_m / side_px;
            const auto draw = drawing.surface().draw;
            double seen = 0.0;
            for (size_t i = 0; i < draw.size(); ++i) {
                const double away_m = distance_to(place_of(i, middle), mode);
                // A wire has five sides: its half width is 0.81 to 1 of the radius.
                if (away_m < 0.8 * radius_m - pixel_m) {
                    EXPECT_NE(draw[i], 0U) << "mode " << mode.number;
                }
                if (away_m > radius_m + pixel_m) {
                    EXPECT_EQ(draw[i], 0U) << "mode " << mode.number;
                }
                seen += draw[i] != 0 ? 1.0 : 0.0;
            }
            const glm::dvec2 way = glm::abs(glm::normalize(corners[to] - corners[from]));
            const double length_m = 2.0 * half_height_m / std::max(way.x, way.y);
            const double width_m = seen * pixel_m * pixel_m / length_m;
            EXPECT_GT(width_m, 1.75 * radius_m) << "mode " << mode.number;
            EXPECT_LT(width_m, 1.95 * radius_m) << "mode " << mode.number;
        }
    }
}

TEST(DrawnLines, PointsAreDots)
{
    const Scene scene = in_mode(0);
    for (const glm::dvec2& corner : corners) {
        test::Drawing drawing(scene, magnifier(corner), glm::uvec2(side_px));
        const double radius_m = 2.0 * wire_m * drawing.layout.bounds.radius();
        const double pixel_m = 2.0 * half_height_m / side_px;
        const auto draw = drawing.surface().draw;
        for (size_t i = 0; i < draw.size(); ++i) {
            const glm::dvec2 away = glm::abs(place_of(i, corner) - corner);
            const double inside_m = radius_m - away.x - away.y; // a diamond, seen from the front
            if (std::abs(inside_m) > pixel_m) {
                EXPECT_EQ(draw[i] != 0, inside_m > 0.0) << away.x << ", " << away.y;
            }
        }
    }
}

TEST(DrawnLines, TrianglesStripsAndFansAreFilled)
{
    const std::vector<std::vector<glm::uvec3>> triangles{
        {{0, 1, 2}}, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}};
    for (size_t k = 0; k < triangles.size(); ++k) {
        Scene scene = in_mode(4 + static_cast<int>(k));
        Camera camera = magnifier({0.0, 0.0});
        camera.orthographic_half_height_m = 1.0;
        const auto draw = test::Drawing(scene, camera, glm::uvec2(side_px)).surface().draw;
        for (size_t i = 0; i < draw.size(); ++i) {
            const glm::dvec2 place = place_of(i, {0.0, 0.0}) / half_height_m;
            bool inside = false;
            double edge_m = 1.0;
            for (const glm::uvec3& triangle : triangles[k]) {
                double least = 1.0;
                for (glm::length_t c = 0; c < 3; ++c) {
                    const glm::dvec2& a = corners[triangle[c]];
                    const glm::dvec2& b = corners[triangle[(c + 1) % 3]];
                    const glm::dvec2 way = b - a;
                    edge_m = std::min(edge_m, distance_to(place, a, b));
                    least = std::min(least, way.x * (place.y - a.y) - way.y * (place.x - a.x));
                }
                // Counter-clockwise: back faces of single-sided materials are invisible.
                inside |= least > 0.0;
            }
            if (edge_m > 0.02) {
                EXPECT_EQ(draw[i] != 0, inside) << "mode " << 4 + k << " at " << place.x << ", " << place.y;
            }
        }
    }
}

TEST(DrawnLines, LeaveInkAlongTheirWholeLengthAndNowhereElse)
{
    constexpr RenderSettings settings{.width = 640, .height = 480};
    Style style;
    // A pen of 2.6 pixels fully covers at least one pixel everywhere along its line.
    for (const char* assignment :
         {"paper.color=#ffffff", "paper.grain=0", "paper.margin_mm=0", "sky.enabled=false",
          "picture.ground=false", "contour.outline.width_mm=0.8", "contour.pressure=0",
          "contour.distance_thinning=0"}) {
        style.set(assignment);
    }
    Camera camera = magnifier({0.0, 0.0});
    camera.orthographic_half_height_m = 1.0;
    for (const Mode& mode : line_modes) {
        test::shared_renderer().set_scene(in_mode(mode.number));
        const Image image = test::shared_renderer().render(camera, style, settings);
        const auto darkness = [&](const glm::ivec2& pixel) {
            return 255 - image.rgba[4 * static_cast<size_t>(pixel.y * 640 + pixel.x)];
        };
        for (int y = 0; y < 480; ++y) {
            for (int x = 0; x < 640; ++x) {
                const glm::dvec2 place((x + 0.5 - 320.0) / 240.0, (240.0 - y - 0.5) / 240.0);
                if (distance_to(place, mode) > 5.0 / 240.0) {
                    ASSERT_LE(darkness({x, y}), 1) << "mode " << mode.number << " at " << x << ", " << y;
                }
            }
        }
        for (const auto& [from, to] : mode.lines) {
            for (double t = 0.02; t < 0.98; t += 0.005) {
                const glm::dvec2 place = glm::mix(corners[from], corners[to], t);
                const glm::ivec2 px(320.0 + 240.0 * place.x, 240.0 - 240.0 * place.y);
                int darkest = 0;
                for (const glm::ivec2 by : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(-1, 0),
                                            glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                    darkest = std::max(darkest, darkness(px + by));
                }
                EXPECT_GT(darkest, 180) << "mode " << mode.number << " at " << px.x << ", " << px.y;
            }
        }
    }
}

} // namespace
} // namespace estampe::pose
