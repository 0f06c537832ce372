// SPDX-License-Identifier: MIT
// Pictures in which some objects have a style of their own.
#include <estampe/renderer.hpp>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr RenderSettings variants_page{.width = 160, .height = 120};

/// A box and a ball next to each other on a sunlit floor.
Scene named_still_life()
{
    Scene scene = test::scene_of(shapes::plane(6.0F, 6.0F));
    scene.nodes[0].name = "floor";
    scene.materials[0].name = "stone";
    const Index box = test::add_object(scene, shapes::box({1.0F, 1.5F, 1.0F}), {0.8F, 0.3F, 0.2F},
                                       glm::dvec3(-1.0, 0.0, 0.0));
    scene.nodes[box].name = "box";
    const Index ball =
        test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, glm::dvec3(1.0, 0.6, 0.5));
    scene.nodes[ball].name = "ball";
    test::add_sun(scene, {1.0, 2.0, 1.5});
    return scene;
}

Style style_of_all(const std::vector<std::string>& assignments)
{
    Style style;
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

Image draw_variants(const Style& style)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(named_still_life());
    return renderer.render(test::corner_camera, style, variants_page);
}

/// The pixels of an object, found by painting only that object.
std::vector<bool> pixels_of(const std::string& object)
{
    const Image image = draw_variants(
        style_of_all({"hatch.enabled=false", "contour.enabled=false", "paper.grain=0", "paper.granulation=0",
                      "paper.color=#fff", "wash.strength=0", "object." + object + ".wash.strength=1"}));
    std::vector<bool> pixels;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        pixels.push_back(image.rgba[i] != image.rgba[i + 2]);
    }
    return pixels;
}

using Assignments = std::vector<std::string>;

struct Otherwise {
    std::string name;
    Assignments base;
    std::vector<std::string> keys; ///< assignments without their object
};

void PrintTo(const Otherwise& tested, std::ostream* to)
{
    *to << tested.name;
}

class OtherStyles : public testing::TestWithParam<Otherwise> {};

