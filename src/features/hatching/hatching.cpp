// SPDX-License-Identifier: MIT
#include "features/hatching/hatching.hpp"

#include "features/hatching/form_strokes.hpp"
#include "gpu/upload.hpp"

namespace estampe::features {

void Hatching::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::layout_replaced) {
        kind_of_draw_.clear();
    }
}

void Hatching::ensure_strokes(gpu::Device& device, const pose::MeshData& layout, const StrokePlan& strokes)
{
    if (kind_of_draw_ == strokes.kind_of_draw) {
        return;
    }
    kinds_ = gpu::upload_buffer(device, "stroke kinds", strokes.kind_of_draw);
    form_coordinates_ =
        gpu::upload_buffer(device, "form coordinates",
                           strokes.has(shared::strokes_form) ? features::form_coordinates(layout, strokes)
                                                             : std::vector<glm::vec2>());
    kind_of_draw_ = strokes.kind_of_draw;
}

} // namespace estampe::features
