// SPDX-License-Identifier: MIT
#pragma once

// Surfaces that a test sets pixel by pixel, and strokes drawn over them.

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "techniques/hatch/hatch.hpp"

namespace estampe::test {

/// Surface at a pixel: the coordinate that strokes follow, and its change to the right and down.
struct Patch {
    glm::vec3 coordinate{0.0F};
    glm::vec3 dx{0.0F};
    glm::vec3 dy{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    bool seen = true;
};

using Surface = std::function<Patch(glm::dvec2 position_px)>;

/// Blank ink for lines to draw on, and a list of all tiles.
class PaperToInk {
public:
    explicit PaperToInk(glm::uvec2 size_px)
        : blank_(Layer::coverage(size_px, [](glm::uvec2) { return 0.0F; }))
    {
        const glm::uvec2 tiles = (size_px + 7U) / 8U;
        std::vector<uint32_t> list{tiles.x * tiles.y, 1, 1, 0};
        for (uint32_t i = 0; i < tiles.x * tiles.y; ++i) {
            list.push_back(i / tiles.x << 16U | i % tiles.x);
            list.push_back(1);
        }
        tiles_ = gpu::upload_buffer(shared_device(), "tiles", list);
    }

    hatch::Darkness in(gpu::Graph& graph, gpu::ImageId darkness)
    {
        return {darkness, blank_.in(graph), gpu::import_whole(graph, "tiles", tiles_)};
    }

private:
    Layer blank_;
    gpu::Buffer tiles_;
};

/// The inputs that lines and maps read. A pixel is a millimetre.
inline hatch::HatchInputs stroke_inputs(gpu::Graph& graph, glm::uvec2 size_px, Layer& draw, Layer& normal,
                                        Layer& coordinate, Layer& footprint)
{
    const gpu::ImageId unread = graph.image("unread", {.width = 1, .height = 1});
    return {.frame = graph.buffer("unread", {.size_bytes = 16}),
            .draw = draw.in(graph),
            .depth = unread,
            .normal = normal.in(graph),
            .color = unread,
            .coordinate = coordinate.in(graph),
            .footprint = footprint.in(graph),
            .light = unread,
            .screen = unread,
            .tone = {},
            .pixels_per_mm = 1.0F,
            .size_px = size_px};
}

/// Draws strokes for combinations of a surface and a darkness, which can be set independently.
class Canvas {
public:
    Canvas(glm::uvec2 size_px, uint32_t kind)
        : size_px_(size_px), kind_(kind),
          draw_(Layer::words(size_px, [&](glm::uvec2) { return kind << 26U | 1U; })),
          darkness_(Layer::coverage(size_px, [](glm::uvec2) { return 0.0F; })),
          normal_(Layer::normals(size_px, [](glm::uvec2) { return glm::vec3(0, 0, 1); })),
          coordinate_(Layer::places({1, 1}, [](glm::uvec2) { return glm::vec4(0.0F); })),
          footprint_(Layer::footprints(
              {1, 1}, [](glm::uvec2) { return std::pair(glm::vec3(0.0F), glm::vec3(0.0F)); }))
    {
    }

    /// Sets the pixels that see the surface; others are blank paper.
    void paint_seen(const Painter<bool>& seen)
    {
        draw_ = Layer::words(size_px_, [&](glm::uvec2 p) { return seen(p) ? kind_ << 26U | 1U : 0U; });
    }

    void paint_darkness(const Painter<float>& darkness) { darkness_ = Layer::coverage(size_px_, darkness); }

    void paint_surface(const Surface& surface)
    {
        const auto at = [&](glm::uvec2 pixel) { return surface(glm::dvec2(pixel) + 0.5); };
        coordinate_ =
            Layer::places(size_px_, [&](glm::uvec2 pixel) { return glm::vec4(at(pixel).coordinate, 0.0F); });
        footprint_ = Layer::footprints(size_px_, [&](glm::uvec2 pixel) {
            const Patch patch = at(pixel);
            return std::pair(patch.dx, patch.dy);
        });
    }

    void paint_normals(const Painter<glm::vec3>& normal) { normal_ = Layer::normals(size_px_, normal); }

    std::vector<float> ink(const hatch::HatchStyle& style) { return ink(style, nullptr); }

    /// Ink of the strokes of `map`, or of lines if it is null.
    std::vector<float> ink(const hatch::HatchStyle& style, hatch::MapImages* map)
    {
        gpu::Graph graph;
        hatch::HatchInputs in = stroke_inputs(graph, size_px_, draw_, normal_, coordinate_, footprint_);
        const gpu::ImageId darkness = darkness_.in(graph);
        PaperToInk paper(size_px_);
        if (map == nullptr) {
            return run_and_read_coverage(graph,
                                         hatch::add_lines(graph, in, paper.in(graph, darkness), style));
        }
        in.map = hatch::import_map(graph, *map);
        return run_and_read_coverage(graph, hatch::add_map(graph, in, paper.in(graph, darkness), style));
    }

private:
    glm::uvec2 size_px_;
    uint32_t kind_;
    Layer draw_, darkness_, normal_, coordinate_, footprint_;
};

/// A pen of 1.6 pixels that otherwise has the default settings.
inline hatch::HatchStyle pen()
{
    return {.width_mm = 1.6F,
            .wobble_mm = 1.0F,
            .gap_mm = 3.0F,
            .taper_mm = 12.0F,
            .length_mm = 70.0F,
            .black_above = 2.0F};
}

inline Surface flat_patch(double unit_per_px)
{
    return [=](glm::dvec2 p) {
        const auto g = static_cast<float>(unit_per_px);
        return Patch{.coordinate = glm::vec3(p * unit_per_px, 0.0), .dx = {g, 0, 0}, .dy = {0, g, 0}};
    };
}

} // namespace estampe::test