TEST_P(OtherStyles, OfAThingAreThoseOfThePictureThere)
{
    // Effects that reach beyond a pixel are turned off.
    Assignments base{"contour.enabled=false", "bleed.enabled=false", "paper.ink_break=0"};
    base.insert(base.end(), GetParam().base.begin(), GetParam().base.end());
    Assignments all = base;
    Assignments of_ball = base;
    for (const std::string& key : GetParam().keys) {
        all.push_back(key);
        of_ball.push_back("object.ball." + key);
    }
    const std::vector<bool> is_ball = pixels_of("ball");
    const Image plain = draw_variants(style_of_all(base));
    const Image other = draw_variants(style_of_all(all));
    const Image mixed = draw_variants(style_of_all(of_ball));
    size_t wrong = 0;
    size_t changed = 0;
    for (size_t i = 0; i < is_ball.size(); ++i) {
        const Image& wanted = is_ball[i] ? other : plain;
        const auto at = static_cast<std::ptrdiff_t>(4 * i);
        wrong += std::equal(mixed.rgba.begin() + at, mixed.rgba.begin() + at + 4, wanted.rgba.begin() + at)
                     ? 0
                     : 1;
        changed +=
            std::equal(mixed.rgba.begin() + at, mixed.rgba.begin() + at + 4, plain.rgba.begin() + at) ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(changed, 100U);
}

INSTANTIATE_TEST_SUITE_P(
    Styles, OtherStyles,
    testing::Values(Otherwise{"Wash", {}, {"wash.strength=0.2", "wash.shadow_tint=#ff0000"}},
                    Otherwise{"Lines", {}, {"hatch.width_mm=0.8", "hatch.coordinates=page"}},
                    Otherwise{"Tone", {}, {"tone.exposure=0.3"}},
                    Otherwise{"Blank", {}, {"hatch.enabled=false"}},
                    Otherwise{"Map", {}, {"hatch.strokes=map", "tam.size_px=64", "tam.tones=4"}},
                    Otherwise{"LinesOnMap",
                              {"hatch.strokes=map", "tam.size_px=64", "tam.tones=4"},
                              {"hatch.strokes=lines"}},
                    Otherwise{"AnotherMap",
                              {"hatch.strokes=map", "tam.size_px=64", "tam.tones=4"},
                              {"tam.angle_deg=70", "hatch.map_tone=blend"}}),
    [](const auto& tested) { return tested.param.name; });

/// Widths and inks of an object's outline strokes.
struct Outlines {
    float widest_mm = 0.0F;
    glm::vec3 ink_srgb{0.0F};
    size_t hatching = 0;
};

Outlines outlines_of(const VectorDrawing& drawing, const std::string& object)
{
    Outlines outlines;
    for (const VectorStroke& stroke : drawing.strokes) {
        if (drawing.objects[stroke.object] != object) {
            continue;
        }
        outlines.hatching += stroke.kind == StrokeKind::hatch ? 1 : 0;
        if (stroke.kind == StrokeKind::outline || stroke.kind == StrokeKind::border) {
            outlines.ink_srgb = drawing.inks_srgb[stroke.ink];
            for (const auto& point : stroke.points) {
                outlines.widest_mm = std::max(outlines.widest_mm, point.width_mm);
            }
        }
    }
    return outlines;
}

TEST(StyleVariantPictures, LinesHaveTheInkAndTheWidthOfTheirObject)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(named_still_life());
    const Assignments even{"contour.pressure=0", "contour.distance_thinning=0", "contour.rank=0",
                           "contour.outline.width_mm=0.4", "contour.ink=#000000"};
    Assignments mixed = even;
    mixed.insert(mixed.end(), {"object.ball.contour.outline.width_mm=1.2", "object.ball.contour.ink=#ff0000",
                               "object.box.contour.enabled=false", "object.box.hatch.enabled=false"});
    const VectorDrawing plain = renderer.draw_strokes(test::corner_camera, style_of_all(even), variants_page);
    const VectorDrawing drawing =
        renderer.draw_strokes(test::corner_camera, style_of_all(mixed), variants_page);
    EXPECT_NEAR(outlines_of(plain, "ball").widest_mm, 0.4F, 0.01F);
    EXPECT_NEAR(outlines_of(drawing, "ball").widest_mm, 1.2F, 0.01F);
    EXPECT_EQ(outlines_of(drawing, "ball").ink_srgb, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_NEAR(outlines_of(drawing, "floor").widest_mm, 0.4F, 0.01F);
    EXPECT_EQ(outlines_of(drawing, "floor").ink_srgb, glm::vec3(0.0F));
    EXPECT_GT(outlines_of(plain, "box").widest_mm, 0.0F);
    EXPECT_EQ(outlines_of(drawing, "box").widest_mm, 0.0F);
    EXPECT_GT(outlines_of(plain, "box").hatching, 0U);
    EXPECT_EQ(outlines_of(drawing, "box").hatching, 0U);
    EXPECT_GT(outlines_of(drawing, "ball").hatching, 0U);
}

TEST(StyleVariantPictures, LinesInThePictureHaveTheInkOfTheirObject)
{
    const Image image = draw_variants(
        style_of_all({"hatch.enabled=false", "wash.strength=0", "paper.grain=0", "contour.ink=#000000",
                      "contour.outline.width_mm=4", "object.ball.contour.ink=#ff0000"}));
    size_t red = 0;
    size_t black = 0;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        red += image.rgba[i] > 200 && image.rgba[i + 1] < 80 ? 1 : 0;
        black += image.rgba[i] < 60 ? 1 : 0;
    }
    EXPECT_GT(red, 50U);
    EXPECT_GT(black, 50U);
}

/// Pixels of pure red and of pure blue ink.
glm::uvec2 red_and_blue(const Image& image)
{
    glm::uvec2 counts(0);
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        const bool has_red = image.rgba[i] > 200;
        const bool has_blue = image.rgba[i + 2] > 200;
        counts.x += has_red && !has_blue && image.rgba[i + 1] < 80 ? 1 : 0;
        counts.y += has_blue && !has_red && image.rgba[i + 1] < 80 ? 1 : 0;
    }
    return counts;
}

