// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/history/line_history.hpp"

#include <algorithm>

#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

void LineHistory::begin_frame(gpu::Device& device, glm::uvec2 size_px, bool continues, bool has_hidden)
{
    for (const LineClass lines : {LineClass::seen, LineClass::hidden}) {
        Memory& memory = memories_.at(static_cast<size_t>(lines));
        memory.is_kept = lines == LineClass::seen || has_hidden;
        if (memory.is_kept && memory.size_px != size_px) {
            for (Drawn& drawn : memory.drawn) {
                drawn.grid = gpu::Buffer(device, "line grid", sizeof(glm::uvec2) * grid_cell_count(size_px),
                                         gpu::MemoryUse::device);
                drawn.samples = gpu::Buffer(device, "drawn samples",
                                            sizeof(shared::DrawnSample) * sample_capacity(size_px),
                                            gpu::MemoryUse::device);
            }
            memory.size_px = size_px;
            memory.holds_frame = false;
        }
        memory.holds_frame = memory.holds_frame && continues;
    }
}

void LineHistory::end_frame(const glm::mat4& clip_from_anchor)
{
    clip_from_anchor_ = clip_from_anchor;
    now_ = 1 - now_;
    for (Memory& memory : memories_) {
        memory.holds_frame = memory.is_kept;
    }
}

void LineHistory::recall(gpu::Device& device, glm::uvec2 size_px, std::array<std::optional<Drawn>, 2> drawn,
                         const glm::mat4& clip_from_anchor)
{
    forget();
    begin_frame(device, size_px, false, drawn.at(static_cast<size_t>(LineClass::hidden)).has_value());
    for (size_t i = 0; i < memories_.size(); ++i) {
        if (drawn.at(i)) {
            memories_.at(i).drawn.at(1 - now_) = std::move(*drawn.at(i));
            memories_.at(i).holds_frame = true;
        }
    }
    clip_from_anchor_ = clip_from_anchor;
}

void LineHistory::forget()
{
    for (Memory& memory : memories_) {
        memory.holds_frame = false;
    }
}

uint32_t grid_cell_count(glm::uvec2 size_px)
{
    const glm::uvec2 cells = (size_px + shared::grid_cell_px - 1U) / shared::grid_cell_px;
    return cells.x * cells.y;
}

uint32_t sample_capacity(glm::uvec2 size_px)
{
    // Lines that are hidden take room as well: with a temple before the eye 0.8 samples a pixel of 400 x 300,
    // and half as many a pixel where the page is twice as wide.
    constexpr uint32_t crowded_scene = 262144;
    const uint32_t pixels = size_px.x * size_px.y;
    return std::max(pixels / 4, std::min(2 * pixels, crowded_scene));
}

} // namespace estampe::contour
