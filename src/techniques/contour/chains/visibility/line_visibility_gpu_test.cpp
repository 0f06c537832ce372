// SPDX-License-Identifier: MIT
// Visibility of lines, compared with rays, and its stability from frame to frame.
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "features/lines/lines.hpp"
#include "scene/pose.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "techniques/contour/chains/chains_test_scene.hpp"

namespace estampe::contour {
namespace {

using shared::LineSample;

/// Number of samples, of wrongly hidden samples and of wrongly shown samples, compared with rays.
struct Agreement {
    size_t asked = 0;
    size_t falsely_hidden = 0;
    size_t falsely_shown = 0;

    Agreement& operator+=(const Agreement& other)
    {
        asked += other.asked;
        falsely_hidden += other.falsely_hidden;
        falsely_shown += other.falsely_shown;
        return *this;
    }
};

/// One entry for each kind of line.
using Agreements = std::array<Agreement, shared::line_kind_count>;

/// How far the smooth surface may bulge out of the triangle that an outline runs through.
float bulge_m(const EdgeMesh& mesh, const std::vector<shared::PosedVertex>& posed, uint32_t side)
{
    if ((side & 3U) != 3U) {
        return 0.0F;
    }
    float bulge = 0.0F;
    const glm::uvec4& corners = mesh.triangles[side >> 2U];
    for (int k = 0; k < 3; ++k) {
        const shared::PosedVertex& a = posed[corners[k]];
        const shared::PosedVertex& b = posed[corners[(k + 1) % 3]];
        bulge =
            std::max(bulge, 0.125F * glm::distance(a.position, b.position) *
                                glm::distance(pose::unpack_normal(a.normal), pose::unpack_normal(b.normal)));
    }
    return bulge;
}

/// Compares the visibility of samples with rays to the same test points, slightly outside of the samples' own
/// surface.
Agreements compare_with_rays(const Scene& scene, const Camera& camera, glm::uvec2 size_px,
                             const ContourStyle& style = {})
{
    test::Drawing drawing(scene, camera, size_px);
    const auto lists = drawing.chains(style);
    const EdgeMesh mesh = features::edge_mesh_of(drawing.layout);
    const std::vector<shared::PosedVertex> posed = drawing.posed();
    const test::EmbreeScene rays(scene, 0.0, [&](const PosedPrimitive& primitive) {
        return scene.materials[primitive.primitive->material].alpha_mode != AlphaMode::blend;
    });
    const glm::dmat4 clip_from_anchor(drawing.globals.clip_from_anchor);
    Agreements results{};
    for (const LineSample& sample : lists.samples) {
        const bool is_on_page = sample.page_px.x > 2.0F && sample.page_px.y > 2.0F &&
                                sample.page_px.x < static_cast<float>(size_px.x) - 2.0F &&
                                sample.page_px.y < static_cast<float>(size_px.y) - 2.0F;
        if (!is_on_page) {
            continue;
        }
        const double w = (clip_from_anchor * glm::dvec4(sample.anchor, 1.0)).w;
        const double pixel_m = 2.0 * w * std::tan(0.5 * camera.vertical_fov_rad) / size_px.y;
        const double outside_m =
            0.75 * pixel_m + static_cast<double>(bulge_m(mesh, posed, sample.source & 0x0fffffffU));
        // Where two surfaces intersect, a point outside of one may be inside the other.
        const glm::dvec3 place = glm::dvec3(sample.anchor) + drawing.layout.anchor;
        const bool is_of_page = sample.source >> 28U >= shared::line_first_of_page;
        const glm::dvec3 outside = is_of_page
                                       ? place + 1.5 * pixel_m * glm::normalize(camera.eye - place)
                                       : place + outside_m * glm::dvec3(pose::unpack_normal(sample.normal));
        const glm::dvec3 way = outside - camera.eye;
        const bool is_free = !rays.is_blocked(camera.eye, glm::normalize(way), glm::length(way));
        const bool is_shown = (sample.state & shared::sample_is_visible) != 0;
        Agreement& result = results.at(sample.source >> 28U);
        ++result.asked;
        result.falsely_hidden += is_free && !is_shown ? 1U : 0U;
        result.falsely_shown += !is_free && is_shown ? 1U : 0U;
    }
    return results;
}

/// Expects agreement with rays for the kinds of lines in [first, end).
void expect_agreement(const Agreements& of_kinds, const std::string& name, uint32_t first = 0,
                      uint32_t end = shared::line_kind_count)
{
    Agreement agreement;
    for (uint32_t kind = first; kind < end; ++kind) {
        agreement += of_kinds.at(kind);
    }
    EXPECT_GT(agreement.asked, 500U) << name;
    EXPECT_LE(static_cast<double>(agreement.falsely_hidden + agreement.falsely_shown),
              0.01 * static_cast<double>(agreement.asked))
        << name << ": of " << agreement.asked << " samples " << agreement.falsely_hidden
        << " falsely hidden, " << agreement.falsely_shown << " falsely shown";
}

TEST(ContourChains, VisibilityAgreesWithRays)
{
    expect_agreement(compare_with_rays(shapes_scene(), view_from_above(), {640, 480}), "shapes");
}

/// A style with all kinds of lines inside smooth surfaces.
ContourStyle inner_lines()
{
    ContourStyle style;
    style.ridge = style.valley = style.suggestive = {.width_mm = 0.3F};
    style.ridge_deg = 4.0F;
    style.suggestive_growth = 1.0F;
    return style;
}

/// Tests each of these kinds of lines separately, because outlines would outnumber them.
void expect_inner_agreement(const Scene& scene, const std::vector<Camera>& cameras, glm::uvec2 size_px,
                            const std::string& name)
{
    Agreements agreements{};
    for (const Camera& camera : cameras) {
        const Agreements of_view = compare_with_rays(scene, camera, size_px, inner_lines());
        for (size_t kind = 0; kind < agreements.size(); ++kind) {
            agreements.at(kind) += of_view.at(kind);
        }
    }
    expect_agreement(agreements, name + ", ridges", shared::line_ridge, shared::line_ridge + 1);
    expect_agreement(agreements, name + ", valleys", shared::line_valley, shared::line_valley + 1);
    expect_agreement(agreements, name + ", suggestive contours", shared::line_suggestive,
                     shared::line_suggestive + 1);
}

/// Ripples around the middle of a square, seen across their crests.
Primitive ripples()
{
    Primitive sheet = shapes::plane(4.0F, 4.0F, 96);
    for (size_t i = 0; i < sheet.positions.size(); ++i) {
        glm::vec3& p = sheet.positions[i];
        const float phase = 6.0F * glm::length(p);
        const glm::vec2 outwards = glm::vec2(p.x, p.z) / std::max(glm::length(p), 1e-6F);
        const glm::vec2 slope = -6.0F * 0.14F * std::sin(phase) * outwards;
        p.y = 0.14F * std::cos(phase);
        sheet.normals[i] = glm::normalize(glm::vec3(-slope.x, 1.0F, -slope.y));
    }
    return sheet;
}

TEST(ContourChains, VisibilityOfInnerLinesAgreesWithRays)
{
    Scene scene = test::scene_of(ripples());
    test::add_object(scene, shapes::torus(0.9F, 0.4F, 96, 48), glm::vec3(0.5F), {0.6, 0.9, 0.3});
    const std::vector<Camera> cameras{{.eye = {2.2, 1.9, 5.2}, .target = {0.2, 0.2, 0.2}},
                                      {.eye = {-4.1, 1.5, 2.6}, .target = {0.2, 0.2, 0.2}},
                                      {.eye = {2.4, 1.2, -4.4}, .target = {0.2, 0.2, 0.2}}};
    expect_inner_agreement(scene, cameras, {960, 720}, "ripples");
}

TEST(ContourChains, VisibilityOnModelsAgreesWithRays)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    for (const char* name :
         {"suzanne.gltf", "fandisk.obj", "stanford-bunny.obj", "FlightHelmet/FlightHelmet.gltf"}) {
        if (folder == nullptr || !std::filesystem::exists(std::filesystem::path(folder) / name)) {
            continue;
        }
        const Scene scene = load_scene(std::filesystem::path(folder) / name);
        const Camera camera = framing_camera(scene, pose_scene(scene, 0.0, no_index), 16.0 / 9.0);
        expect_agreement(compare_with_rays(scene, camera, {1920, 1080}), name);
        if (std::string(name) == "suzanne.gltf") {
            expect_inner_agreement(scene, {camera}, {1920, 1080}, name);
        }
    }
}

/// Lines of one width that taper, as LineHistory keeps them from frame to frame.
ContourStyle tapered(float width_px)
{
    ContourStyle style = even_lines(width_px);
    style.taper_mm = 40.0F;
    return style;
}

TEST(ContourChains, AFilmIsSteadierThanStills)
{
    const Scene scene = shapes_scene();
    constexpr glm::uvec2 size_px{480, 360};
    const auto alone = [&](const std::vector<float>& frame, const std::vector<float>& other) {
        size_t count = 0;
        const auto width = static_cast<int>(size_px.x);
        for (int i = 0; i < static_cast<int>(frame.size()); ++i) {
            bool is_near = frame[static_cast<size_t>(i)] < 0.5F;
            for (int dy = -4; dy <= 4 && !is_near; ++dy) {
                for (int dx = -4; dx <= 4 && !is_near; ++dx) {
                    const int at = i + dy * width + dx;
                    is_near = dx * dx + dy * dy <= 16 && at >= 0 && at < static_cast<int>(frame.size()) &&
                              other[static_cast<size_t>(at)] >= 0.5F;
                }
            }
            count += is_near ? 0U : 1U;
        }
        return count;
    };
    size_t in_film = 0;
    size_t in_stills = 0;
    const auto features = std::make_shared<frame::Features>();
    std::vector<float> film_before;
    std::vector<float> still_before;
    for (int frame = 0; frame < 12; ++frame) {
        const double angle = glm::radians(0.25) * frame;
        Camera camera = view_from_above();
        camera.eye = {camera.eye.x * std::cos(angle) + camera.eye.z * std::sin(angle), camera.eye.y,
                      camera.eye.z * std::cos(angle) - camera.eye.x * std::sin(angle)};
        test::Drawing drawing(scene, camera, size_px);
        drawing.features = features;
        const auto still = drawing.lines(tapered(8.0F), 1.0F);
        drawing.begin_film_frame(frame > 0);
        const auto film = drawing.lines(tapered(8.0F), 1.0F, true);
        drawing.end_film_frame();
        if (frame > 0) {
            in_film += alone(film, film_before) + alone(film_before, film);
            in_stills += alone(still, still_before) + alone(still_before, still);
        }
        film_before = film;
        still_before = still;
    }
    EXPECT_LT(in_film, 40U);
    EXPECT_LE(in_film, in_stills);
}

} // namespace
} // namespace estampe::contour
