// SPDX-License-Identifier: MIT
// Smear strokes behind moving objects, in whole pictures.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings smear_page{.width = 320, .height = 240, .time_s = 0.5};
constexpr double smear_s = 0.1;
const Camera smear_camera{.eye = {0.0, 0.0, 4.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.7};

Style paper(std::initializer_list<const char*> more)
{
    Style style;
    for (const char* assignment :
         {"paper.grain=0", "paper.granulation=0", "paper.ink_break=0", "paper.margin_mm=0",
          "paper.color=#ffffff", "hatch.enabled=false", "contour.enabled=false", "picture.ground=false",
          "sky.enabled=false", "wash.strength=1", "wash.neutral=1", "light.shadows=false",
          "motion_blur.shutter_deg=360", "motion_blur.frames_per_s=10", "motion_blur.largest_mm=60",
          "motion_blur.smear.width_mm=1.6", "motion_blur.smear.ink=#000000"}) {
        style.set(assignment);
    }
    for (const char* assignment : more) {
        style.set(assignment);
    }
    return style;
}

/// A box without a background, which passes its middle position in the middle of the second.
Scene going(const glm::vec3& way_m)
{
    Scene scene;
    const Index box = test::add_object(scene, shapes::box({0.8F, 1.2F, 0.4F}), {0.5F, 0.5F, 0.5F});
    const glm::vec3 foot(0.0F, -0.6F, 0.0F);
    const glm::vec3 from = foot - 0.5F * way_m;
    const glm::vec3 to = foot + 0.5F * way_m;
    scene.animations.push_back({.name = "go", .channels = {}, .duration_s = 1.0F});
    scene.animations.front().channels.push_back({.node = box,
                                                 .path = AnimatedPath::translation,
                                                 .times_s = {0.0F, 1.0F},
                                                 .values = {from.x, from.y, from.z, to.x, to.y, to.z}});
    return scene;
}

double px_per_m(double away_m)
{
    return 0.5 * smear_page.height / std::tan(0.5 * smear_camera.vertical_fov_rad) / away_m;
}

/// Ink that strokes add to a picture, 0 to 1 per pixel.
struct SmearInk {
    std::vector<double> of_pixel;
    double sum = 0.0;

    [[nodiscard]] double at(uint32_t x, uint32_t y) const
    {
        return of_pixel[size_t{y} * smear_page.width + x];
    }
};

SmearInk smear_ink(const Image& plain, const Image& smeared)
{
    SmearInk ink;
    for (size_t i = 0; i < plain.rgba.size(); i += 4) {
        const double added = (int{plain.rgba[i]} - int{smeared.rgba[i]}) / 255.0;
        ink.of_pixel.push_back(added);
        ink.sum += added;
    }
    return ink;
}

SmearInk ink_of_going(const glm::vec3& way_m, std::initializer_list<const char*> more)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(going(way_m));
    const Image plain = renderer.render(smear_camera, paper({}), smear_page);
    Style style = paper(more);
    style.set("motion_blur.smear.enabled=true");
    return smear_ink(plain, renderer.render(smear_camera, style, smear_page));
}

bool is_inked(double added)
{
    return added > 0.3;
}

/// Smallest x that ink reaches.
int leftmost(const SmearInk& ink)
{
    for (uint32_t x = 0; x < smear_page.width; ++x) {
        for (uint32_t y = 0; y < smear_page.height; ++y) {
            if (is_inked(ink.at(x, y))) {
                return static_cast<int>(x);
            }
        }
    }
    return smear_page.width;
}

TEST(SmearMotion, LeavesEveryBitWhereNothingMoves)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = going({3.0F, 0.0F, 0.0F});
    Style smear;
    smear.set("motion_blur.smear.enabled=true");
    renderer.set_scene(scene);
    const Image moving = renderer.render(smear_camera, {}, smear_page);
    EXPECT_EQ(renderer.graph_dot().find("smear"), std::string::npos) << "costs nothing when off";
    EXPECT_NE(renderer.render(smear_camera, smear, smear_page).rgba, moving.rgba);
    scene.animations.clear();
    renderer.set_scene(scene);
    const Image still = renderer.render(smear_camera, {}, smear_page);
    EXPECT_EQ(renderer.render(smear_camera, smear, smear_page).rgba, still.rgba);
    EXPECT_NE(renderer.graph_dot().find("smear"), std::string::npos);
    // Motion below the style's limit has no strokes.
    renderer.set_scene(going({3.0F, 0.0F, 0.0F}));
    smear.set("motion_blur.smear.from_mm=60");
    EXPECT_EQ(renderer.render(smear_camera, smear, smear_page).rgba, moving.rgba);
}

