// SPDX-License-Identifier: MIT
// Lines: where they must be, their width, and where there must be none.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::contour {
namespace {

constexpr uint32_t side_px = 180;

/// Lines of constant, equal width, found on the page.
ContourStyle even_lines(float width_px)
{
    ContourStyle style;
    style.lines = Lines::page;
    style.outline.width_mm = style.border.width_mm = style.crease.width_mm = width_px;
    style.pressure = 0.0F;
    style.distance_thinning = 0.0F;
    return style;
}

class Ink {
public:
    Ink(test::Drawing& drawing, const ContourStyle& style)
        : size_(drawing.size_px), ink_(drawing.lines(style, 1.0F)), draw_(drawing.surface().draw)
    {
    }

    /// Bilinear interpolation at a position of the page in pixels.
    [[nodiscard]] double at(glm::dvec2 position_px) const
    {
        const glm::dvec2 p = glm::clamp(position_px - 0.5, glm::dvec2(0.0), glm::dvec2(size_) - 1.001);
        const glm::dvec2 f = glm::fract(p);
        const auto i = static_cast<size_t>(p.y) * size_.x + static_cast<size_t>(p.x);
        const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
        return mix(mix(ink_[i], ink_[i + 1], f.x), mix(ink_[i + size_.x], ink_[i + size_.x + 1], f.x), f.y);
    }

    [[nodiscard]] double total() const
    {
        double sum = 0.0;
        for (const float coverage : ink_) {
            sum += static_cast<double>(coverage);
        }
        return sum;
    }

