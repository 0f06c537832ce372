// SPDX-License-Identifier: MIT
// Lines around clumps of leaves. The leaves are small squares of a cut-out material, spread over discs and
// seen in parallel projection, so that all lengths on the page are known.
#include <estampe/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr float page_height_mm = 210.0F;
constexpr float page_width_mm = 297.0F;
constexpr RenderSettings page{.width = 1188, .height = 840}; // four pixels to a millimetre
constexpr float clump_mm = 3.0F;
constexpr float leaf_mm = 2.0F;
constexpr float between_mm = 3.0F; // distance of the middles of two leaves, so gaps are 1 mm wide

Style lines_only(const std::vector<std::string>& assignments)
{
    Style style;
    for (const char* assignment :
         {"hatch.enabled=false", "wash.strength=0", "picture.ground=false", "paper.height_mm=210",
          "paper.margin_mm=0", "sky.enabled=false", "contour.clump_mm=3"}) {
        style.set(assignment);
    }
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return style;
}

/// A camera that sees one metre of the scene as a millimetre of the page.
Camera camera()
{
    Camera camera = test::front_camera(500.0, 0.6);
    camera.orthographic_half_height_m = 0.5 * page_height_mm;
    return camera;
}

struct Disc {
    glm::vec3 middle{0.0F};
    float radius = 40.0F;
    /// Normal of the leaf at a place relative to the middle.
    std::function<glm::vec3(const glm::vec2&)> normal = [](const glm::vec2&) { return glm::vec3(0, 0, 1); };
    std::function<bool(const glm::vec2&)> has_leaf = [](const glm::vec2&) { return true; };
};

Primitive leaves_of(const Disc& disc)
{
    Primitive leaves;
    const int reach = static_cast<int>(disc.radius / between_mm);
    for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
            const glm::vec2 place = between_mm * glm::vec2(column, row);
            if (glm::length(place) > disc.radius || !disc.has_leaf(place)) {
                continue;
            }
            const auto first = static_cast<uint32_t>(leaves.positions.size());
            for (const glm::vec2 corner :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                leaves.positions.push_back(disc.middle + glm::vec3(place + 0.5F * leaf_mm * corner, 0.0F));
                leaves.normals.push_back(disc.normal(place));
            }
            for (const uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) {
                leaves.indices.push_back(first + k);
            }
        }
    }
    return leaves;
}

void add_leaves(Scene& scene, const Primitive& leaves)
{
    test::add_object(scene, leaves, glm::vec3(0.5F), {0.0, 0.0, 0.0});
    scene.materials.back().alpha_mode = AlphaMode::mask;
    scene.materials.back().is_foliage = true;
}

Scene scene_of_leaves(const Primitive& leaves)
{
    Scene scene;
    add_leaves(scene, leaves);
    return scene;
}

Scene scene_of(const std::vector<Disc>& discs)
{
    Scene scene;
    for (const Disc& disc : discs) {
        add_leaves(scene, leaves_of(disc));
    }
    return scene;
}

std::vector<VectorStroke> strokes_of(const Scene& scene, StrokeKind kind,
                                     const std::vector<std::string>& assignments = {})
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    std::vector<VectorStroke> strokes =
        renderer.draw_strokes(camera(), lines_only(assignments), page).strokes;
    std::erase_if(strokes, [&](const VectorStroke& stroke) { return stroke.kind != kind; });
    return strokes;
}

/// Position relative to the middle of the page, y up.
glm::vec2 from_middle(const VectorPoint& point)
{
    return {point.page_mm.x - 0.5F * page_width_mm, 0.5F * page_height_mm - point.page_mm.y};
}

/// Length in millimetres of those pieces of strokes whose middle is in a region of the page.
float length_within(const std::vector<VectorStroke>& strokes,
                    const std::function<bool(const glm::vec2&)>& region)
{
    float length = 0.0F;
    for (const VectorStroke& stroke : strokes) {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
            const glm::vec2 a = from_middle(stroke.points[i - 1]);
            const glm::vec2 b = from_middle(stroke.points[i]);
            length += region(0.5F * (a + b)) ? glm::distance(a, b) : 0.0F;
        }
    }
    return length;
}

bool anywhere(const glm::vec2&)
{
    return true;
}

TEST(FoliageLines, LeavesHaveOneOutlineAroundTheirClump)
{
    const Disc disc;
    const std::vector<VectorStroke> outlines = strokes_of(scene_of({disc}), StrokeKind::outline);
    const float around_mm = 2.0F * 3.14159F * disc.radius;
    const float all_mm = length_within(outlines, anywhere);
    EXPECT_GT(all_mm, 0.9F * around_mm);
    EXPECT_LT(all_mm, 1.4F * around_mm) << "the disc of leaves has steps, and its outline has bulges";
    const float beside_mm = length_within(outlines, [&](const glm::vec2& place) {
        return std::abs(glm::length(place) - disc.radius) > clump_mm;
    });
    EXPECT_LT(beside_mm, 0.005F * around_mm);
}

TEST(FoliageLines, ALargeLeafKeepsItsOwnOutline)
{
    constexpr float radius_mm = 30.0F;
    Primitive leaf;
    for (uint32_t i = 0; i < 256; ++i) {
        const float angle = 2.0F * 3.14159265F * static_cast<float>(i) / 256.0F;
        leaf.positions.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle), 0.0F);
        leaf.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
    for (uint32_t i = 2; i < 256; ++i) {
        leaf.indices.insert(leaf.indices.end(), {0U, i - 1, i});
    }
    double sum = 0.0;
    double worst = 0.0;
    size_t count = 0;
    for (const VectorStroke& stroke : strokes_of(scene_of_leaves(leaf), StrokeKind::outline)) {
        for (const VectorPoint& point : stroke.points) {
            const double off = std::abs(static_cast<double>(glm::length(from_middle(point)) - radius_mm));
            sum += off;
            worst = std::max(worst, off);
            ++count;
        }
    }
    ASSERT_GT(count, 100U);
    // A pixel is 0.25 mm wide.
    EXPECT_LT(sum / static_cast<double>(count), 0.03);
    EXPECT_LT(worst, 0.1);
}