TEST(StyleVariantPictures, EachKindOfLineMayHaveAnInkOfItsOwn)
{
    const Assignments bare{
        "hatch.enabled=false",        "wash.strength=0",          "paper.grain=0", "contour.ink=#000000",
        "contour.outline.width_mm=4", "contour.crease.width_mm=4"};
    EXPECT_EQ(red_and_blue(draw_variants(style_of_all(bare))), glm::uvec2(0));
    Assignments colored = bare;
    colored.insert(colored.end(), {"contour.outline.ink=#ff0000", "contour.crease.ink=#0000ff"});
    const glm::uvec2 both = red_and_blue(draw_variants(style_of_all(colored)));
    EXPECT_GT(both.x, 50U);
    EXPECT_GT(both.y, 50U);
    Assignments of_box = bare;
    of_box.insert(of_box.end(), {"contour.outline.ink=#ff0000", "object.box.contour.crease.ink=#0000ff",
                                 "object.ball.contour.outline.ink=auto"});
    const glm::uvec2 single = red_and_blue(draw_variants(style_of_all(of_box)));
    EXPECT_GT(single.x, 20U);
    EXPECT_LT(single.x, both.x) << "the ball has the ink of all lines";
    EXPECT_EQ(single.y, both.y) << "only the box has folds";
}

TEST(StyleVariantPictures, StrokesAsPathsHaveTheInkOfTheirKind)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(named_still_life());
    const VectorDrawing drawing = renderer.draw_strokes(
        test::corner_camera,
        style_of_all({"hatch.enabled=false", "contour.ink=#000000", "contour.crease.ink=#0000ff",
                      "object.ball.contour.outline.ink=#ff0000", "contour.hidden.enabled=true"}),
        variants_page);
    size_t creases = 0;
    for (const VectorStroke& stroke : drawing.strokes) {
        const bool is_crease = stroke.kind == StrokeKind::crease;
        const bool is_of_ball = drawing.objects[stroke.object] == "ball";
        EXPECT_EQ(drawing.inks_srgb[stroke.ink], is_crease    ? glm::vec3(0.0F, 0.0F, 1.0F)
                                                 : is_of_ball ? glm::vec3(1.0F, 0.0F, 0.0F)
                                                              : glm::vec3(0.0F));
        creases += is_crease ? 1 : 0;
    }
    EXPECT_GT(creases, 0U);
}

TEST(StyleVariantPictures, PathsOfAMapAreAnErrorWhicheverVariantHasIt)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(named_still_life());
    EXPECT_THROW((void)renderer.draw_strokes(test::corner_camera,
                                             style_of_all({"object.ball.hatch.strokes=map"}), variants_page),
                 Error);
    EXPECT_NO_THROW((void)renderer.draw_strokes(
        test::corner_camera, style_of_all({"object.bell.hatch.strokes=map"}), variants_page));
    EXPECT_NE(renderer.notes().front().find("\"bell\""), std::string::npos);
}

TEST(DrawingFactorPictures, AreThoseOfTheValuesMultiplied)
{
    EXPECT_EQ(draw_variants(style_of_all({"drawing.line_weight=2", "drawing.wobble=0"})).rgba,
              draw_variants(style_of_all({"contour.outline.width_mm=1.16", "contour.border.width_mm=0.48",
                                          "contour.crease.width_mm=0.4", "contour.marked.width_mm=0.48",
                                          "contour.crest.width_mm=0.6", "contour.intersection.width_mm=0.48",
                                          "hatch.wobble_mm=0", "contour.retrace_mm=0"}))
                  .rgba);
}

TEST(DrawingFactorPictures, MoreInkWithEachThatDarkens)
{
    const auto mean = [](const std::vector<std::string>& assignments) {
        std::vector<std::string> all{"wash.strength=0", "paper.grain=0", "tone.exposure=0.6"};
        all.insert(all.end(), assignments.begin(), assignments.end());
        const Image image = draw_variants(style_of_all(all));
        double sum = 0.0;
        for (size_t i = 0; i < image.rgba.size(); i += 4) {
            sum += image.rgba[i];
        }
        return sum;
    };
    const double as_it_is = mean({});
    EXPECT_LT(mean({"drawing.darkness=1.5"}), 0.99 * as_it_is);
    EXPECT_LT(mean({"drawing.hatch_weight=1.5"}), 0.99 * as_it_is);
    EXPECT_LT(mean({"drawing.line_weight=3"}), 0.99 * as_it_is);
    EXPECT_NEAR(mean({"drawing.hatch_spacing=1.5"}), as_it_is, 0.02 * as_it_is) << "tones stay";
}

TEST(DrawingFactorPictures, TheSeedDrawsAgainByAnotherHand)
{
    const Image first = draw_variants({});
    EXPECT_NE(draw_variants(style_of_all({"drawing.seed=2"})).rgba, first.rgba);
    EXPECT_EQ(draw_variants(style_of_all({"drawing.seed=1"})).rgba, first.rgba);
}

} // namespace
} // namespace estampe
