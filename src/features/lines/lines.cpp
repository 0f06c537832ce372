// SPDX-License-Identifier: MIT
#include "features/lines/lines.hpp"

#include <array>

#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::features {
namespace {

constexpr std::array line_classes{contour::LineClass::seen, contour::LineClass::hidden};

} // namespace

void Lines::invalidate(Event event)
{
    switch (event) {
    case Event::scene_replaced:
        meshes_.forget();
        history_.forget();
        break;
    case Event::layout_replaced:
    case Event::triangles_changed:
        meshes_.forget();
        break;
    case Event::ground_replaced:
    case Event::anchor_moved:
    case Event::film_recalled:
        history_.forget();
        break;
    case Event::lights_changed:
        break;
    }
}

void Lines::ensure(gpu::Device& device, const pose::MeshData& layout, const contour::ContourStyle& style)
{
    mesh_ = meshes_.ensure(device, layout, style);
    brush_images_ = brushes_.ensure(device, style);
}

void Lines::save(FilmWriter& writer)
{
    if (!history_.holds_frame(contour::LineClass::seen)) {
        return;
    }
    writer.value(history_.size_px());
    writer.value(history_.clip_from_anchor_before());
    for (const contour::LineClass lines : line_classes) {
        writer.flag(history_.holds_frame(lines));
        if (history_.holds_frame(lines)) {
            contour::LineHistory::Drawn& drawn = history_.before(lines);
            writer.buffers(std::array{&drawn.grid, &drawn.samples});
        }
    }
}

void Lines::load(FilmReader& reader)
{
    const auto size_px = reader.value<glm::uvec2>();
    const auto clip_from_anchor = reader.value<glm::mat4>();
    constexpr uint32_t longest_side_px = 1U << 16U;
    const auto is_side = [](uint32_t side_px) { return side_px > 0 && side_px <= longest_side_px; };
    if (!is_side(size_px.x) || !is_side(size_px.y)) {
        fail_damaged();
    }
    std::array<std::optional<contour::LineHistory::Drawn>, line_classes.size()> drawn;
    for (auto& of_class : drawn) {
        if (reader.flag()) {
            gpu::Buffer grid =
                reader.buffer("line grid", sizeof(glm::uvec2) * contour::grid_cell_count(size_px));
            of_class = {std::move(grid),
                        reader.buffer("drawn samples",
                                      sizeof(shared::DrawnSample) * contour::sample_capacity(size_px))};
        }
    }
    history_.recall(reader.device(), size_px, std::move(drawn), clip_from_anchor);
}

} // namespace estampe::features