TEST(SmearMotion, LiesBehindWhatMovesAndNotOnIt)
{
    const SmearInk ink = ink_of_going({3.0F, 0.0F, 0.0F}, {});
    const double near_px = px_per_m(smear_camera.eye.z - 0.2); // the front, which is widest
    const auto left = static_cast<uint32_t>(0.5 * smear_page.width - 0.4 * near_px);
    const auto top = static_cast<uint32_t>(0.5 * smear_page.height - 0.6 * near_px);
    double behind = 0.0;
    for (uint32_t y = 0; y < smear_page.height; ++y) {
        for (uint32_t x = 0; x < smear_page.width; ++x) {
            if (x < left) {
                behind += ink.at(x, y);
            } else if (x > left) {
                ASSERT_EQ(ink.at(x, y), 0.0) << x << ", " << y;
            }
            if (y + 6 < top || y > smear_page.height - top + 6) {
                ASSERT_EQ(ink.at(x, y), 0.0) << "aside, " << x << ", " << y;
            }
        }
    }
    // Strokes cover some of the area that they may reach, and far from all of it.
    const double reach_px = 3.0 * 3.0 * smear_s * near_px;
    const double share = behind / (reach_px * 1.2 * near_px);
    std::printf("ink behind %.0f px, %.3f of the place for it\n", behind, share);
    EXPECT_GT(share, 0.02);
    EXPECT_LT(share, 0.35);
    // Strokes begin directly at the edge, without a gap.
    double at_edge = 0.0;
    for (uint32_t y = top; y < smear_page.height - top; ++y) {
        at_edge += ink.at(left - 1, y);
    }
    EXPECT_GT(at_edge, 0.1 * 1.2 * near_px);
}

/// Correlation of the ink with itself at an offset.
double likeness(const SmearInk& ink, const glm::dvec2& way_px)
{
    double sum = 0.0;
    const auto whole = glm::ivec2(glm::floor(way_px));
    const glm::dvec2 part = way_px - glm::dvec2(whole);
    for (int y = 0; y < static_cast<int>(smear_page.height); ++y) {
        for (int x = 0; x < static_cast<int>(smear_page.width); ++x) {
            const glm::ivec2 to = glm::ivec2(x, y) + whole;
            if (to.x < 0 || to.y < 0 || to.x + 1 >= static_cast<int>(smear_page.width) ||
                to.y + 1 >= static_cast<int>(smear_page.height)) {
                continue;
            }
            const auto ink_at = [&](int dx, int dy) {
                return ink.at(static_cast<uint32_t>(to.x + dx), static_cast<uint32_t>(to.y + dy));
            };
            const double there = glm::mix(glm::mix(ink_at(0, 0), ink_at(1, 0), part.x),
                                          glm::mix(ink_at(0, 1), ink_at(1, 1), part.x), part.y);
            sum += ink.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)) * there;
        }
    }
    return sum;
}

TEST(SmearMotion, RunsAlongTheVelocity)
{
    constexpr double rad_per_deg = 3.14159265358979 / 180.0;
    for (const double asked_deg : {0.0, 25.0, -50.0}) {
        const double asked_rad = asked_deg * rad_per_deg;
        const SmearInk ink = ink_of_going({static_cast<float>(3.0 * std::cos(asked_rad)),
                                           static_cast<float>(3.0 * std::sin(asked_rad)), 0.0F},
                                          {});
        double best = 0.0;
        double seen_deg = 0.0;
        for (double deg = -90.0; deg < 90.0; deg += 0.5) {
            constexpr double away_px = 20.0;
            const double alike = likeness(
                ink, away_px * glm::dvec2(std::cos(deg * rad_per_deg), -std::sin(deg * rad_per_deg)));
            seen_deg = alike > best ? deg : seen_deg;
            best = std::max(alike, best);
        }
        std::printf("strokes run at %.1f deg, %.0f asked\n", seen_deg, asked_deg);
        EXPECT_NEAR(seen_deg, asked_deg, 3.0);
    }
}

TEST(SmearMotion, ReachesAsFarAsItsSpeed)
{
    const auto reach_px = [](float speed, const char* length) {
        const double edge_px = 0.5 * smear_page.width - 0.4 * px_per_m(smear_camera.eye.z - 0.2);
        return edge_px - leftmost(ink_of_going({speed, 0.0F, 0.0F}, {length}));
    };
    const double slow = reach_px(1.5F, "motion_blur.smear.length=2");
    const double fast = reach_px(3.0F, "motion_blur.smear.length=2");
    const double longer = reach_px(1.5F, "motion_blur.smear.length=4");
    const double most_px = 2.0 * 1.5 * smear_s * px_per_m(smear_camera.eye.z - 0.2);
    std::printf("reach %.0f px, %.0f at twice the speed, %.0f at twice the length; at most %.0f\n", slow,
                fast, longer, most_px);
    EXPECT_NEAR(fast / slow, 2.0, 0.2);
    EXPECT_NEAR(longer / slow, 2.0, 0.2);
    EXPECT_LE(slow, most_px + 1.0);
    EXPECT_GT(slow, 0.6 * most_px);
}