    /// Sum over the pixels that have no empty pixel and no border of the page within `margin_px`.
    [[nodiscard]] double inside(int margin_px) const
    {
        double sum = 0.0;
        const auto width = static_cast<int>(size_.x);
        const auto height = static_cast<int>(size_.y);
        for (int y = margin_px; y < height - margin_px; ++y) {
            for (int x = margin_px; x < width - margin_px; ++x) {
                bool is_inner = true;
                for (int dy = -margin_px; dy <= margin_px && is_inner; ++dy) {
                    for (int dx = -margin_px; dx <= margin_px && is_inner; ++dx) {
                        is_inner = draw_[static_cast<size_t>((y + dy) * width + x + dx)] != 0;
                    }
                }
                sum += is_inner ? static_cast<double>(ink_[static_cast<size_t>(y * width + x)]) : 0.0;
            }
        }
        return sum;
    }

private:
    glm::uvec2 size_;
    std::vector<float> ink_;
    std::vector<uint32_t> draw_;
};

TEST(Contour, ASphereGetsACircle)
{
    constexpr double distance_m = 5.0;
    constexpr double fov_rad = 0.6;
    const double radius_px =
        std::tan(std::asin(1.0 / distance_m)) / std::tan(0.5 * fov_rad) * 0.5 * static_cast<double>(side_px);
    test::Drawing drawing(test::scene_of(shapes::sphere(1.0F, 256, 128)),
                          test::front_camera(distance_m, fov_rad), glm::uvec2(side_px));
    for (const float width_px : {2.0F, 4.0F, 7.0F}) {
        const Ink ink(drawing, even_lines(width_px));
        double error_sum = 0.0;
        double error_max = 0.0;
        double width_sum = 0.0;
        int missing = 0;
        for (int i = 0; i < 720; ++i) {
            const double angle = std::numbers::pi * i / 360.0;
            const glm::dvec2 way(std::cos(angle), std::sin(angle));
            double sum = 0.0;
            double moment = 0.0;
            double darkest = 0.0;
            for (double r = -10.0; r <= 10.0; r += 0.05) {
                const double coverage = ink.at(glm::dvec2(0.5 * side_px) + way * (radius_px + r));
                sum += 0.05 * coverage;
                moment += 0.05 * coverage * r;
                darkest = std::max(darkest, coverage);
            }
            missing += darkest > 0.5 ? 0 : 1;
            const double error = sum > 0.0 ? std::abs(moment / sum) : 10.0;
            error_sum += error;
            error_max = std::max(error_max, error);
            width_sum += sum;
        }
        EXPECT_EQ(missing, 0) << "of 720 angles";
        EXPECT_LT(error_sum / 720.0, 0.25) << "at width " << width_px;
        EXPECT_LT(error_max, 0.75) << "at width " << width_px;
        EXPECT_NEAR(width_sum / 720.0, static_cast<double>(width_px), 0.4);
        EXPECT_EQ(ink.inside(8), 0.0) << "a smooth form has no line inside";
    }
}

TEST(Contour, ABoxShowsItsFolds)
{
    test::Drawing drawing(test::scene_of(shapes::box({2.0F, 2.0F, 2.0F})),
                          {.eye = {4.0, 5.0, 6.0}, .target = {0.0, 1.0, 0.0}, .vertical_fov_rad = 0.5},
                          glm::uvec2(side_px));
    ContourStyle style = even_lines(2.0F);
    style.crease_deg = 34.0F;
    EXPECT_GT(Ink(drawing, style).inside(5), 200.0);
    style.crease_deg = 95.0F;
    EXPECT_EQ(Ink(drawing, style).inside(5), 0.0);
}

TEST(Contour, OneObjectBeforeAnotherIsOutlined)
{
    Scene scene = test::scene_of(shapes::quad(4.0F, 4.0F));
    test::add_object(scene, shapes::sphere(0.5F, 64, 32), glm::vec3(1.0F), {0.0, 2.0, 1.0});
    test::Drawing drawing(scene, {.eye = {0.0, 2.0, 6.0}, .target = {0.0, 2.0, 0.0}, .vertical_fov_rad = 0.6},
                          glm::uvec2(side_px));
    EXPECT_GT(Ink(drawing, even_lines(2.0F)).inside(5), 200.0);
    ContourStyle none = even_lines(2.0F);
    none.enabled = false;
    EXPECT_EQ(Ink(drawing, none).total(), 0.0);
}

TEST(Contour, AnEmptyPageStaysEmpty)
{
    test::Drawing drawing(test::scene_of(shapes::box({1.0F, 1.0F, 1.0F})),
                          {.eye = {0.0, 1.0, 3.0}, .target = {0.0, 1.0, 9.0}}, glm::uvec2(side_px));
    EXPECT_EQ(Ink(drawing, even_lines(3.0F)).total(), 0.0);
    drawing.with_ground = true;
    const auto draw = drawing.surface().draw;
    EXPECT_GT(std::ranges::count_if(draw, [](uint32_t word) { return word != 0; }), 1000)
        << "the ground is seen";
    EXPECT_EQ(Ink(drawing, even_lines(3.0F)).total(), 0.0);
}

TEST(Contour, APlaneSeenAtAGrazingAngleHasNoLinesInside)
{
    for (const double height_m : {0.1, 0.5, 2.0}) {
        test::Drawing drawing(
            test::scene_of(shapes::plane(100.0F, 100.0F, 20)),
            {.eye = {0.0, height_m, 40.0}, .target = {3.0, 0.0, 0.0}, .vertical_fov_rad = 0.8}, {320, 180});
        const Ink ink(drawing, even_lines(3.0F));
        EXPECT_EQ(ink.inside(4), 0.0) << "from a height of " << height_m << " m";
        EXPECT_GT(ink.total(), 300.0) << "the horizon is lined";
    }
}

TEST(Contour, AnOutlineInMetresKeepsItsWidthInParallelProjection)
{
    constexpr double half_height_m = 1.5;
    constexpr double pixel_m = 2.0 * half_height_m / side_px;
    Scene scene = test::scene_of(shapes::sphere(1.0F, 256, 128));
    scene.materials.front().toon = ToonShade{.outline_width_m = 0.05F};
    for (const double distance_m : {4.0, 40.0}) {
        Camera camera = test::front_camera(distance_m, 0.6);
        camera.orthographic_half_height_m = half_height_m;
        test::Drawing drawing(scene, camera, glm::uvec2(side_px));
        const double around_px = 2.0 * std::numbers::pi / pixel_m;
        EXPECT_NEAR(Ink(drawing, even_lines(4.0F)).total() / around_px, 0.05 / pixel_m, 0.4)
            << "from " << distance_m << " m";
    }
}

TEST(Contour, InParallelProjectionAStepIsAsDeepInAnyScene)
{
    // Two sheets of one object, one behind the other, and a third sheet far away that makes the scene larger.
    constexpr double half_height_m = 1.5;
    constexpr auto break_m = static_cast<float>(12.0 * 2.0 * half_height_m / side_px); // at a depth_step of 1
    const auto inside = [&](float gap_m, float aside_m) {
        Primitive sheets = shapes::quad(4.0F, 4.0F);
        for (const glm::vec2 place : {glm::vec2(0.0F, gap_m), glm::vec2(aside_m, 0.0F)}) {
            const Primitive sheet = shapes::quad(1.0F, 1.0F);
            const auto first = static_cast<uint32_t>(sheets.positions.size());
            for (size_t i = 0; i < sheet.positions.size(); ++i) {
                sheets.positions.push_back(sheet.positions[i] + glm::vec3(place.x, 0.0F, place.y));
                sheets.normals.push_back(sheet.normals[i]);
            }
            for (const uint32_t index : sheet.indices) {
                sheets.indices.push_back(first + index);
            }
        }
        Camera camera = test::front_camera(5.0, 0.6);
        camera.orthographic_half_height_m = half_height_m;
        test::Drawing drawing(test::scene_of(sheets), camera, glm::uvec2(side_px));
        return Ink(drawing, even_lines(2.0F)).inside(5);
    };
    for (const float aside_m : {10.0F, 200.0F}) {
        EXPECT_GT(inside(1.2F * break_m, aside_m), 200.0) << aside_m << " m wide";
        EXPECT_EQ(inside(0.8F * break_m, aside_m), 0.0) << aside_m << " m wide";
    }
}

} // namespace
} // namespace estampe::contour
