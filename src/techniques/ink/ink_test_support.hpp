// SPDX-License-Identifier: MIT
#pragma once

// Ink on pages that tests paint, picture by picture.

#include <cmath>
#include <functional>
#include <vector>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/ink/ink.hpp"

namespace estampe::ink {

/// Clear water: ink does not change unless a test sets a style.
inline InkStyle still_ink()
{
    InkStyle style;
    style.enabled = true;
    style.amount_per_s = 0.0F;
    style.wind_mm_per_s = 0.0F;
    style.swirl_mm_per_s = 0.0F;
    style.life_s = 1e9F;
    style.stain_s = 1e9F;
    style.soak = 0.0F;
    style.budget = 1.0F;
    style.cell_mm = 1.0F;
    style.edge = 0.0F;
    style.sharpness = 0.0F;
    return style;
}

/// A page on which a millimetre, a pixel and a cell are equal.
class Bench {
public:
    explicit Bench(glm::uvec2 size_px,
                   const Camera& seen_by = {.eye = {0.0, 0.0, 4.0}, .target = {0.0, 0.0, 0.0}})
        : size(size_px), camera(seen_by)
    {
    }

    [[nodiscard]] Page page() const
    {
        return {.size_px = size,
                .pixels_per_mm = 1.0F,
                .window_min_mm = glm::vec2(0.0F),
                .window_max_mm = glm::vec2(size),
                .rad_per_mm = static_cast<float>(2.0 * std::tan(0.5 * camera.vertical_fov_rad) / size.y)};
    }

    [[nodiscard]] shared::FrameGlobals globals() const
    {
        Bounds bounds;
        bounds.extend(glm::dvec3(-2.0));
        bounds.extend(glm::dvec3(2.0));
        return features::frame_globals(camera, bounds, glm::dvec3(0.0),
                                       {.size_px = size, .page_height_mm = static_cast<double>(size.y)});
    }

    /// Sets the wet and dry ink of the cells at a time.
    void fill(const InkStyle& style, const std::function<glm::vec2(glm::uvec2)>& paint, double time_s = 0.0)
    {
        const Grid grid = grid_of(style, page());
        std::vector<uint32_t> cells;
        for (uint32_t y = 0; y < grid.size.y; ++y) {
            for (uint32_t x = 0; x < grid.size.x; ++x) {
                cells.push_back(glm::packUnorm2x16(paint({x, y})));
            }
        }
        auto& device = test::shared_device();
        memory.recall(device, {.grid = grid, .time_s = time_s, .sum_now = 0},
                      {gpu::upload_buffer(device, "cells", cells),
                       gpu::upload_buffer(device, "depths",
                                          std::vector<float>(Memory::kept_bytes(grid)[1] / sizeof(float))),
                       gpu::upload_buffer(device, "sums", std::vector<uint32_t>(4))});
    }

    /// Advances the ink to a time.
    void advance(const InkStyle& style, double time_s, const View& view = {},
                 const std::vector<shared::InkZone>& zones = {})
    {
        plan = plan_of(style, page(), time_of(style, time_s, memory.time_s()), view, zones);
        for (const PageBlast& blast : blasts) {
            add_blast(plan, blast);
        }
        auto& device = test::shared_device();
        memory.ensure(device, style, plan);
        if (!painted_ || !keeps_layers) {
            painted_.emplace(paint());
        }
        auto frame = gpu::upload_buffer(device, "frame", std::vector{globals()});
        gpu::Graph graph;
        const gpu::BufferId frame_id = gpu::import_whole(graph, "frame", frame);
        const Flowing flowing = add_steps(graph, memory, plan,
                                          {.frame = frame_id,
                                           .hatch = painted_->hatch.in(graph),
                                           .lines = painted_->blank.in(graph),
                                           .light = painted_->blank.in(graph),
                                           .draw = painted_->draw.in(graph),
                                           .depth = painted_->depth.in(graph),
                                           .coordinate = painted_->coordinate.in(graph),
                                           .footprint = painted_->footprint.in(graph),
                                           .motion = painted_->motion.in(graph)});
        const gpu::ImageId layer = add_layer(graph, flowing, frame_id, size);
        layer_bytes = test::run_and_read_as<uint32_t>(graph, layer);
        memory.end_picture(plan);
    }

    /// Wet and dry ink, cell by cell.
    [[nodiscard]] std::vector<glm::vec2> cells()
    {
        gpu::Graph graph;
        const auto words = test::run_and_read_as<uint32_t>(
            graph, gpu::import_whole(graph, "cells", *memory.kept_buffers()[0]));
        std::vector<glm::vec2> cells;
        for (const uint32_t word : words) {
            cells.push_back(glm::unpackUnorm2x16(word));
        }
        return cells;
    }

    /// Coverage of a pixel of the page.
    [[nodiscard]] float cover(size_t pixel) const
    {
        return static_cast<float>(layer_bytes.at(pixel) >> 24U) / 255.0F;
    }

    [[nodiscard]] double mean_cover() const
    {
        double sum = 0.0;
        for (size_t i = 0; i < layer_bytes.size(); ++i) {
            sum += static_cast<double>(cover(i));
        }
        return sum / static_cast<double>(layer_bytes.size());
    }

    /// Mean position of the ink on the page, in pixels.
    [[nodiscard]] glm::dvec2 middle_px() const
    {
        glm::dvec2 sum(0.0);
        double weight = 1e-12;
        for (size_t i = 0; i < layer_bytes.size(); ++i) {
            const auto here = static_cast<double>(cover(i));
            sum += here * (glm::dvec2(i % size.x, i / size.x) + 0.5);
            weight += here;
        }
        return sum / weight;
    }

    glm::uvec2 size;
    Camera camera;
    std::vector<PageBlast> blasts;
    bool keeps_layers = false; ///< keeps the layers that were painted first
    test::Painter<float> hatch_at = [](glm::uvec2) { return 0.0F; };
    test::Painter<float> depth_at = [](glm::uvec2) { return 0.0F; };
    test::Painter<glm::vec4> motion_at = [](glm::uvec2) { return glm::vec4(0.0F); };
    test::Painter<glm::vec4> coordinate_at = [](glm::uvec2 pixel) { return glm::vec4(pixel, 0.0F, 0.0F); };
    Memory memory;
    Plan plan;
    std::vector<uint32_t> layer_bytes;

private:
    struct Layers {
        test::Layer hatch;
        test::Layer blank;
        test::Layer draw;
        test::Layer depth;
        test::Layer motion;
        test::Layer coordinate;
        test::Layer footprint;
    };

    [[nodiscard]] Layers paint() const
    {
        return {.hatch = test::Layer::coverage(size, hatch_at),
                .blank = test::Layer::root_color(size, [](glm::uvec2) { return glm::vec4(0.0F); }),
                .draw = test::Layer::words(size, [](glm::uvec2) { return 1U; }),
                .depth = test::Layer::depth(size, depth_at),
                .motion = test::Layer::places(size, motion_at),
                .coordinate = test::Layer::places(size, coordinate_at),
                .footprint = test::Layer::footprints(size, [](glm::uvec2) {
                    return std::pair(glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 1.0F, 0.0F));
                })};
    }

    std::optional<Layers> painted_;
};

} // namespace estampe::ink