TEST(FoliageLines, ASmallLeafHasAnOutlineAndASmallGapHasNone)
{
    // A gap of 4 mm between leaves is not closed, but its outline is shorter than 6 clumps (18 mm).
    Disc with_gap;
    with_gap.has_leaf = [](const glm::vec2& place) { return glm::length(place) > 1.0F; };
    EXPECT_EQ(length_within(strokes_of(scene_of({with_gap}), StrokeKind::outline),
                            [](const glm::vec2& place) { return glm::length(place) < 10.0F; }),
              0.0F);
    // Four leaves make a square of 5 mm, whose outline is shorter than 6 clumps of 4 mm, too.
    Disc few;
    few.has_leaf = [](const glm::vec2& place) {
        return glm::min(place.x, place.y) >= 0.0F && glm::max(place.x, place.y) <= between_mm;
    };
    const float small_mm =
        length_within(strokes_of(scene_of({few}), StrokeKind::outline, {"contour.clump_mm=4"}), anywhere);
    EXPECT_GT(small_mm, 12.0F);
    EXPECT_LT(small_mm, 6.0F * 4.0F);
}

TEST(FoliageLines, EveryLeafHasLinesIfClumpsAreTurnedOff)
{
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene_of({Disc{}}));
    const auto ink_within = [&](const char* assignment) {
        const Image picture = renderer.render(camera(), lines_only({assignment}), page);
        int dark = 0;
        for (uint32_t y = 320; y < 520; ++y) {
            for (uint32_t x = 494; x < 694; ++x) {
                dark += picture.rgba[4 * (size_t{y} * picture.width + x)] < 128 ? 1 : 0;
            }
        }
        return static_cast<double>(dark) / (200.0 * 200.0);
    };
    EXPECT_EQ(ink_within("contour.clump_mm=3"), 0.0);
    EXPECT_GT(ink_within("contour.clump_mm=0"), 0.2);
}

TEST(FoliageLines, OnlyAGapThatIsWiderThanAClumpHasAnOutline)
{
    for (const bool is_wide : {false, true}) {
        Disc disc;
        // Without two columns of leaves, the gap is 1 + 2 x 3 = 7 mm wide; otherwise all gaps are 1 mm wide.
        disc.has_leaf = [&](const glm::vec2& place) { return !is_wide || std::abs(place.x - 1.5F) > 2.0F; };
        const float in_gap_mm =
            length_within(strokes_of(scene_of({disc}), StrokeKind::outline), [](const glm::vec2& place) {
                return std::abs(place.x - 1.5F) < 5.0F && std::abs(place.y) < 25.0F;
            });
        if (is_wide) {
            EXPECT_NEAR(in_gap_mm, 2.0F * 50.0F, 20.0F);
        } else {
            EXPECT_EQ(in_gap_mm, 0.0F);
        }
    }
}

TEST(FoliageLines, AClumpHasALineBeforeFoliageThatIsFarBehind)
{
    for (const float behind_m : {30.0F, 3.0F}) {
        const Disc near{.middle = {0.0F, 0.0F, 0.0F}, .radius = 20.0F};
        const Disc far{.middle = {0.0F, 0.0F, -behind_m}, .radius = 60.0F};
        const float inner_mm =
            length_within(strokes_of(scene_of({near, far}), StrokeKind::outline),
                          [](const glm::vec2& place) { return glm::length(place) < 40.0F; });
        if (behind_m > 3.0F * clump_mm) {
            EXPECT_GT(inner_mm, 0.8F * 2.0F * 3.14159F * near.radius);
        } else {
            EXPECT_EQ(inner_mm, 0.0F) << "a leaf beside a leaf";
        }
    }
}

TEST(FoliageLines, LeavesHaveMarksWhereTheLightEnds)
{
    Disc disc;
    disc.normal = [](const glm::vec2& place) {
        return glm::normalize(glm::vec3(std::clamp(place.x / 20.0F, -1.0F, 1.0F), 0.0F, 0.3F));
    };
    const auto marks = [&](const char* assignment) {
        return strokes_of(scene_of({disc}), StrokeKind::leaf,
                          {"light.sun_azimuth_deg=-90", "light.sun_elevation_deg=10", assignment});
    };
    const std::vector<VectorStroke> found = marks("contour.leaf.enabled=true");
    const float all_mm = length_within(found, anywhere);
    EXPECT_GT(all_mm, 10.0F);
    EXPECT_LT(all_mm, 2.0F * disc.radius) << "some leaves have none";
    EXPECT_EQ(length_within(found, [](const glm::vec2& place) { return std::abs(place.x) > 15.0F; }), 0.0F);
    EXPECT_TRUE(marks("contour.leaf.enabled=false").empty());
}

TEST(FoliageLines, ACutOutSurfaceHasNoOutlineOfItsMesh)
{
    Scene scene = test::scene_of(shapes::sphere(60.0F, 32, 16));
    scene.materials.back().alpha_mode = AlphaMode::mask;
    EXPECT_TRUE(strokes_of(scene, StrokeKind::outline).empty())
        << "a picture has lines where the alpha ends, which are found between pixels";
}

} // namespace
} // namespace estampe