TEST(SmearMotion, IsAnotherHandByItsSeedAlone)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(going({3.0F, 0.0F, 0.0F}));
    const auto draw = [&](const char* seed) {
        return renderer.render(smear_camera, paper({"motion_blur.smear.enabled=true", seed}), smear_page)
            .rgba;
    };
    const std::vector<uint8_t> first = draw("drawing.seed=1");
    EXPECT_NE(draw("drawing.seed=2"), first);
    EXPECT_EQ(draw("drawing.seed=1"), first);
}

TEST(SmearMotion, HasFewerStrokesFartherApart)
{
    const double close = ink_of_going({3.0F, 0.0F, 0.0F}, {"motion_blur.smear.spacing_mm=2"}).sum;
    const double apart = ink_of_going({3.0F, 0.0F, 0.0F}, {"motion_blur.smear.spacing_mm=12"}).sum;
    std::printf("ink %.0f px, six times as far apart %.0f\n", close, apart);
    EXPECT_LT(apart, 0.5 * close);
    EXPECT_GT(apart, 0.0);
}

TEST(SmearMotion, GoesAlongWithWhatMoves)
{
    // After a motion of one whole pixel the strokes are equal but for that pixel; with another seed they
    // differ.
    Renderer& renderer = test::shared_renderer();
    constexpr double speed = 3.0;
    const double away_m = smear_camera.eye.z;
    renderer.set_scene(going({speed, 0.0F, 0.0F}));
    const auto draw = [&](double time_s, const char* seed) {
        RenderSettings settings = smear_page;
        settings.time_s = time_s;
        const Image plain = renderer.render(smear_camera, paper({}), settings);
        return smear_ink(
            plain, renderer.render(smear_camera, paper({"motion_blur.smear.enabled=true", seed}), settings));
    };
    constexpr uint32_t shift_px = 4;
    const double later_s = smear_page.time_s + shift_px / px_per_m(away_m - 0.2) / speed;
    const SmearInk now = draw(smear_page.time_s, "drawing.seed=1");
    const SmearInk later = draw(later_s, "drawing.seed=1");
    const SmearInk other = draw(later_s, "drawing.seed=2");
    const auto apart = [&](const SmearInk& seen) {
        double sum = 0.0;
        for (uint32_t y = 0; y < smear_page.height; ++y) {
            for (uint32_t x = 0; x + shift_px < smear_page.width; ++x) {
                sum += std::abs(now.at(x, y) - seen.at(x + shift_px, y));
            }
        }
        return sum / now.sum;
    };
    std::printf("apart by %.3f of the ink, of another hand %.3f\n", apart(later), apart(other));
    EXPECT_LT(apart(later), 0.25);
    EXPECT_GT(apart(other), 3.0 * apart(later));
}

TEST(SmearMotion, IsTheSameInAllSamples)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(going({3.0F, 0.5F, 0.0F}));
    const auto draw = [&](uint32_t samples) {
        RenderSettings settings = smear_page;
        settings.samples = samples;
        const Image plain = renderer.render(smear_camera, paper({}), settings);
        return smear_ink(plain,
                         renderer.render(smear_camera, paper({"motion_blur.smear.enabled=true"}), settings));
    };
    const SmearInk once = draw(1);
    const SmearInk often = draw(8);
    double apart = 0.0;
    for (size_t i = 0; i < once.of_pixel.size(); ++i) {
        apart += std::abs(once.of_pixel[i] - often.of_pixel[i]) / once.sum;
    }
    std::printf("of eight samples, apart by %.3f of the ink\n", apart);
    EXPECT_LT(apart, 0.35);
}

TEST(SmearMotion, IsHiddenByWhatStandsBefore)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = going({3.0F, 0.0F, 0.0F});
    test::add_object(scene, shapes::quad(0.3F, 3.0F), {0.9F, 0.9F, 0.9F}, {-0.6, -1.5, 0.8});
    renderer.set_scene(scene);
    const Image plain = renderer.render(smear_camera, paper({}), smear_page);
    const SmearInk ink = smear_ink(
        plain, renderer.render(smear_camera, paper({"motion_blur.smear.enabled=true"}), smear_page));
    const double near_px = px_per_m(smear_camera.eye.z - 0.8);
    const double middle = 0.5 * smear_page.width - 0.6 * near_px;
    double on_post = 0.0;
    for (uint32_t y = 0; y < smear_page.height; ++y) {
        for (auto x = static_cast<uint32_t>(middle - 0.15 * near_px + 1.0); x < middle + 0.15 * near_px - 1.0;
             ++x) {
            on_post += std::abs(ink.at(x, y));
        }
    }
    EXPECT_EQ(on_post, 0.0);
    EXPECT_GT(ink.sum, 20.0);
}

} // namespace
} // namespace estampe
