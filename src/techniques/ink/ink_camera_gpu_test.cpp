// SPDX-License-Identifier: MIT
// Ink while the camera moves.
#include "techniques/ink/ink_test_support.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace estampe::ink {
namespace {

constexpr uint32_t camera_side = 96;

/// A wall that faces the eye, 4 m away.
const Camera start_camera{
    .eye = {0.0, 0.0, 4.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 1.0, .near_m = 0.1};

/// The point of the wall at a place of the page.
glm::dvec3 wall_at(const shared::FrameGlobals& seen, glm::dvec2 page_px)
{
    const glm::dvec2 ndc = 2.0 * page_px / glm::dvec2(seen.page_px) - 1.0;
    const glm::dvec3 ahead(glm::dmat4(seen.anchor_from_clip) * glm::dvec4(ndc, 0.0, 1.0));
    const glm::dvec3 eye(seen.eye_anchor);
    return eye - ahead * (eye.z / ahead.z);
}

glm::dvec3 ndc_of(const shared::FrameGlobals& seen, const glm::dvec3& point)
{
    const glm::dvec4 clip = glm::dmat4(seen.clip_from_anchor) * glm::dvec4(point, 1.0);
    return glm::dvec3(clip) / clip.w;
}

glm::dvec2 place_px(const shared::FrameGlobals& seen, const glm::dvec3& point)
{
    return (0.5 * glm::dvec2(ndc_of(seen, point)) + 0.5) * glm::dvec2(seen.page_px);
}

View view_between(const shared::FrameGlobals& before, const shared::FrameGlobals& now)
{
    return {.before_from_clip = glm::mat4(glm::dmat4(before.clip_from_anchor) *
                                          glm::inverse(glm::dmat4(now.clip_from_anchor))),
            .is_moved = true,
            .plane_depth = static_cast<float>(ndc_of(now, glm::dvec3(0.0)).z)};
}

using Path = std::function<Camera(double share)>;

const std::map<std::string, Path> paths{
    {"turns",
     [](double share) {
         Camera camera = start_camera;
         camera.target = {4.0 * std::tan(0.12 * share), 4.0 * std::tan(0.05 * share), 0.0};
         return camera;
     }},
    {"rolls",
     [](double share) {
         Camera camera = start_camera;
         camera.up = {std::sin(0.4 * share), std::cos(0.4 * share), 0.0};
         return camera;
     }},
    {"advances",
     [](double share) {
         Camera camera = start_camera;
         camera.eye.z -= share;
         return camera;
     }},
    {"steps aside",
     [](double share) {
         Camera camera = start_camera;
         camera.eye.x += 0.6 * share;
         camera.target.x += 0.6 * share;
         return camera;
     }},
};

/// How far ink on the wall has drifted from its wall point at the end of a camera path, in pixels of the
/// page.
double drift_px(Follow follow, const Path& path)
{
    constexpr int pictures = 8;
    InkStyle style = still_ink();
    style.follow = follow;
    style.oversize = 1.5F;
    style.amount_per_s = 1000.0F;
    style.spacing_mm = 8.0F;
    style.spot_mm = 4.0F;
    style.age_s = 0.5F;
    Bench bench({camera_side, camera_side}, path(0.0));
    shared::FrameGlobals seen = bench.globals();
    bench.depth_at = [&](glm::uvec2 pixel) {
        return static_cast<float>(ndc_of(seen, wall_at(seen, glm::dvec2(pixel) + 0.5)).z);
    };
    bench.hatch_at = [](glm::uvec2 pixel) {
        return glm::distance(glm::vec2(pixel) + 0.5F, glm::vec2(36.0F, 56.0F)) < 9.0F ? 1.0F : 0.0F;
    };
    bench.advance(style, 2.0);
    EXPECT_GT(bench.mean_cover(), 1e-4) << "there is ink to look at";
    const glm::dvec3 laid_on = wall_at(seen, bench.middle_px());
    style.amount_per_s = 0.0F;
    for (int picture = 1; picture <= pictures; ++picture) {
        const shared::FrameGlobals before = seen;
        bench.camera = path(static_cast<double>(picture) / pictures);
        seen = bench.globals();
        bench.advance(style, 2.0, view_between(before, seen));
    }
    return glm::distance(bench.middle_px(), place_px(seen, laid_on));
}

TEST(InkCamera, DriftsByWhatEachWayToFollowLeavesOut)
{
    const std::map<std::string, Follow> ways{{"page", Follow::page},
                                             {"turn", Follow::turn},
                                             {"advance", Follow::advance},
                                             {"around", Follow::around},
                                             {"surface", Follow::surface}};
    std::map<std::string, double> drift;
    for (const auto& [path_name, path] : paths) {
        std::string line = path_name + ":";
        for (const auto& [name, follow] : ways) {
            drift[name + " " + path_name] = drift_px(follow, path);
            line += fmt::format(" {} {:.2f} px", name, drift[name + " " + path_name]);
        }
        RecordProperty(path_name, line);
        fmt::print("{}\n", line);
    }
    constexpr double still_px = 0.3;
    for (const char* path : {"turns", "rolls", "advances", "steps aside"}) {
        EXPECT_GT(drift[fmt::format("page {}", path)], 1.0) << "the camera moves at all: " << path;
        EXPECT_LT(drift[fmt::format("surface {}", path)], still_px) << path;
        // A wall that faces the eye matches the plane of Follow::advance until the camera turns.
        EXPECT_LT(drift[fmt::format("advance {}", path)], 1.0) << path;
    }
    for (const char* path : {"turns", "rolls"}) {
        EXPECT_LT(drift[fmt::format("turn {}", path)], still_px) << path;
        EXPECT_LT(drift[fmt::format("around {}", path)], still_px) << path;
    }
    EXPECT_GT(drift["turn steps aside"], 3.0) << "what is far stays behind";
}

TEST(InkCamera, LeavesNoInkOnWhatWasHidden)
{
    // Ink lies on a near object on the left. The object's edge moves back by sixteen pixels and uncovers more
    // background.
    InkStyle style = still_ink();
    style.follow = Follow::surface;
    style.amount_per_s = 1000.0F;
    style.spacing_mm = 4.0F;
    style.spot_mm = 2.0F;
    style.age_s = 0.5F;
    Bench bench({camera_side, camera_side}, start_camera);
    const auto near_depth = static_cast<float>(ndc_of(bench.globals(), {0.0, 0.0, 2.0}).z);
    const auto far_depth = static_cast<float>(ndc_of(bench.globals(), {0.0, 0.0, -40.0}).z);
    uint32_t edge_px = 48;
    bench.depth_at = [&](glm::uvec2 pixel) { return pixel.x < edge_px ? near_depth : far_depth; };
    bench.hatch_at = [](glm::uvec2 pixel) { return pixel.x < 48 ? 1.0F : 0.0F; };
    bench.advance(style, 2.0);
    const auto before = bench.cells();
    style.amount_per_s = 0.0F;
    edge_px = 32;
    bench.advance(style, 2.0, {.is_moved = true});
    const auto after = bench.cells();
    constexpr uint32_t beyond_halo = 32 + 6; // ink within 5 mm of an object moves with it
    size_t inked = 0;
    size_t wrong = 0;
    for (uint32_t i = 0; i < after.size(); ++i) {
        const uint32_t column = i % camera_side;
        const bool came_into_sight = column >= beyond_halo && column < 48;
        inked += came_into_sight && before[i].x > 0.5F ? 1 : 0;
        wrong += came_into_sight && after[i].x != 0.0F ? 1 : 0;
        wrong += column < 32 && after[i].x != before[i].x ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(inked, 20U);
}

TEST(InkCamera, StaysOnWhatMovesByItself)
{
    InkStyle style = still_ink();
    style.follow = Follow::surface;
    Bench bench({64, 64}, start_camera);
    bench.fill(style, [](glm::uvec2 cell) {
        return glm::vec2(std::exp(-0.08F * glm::dot(glm::vec2(cell) - 23.5F, glm::vec2(cell) - 23.5F)), 0.0F);
    });
    bench.motion_at = [](glm::uvec2) { return glm::vec4(1.5F, -0.5F, 1.0F, 1.0F); };
    for (int picture = 0; picture < 8; ++picture) {
        bench.advance(style, 0.0, {.has_motion = true});
    }
    EXPECT_NEAR(bench.middle_px().x, 24.0 + 12.0, 0.1);
    EXPECT_NEAR(bench.middle_px().y, 24.0 - 4.0, 0.1);
    style.follow = Follow::page;
    style.drag = 0.5F;
    bench.fill(style, [](glm::uvec2 cell) {
        return glm::vec2(std::exp(-0.08F * glm::dot(glm::vec2(cell) - 23.5F, glm::vec2(cell) - 23.5F)), 0.0F);
    });
    for (int picture = 0; picture < 8; ++picture) {
        bench.advance(style, 0.0, {.has_motion = true});
    }
    EXPECT_NEAR(bench.middle_px().x, 24.0 + 6.0, 0.1) << "on the page it goes half as far";
}

/// Ink of the cube around the eye at a place of a face, interpolated between the face's own cells.
class Cube {
public:
    Cube(const Grid& grid, std::vector<glm::vec2> cells) : grid_(grid), cells_(std::move(cells)) {}

    [[nodiscard]] double cell(uint32_t face, int x, int y) const
    {
        const uint32_t rows = grid_.face_side + 2 * shared::ink_gutter;
        const auto row = static_cast<size_t>(static_cast<int>(face * rows + shared::ink_gutter) + y);
        return static_cast<double>(
            cells_.at(row * grid_.size.x + static_cast<size_t>(x + int{shared::ink_gutter})).x);
    }

    /// `place` runs from -1 to 1.
    [[nodiscard]] double at(uint32_t face, glm::dvec2 place) const
    {
        const glm::dvec2 grid = (0.5 * place + 0.5) * static_cast<double>(grid_.face_side) - 0.5;
        const glm::ivec2 first(glm::floor(grid));
        const glm::dvec2 f = grid - glm::dvec2(first);
        return glm::mix(glm::mix(cell(face, first.x, first.y), cell(face, first.x + 1, first.y), f.x),
                        glm::mix(cell(face, first.x, first.y + 1), cell(face, first.x + 1, first.y + 1), f.x),
                        f.y);
    }

    /// Largest difference between neighbouring cells of a face.
    [[nodiscard]] double largest_step() const
    {
        double largest = 0.0;
        const auto side_cells = static_cast<int>(grid_.face_side);
        for (uint32_t face = 0; face < 6; ++face) {
            for (int y = 0; y < side_cells; ++y) {
                for (int x = 0; x + 1 < side_cells; ++x) {
                    largest = std::max({largest, std::abs(cell(face, x + 1, y) - cell(face, x, y)),
                                        std::abs(cell(face, y, x + 1) - cell(face, y, x))});
                }
            }
        }
        return largest;
    }

private:
    Grid grid_;
    std::vector<glm::vec2> cells_;
};

glm::dvec3 on_face(uint32_t face, glm::dvec2 at)
{
    const double towards = face % 2 == 0 ? 1.0 : -1.0;
    return face < 2   ? glm::dvec3(towards, at.x, at.y)
           : face < 4 ? glm::dvec3(at.y, towards, at.x)
                      : glm::dvec3(at.x, at.y, towards);
}

/// Position of a direction in the plane of a face, even outside the face.
glm::dvec2 place_on(uint32_t face, const glm::dvec3& d)
{
    const double along = std::abs(d[static_cast<int>(face / 2)]);
    return face < 2   ? glm::dvec2(d.y, d.z) / along
           : face < 4 ? glm::dvec2(d.z, d.x) / along
                      : glm::dvec2(d.x, d.y) / along;
}

TEST(InkCamera, HasNoSeamsAroundTheEye)
{
    InkStyle style = still_ink();
    style.follow = Follow::around;
    style.cell_mm = 2.0F;
    style.wind_mm_per_s = 12.0F;
    style.swirl_mm = 60.0F;
    style.swirl_mm_per_s = 10.0F;
    Bench bench({camera_side, camera_side}, start_camera);
    const Grid grid = grid_of(style, bench.page());
    ASSERT_GT(grid.face_side, 60U);
    // Bands along great circles that cross all twelve edges.
    const uint32_t rows = grid.face_side + 2 * shared::ink_gutter;
    bench.fill(style, [&](glm::uvec2 cell) {
        const glm::dvec2 at =
            2.0 * (glm::dvec2(cell.x, cell.y % rows) + 0.5 - static_cast<double>(shared::ink_gutter)) /
                static_cast<double>(grid.face_side) -
            1.0;
        const glm::dvec3 direction = glm::normalize(on_face(cell.y / rows, at));
        double ink = 0.0;
        for (const glm::dvec3 axis :
             {glm::dvec3(1.0, 1.0, 1.0), glm::dvec3(1.0, 1.0, -1.0), glm::dvec3(1.0, -1.0, 1.0)}) {
            const double off = glm::dot(direction, glm::normalize(axis)) / 0.15;
            ink = std::max(ink, std::exp(-off * off));
        }
        return glm::vec2(static_cast<float>(ink), 0.0F);
    });
    for (int picture = 1; picture <= 3; ++picture) {
        bench.advance(
            style, picture,
            {.forward = glm::normalize(glm::vec3(0.3F, 0.2F, -1.0F)), .up = glm::vec3(0.0F, 1.0F, 0.0F)});
    }
    const Cube cube(grid, bench.cells());
    std::array<double, 12> seams{};
    size_t edges = 0;
    for (uint32_t a = 0; a < 6; ++a) {
        for (uint32_t b = a + 1; b < 6; ++b) {
            if (a / 2 == b / 2) {
                continue;
            }
            double& seam = seams.at(edges++);
            double inked = 0.0;
            for (double along = -0.98; along < 0.99; along += 0.01) {
                glm::dvec3 direction(along);
                direction[static_cast<int>(a / 2)] = a % 2 == 0 ? 1.0 : -1.0;
                direction[static_cast<int>(b / 2)] = b % 2 == 0 ? 1.0 : -1.0;
                const double of_a = cube.at(a, place_on(a, direction));
                seam = std::max(seam, std::abs(of_a - cube.at(b, place_on(b, direction))));
                inked = std::max(inked, of_a);
            }
            EXPECT_GT(inked, 0.3) << "ink crosses the edge of faces " << a << " and " << b;
        }
    }
    ASSERT_EQ(edges, 12U);
    const double largest_seam = *std::ranges::max_element(seams);
    const double within = cube.largest_step();
    EXPECT_LE(largest_seam, 0.1 * within) << "of cells side by side";
    RecordProperty("seam", std::to_string(largest_seam));
    RecordProperty("within", std::to_string(within));
}

} // namespace
} // namespace estampe::ink
