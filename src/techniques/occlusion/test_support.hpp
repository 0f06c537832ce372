// SPDX-License-Identifier: MIT
#pragma once

// Support for tests of occlusion: a drawn page, and ray tracing as ground truth.

#include <cmath>
#include <numbers>
#include <vector>

#include "features/common/view.hpp"
#include "frame/steps.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::occlusion {

/// The visible surfaces of a scene, and their ambient visibility, 0 to 1.
struct SeenPage {
    SeenPage(const Scene& scene, const Camera& seen_from, glm::uvec2 page_px)
        : camera(seen_from), size_px(page_px), drawing(scene, seen_from, page_px), surface(drawing.surface())
    {
    }

    /// Visibility of a part of the page, or of the whole page.
    [[nodiscard]] std::vector<float> open(const OcclusionStyle& style, float radius_m,
                                          std::optional<features::PixelRect> part = std::nullopt) const
    {
        const features::PixelRect drawn = part.value_or(features::PixelRect{.size_px = size_px});
        const auto at = [&](glm::uvec2 pixel) {
            const glm::uvec2 on_page = pixel + drawn.from_px;
            return size_t{on_page.y} * size_px.x + on_page.x;
        };
        auto depth = test::Layer::depth(drawn.size_px, [&](glm::uvec2 p) { return surface.depth[at(p)]; });
        auto normal = test::Layer::normals(drawn.size_px, [&](glm::uvec2 p) {
            return surface.depth[at(p)] > 0.0F ? surface.smooth_normal[at(p)] : glm::vec3(0.0F, 1.0F, 0.0F);
        });
        shared::FrameGlobals globals = drawing.globals;
        globals.size_px = drawn.size_px;
        globals.tile_from_px = drawn.from_px;
        auto frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{globals});
        gpu::Graph graph;
        std::optional<PosedSurfaces> surfaces;
        if (needs_behind(style)) {
            surfaces = posed_surfaces(graph);
        }
        const AmbientOcclusion page = add_horizon(graph,
                                                  {.frame = gpu::import_whole(graph, "frame", frame),
                                                   .depth = depth.in(graph),
                                                   .normal = normal.in(graph),
                                                   .surfaces = surfaces,
                                                   .radius_m = radius_m,
                                                   .pixels_per_mm = 1.0F,
                                                   .size_px = drawn.size_px,
                                                   .from_px = drawn.from_px},
                                                  style);
        return test::run_and_read_coverage(graph, page.visibility);
    }

    /// The surfaces of the whole page, with the surfaces behind them.
    [[nodiscard]] PosedSurfaces posed_surfaces(gpu::Graph& graph) const
    {
        const raster::RasterInputs meshes = drawing.raster_inputs(graph);
        const auto batches = frame::solid_batches(drawing.layout, drawing.with_ground);
        raster::View view{.clip_from_anchor = drawing.globals.clip_from_anchor,
                          .size_px = size_px,
                          .path = drawing.path,
                          .tuning = drawing.tuning};
        const gpu::BufferId visibility = raster::add_visibility(graph, "visibility", meshes, batches, view);
        view.cull_back_faces = false;
        view.behind = visibility;
        return {.visibility = visibility,
                .triangles = meshes.triangles,
                .posed_vertices = meshes.posed_vertices,
                .map = std::nullopt,
                .behind = raster::add_visibility(graph, "behind", meshes, batches, view)};
    }

    [[nodiscard]] glm::dvec3 point(size_t pixel) const
    {
        return drawing.point_seen(pixel, surface.depth[pixel]) + drawing.layout.anchor;
    }

    /// Whether a world position is visible to the camera.
    [[nodiscard]] bool sees(const glm::dvec3& place) const
    {
        const glm::dvec4 clip =
            glm::dmat4(drawing.globals.clip_from_anchor) * glm::dvec4(place - drawing.layout.anchor, 1.0);
        const glm::dvec2 at_px = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(size_px);
        if (clip.w <= 0.0 || at_px.x < 0.0 || at_px.y < 0.0 || at_px.x >= size_px.x || at_px.y >= size_px.y) {
            return false;
        }
        const auto pixel = static_cast<size_t>(at_px.y) * size_px.x + static_cast<size_t>(at_px.x);
        const double seen = static_cast<double>(surface.depth[pixel]);
        return clip.z / clip.w > 0.97 * seen;
    }

    Camera camera;
    glm::uvec2 size_px;
    mutable test::Drawing drawing;
    test::SurfacePixels surface;
};

/// Ground truth of a pixel by ray tracing.
struct Truth {
    double open = 1.0;
    double hidden_share = 0.0; ///< share of the occlusion that comes from surfaces invisible to the camera
};

/// Traces `count` cosine-distributed rays; a hit at distance t counts 1 - (t / radius)^2.
[[nodiscard]] inline Truth traced(const SeenPage& page, const test::EmbreeScene& rays, size_t pixel,
                                  double radius_m, int count)
{
    const glm::dvec3 normal(page.surface.smooth_normal[pixel]);
    const glm::dvec3 helper = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(helper, normal));
    const glm::dvec3 other = glm::cross(normal, side);
    const glm::dvec3 from = page.point(pixel) + 1e-4 * radius_m * normal;
    double closed = 0.0;
    double unseen = 0.0;
    for (int i = 0; i < count; ++i) {
        const double radius = std::sqrt((i + 0.5) / count);
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0)) + static_cast<double>(pixel % 977);
        const glm::dvec3 direction = radius * std::cos(angle) * side + radius * std::sin(angle) * other +
                                     std::sqrt(1.0 - radius * radius) * normal;
        if (const auto hit = rays.first_hit(from, direction, radius_m)) {
            const double share = hit->distance_m / radius_m;
            closed += 1.0 - share * share;
            unseen += page.sees(from + hit->distance_m * direction) ? 0.0 : 1.0 - share * share;
        }
    }
    return {.open = 1.0 - closed / count, .hidden_share = closed > 0.0 ? unseen / closed : 0.0};
}

} // namespace estampe::occlusion
