// SPDX-License-Identifier: MIT
#include "techniques/paper/paper.hpp"

#include <algorithm>

#include "gpu/resources.hpp"
#include "shaders/compose_comp.hpp"
#include "shaders/develop_comp.hpp"
#include "techniques/paper/paper.glsl.h"

namespace estampe::paper {

Window window_of(const PaperStyle& style, float width_mm)
{
    const glm::vec2 page_mm(width_mm, style.height_mm);
    const float margin_mm = std::min(style.margin_mm, std::min(page_mm.x, page_mm.y) / 3.0F);
    return {glm::vec2(margin_mm), page_mm - margin_mm};
}

gpu::ImageId add_compose(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style)
{
    auto pass = graph.compute("compose", shaders::compose_comp);
    pass.uniform(in.frame).sample(in.wash).sample(in.hatch).sample(in.lines).sample(in.sky_ink);
    // Unread, the light's memory is free for others by now.
    const bool tinted = style.ink_tint > 0.0F;
    pass.sample(tinted ? in.light : in.wash)
        .variant((tinted ? shared::compose_has_tint : 0U) | (in.has_sky ? shared::compose_has_sky : 0U) |
                 (style.margin_mm > 0.0F || style.border_mm > 0.0F ? shared::compose_has_margin : 0U) |
                 (style.ink_grain > 0.0F ? shared::compose_has_grain : 0U));
    const Window window = window_of(style, style.height_mm * static_cast<float>(in.size_px.x) /
                                               static_cast<float>(in.size_px.y));
    const gpu::ImageId picture = pass.write(graph.image(
        "picture", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    pass.push(shared::PaperConstants{.paper_color = style.color,
                                     .grain = style.grain,
                                     .ink_color = style.ink,
                                     .granulation = style.granulation,
                                     .ink_break = style.ink_break,
                                     .ink_tint = style.ink_tint,
                                     .seed = static_cast<uint32_t>(style.seed),
                                     .ink_grain = style.ink_grain,
                                     .border_mm = style.border_mm,
                                     .window_min_mm = window.min_mm,
                                     .window_max_mm = window.max_mm})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return picture;
}

gpu::ImageId import_sums(gpu::Graph& graph, gpu::Image& sums, const Accumulation& accumulation)
{
    return graph.import_image("sums", sums, sums.desc(),
                              accumulation.sample_index == 0 ? gpu::Layout::undefined : gpu::Layout::general);
}

Developed add_develop(gpu::Graph& graph, gpu::ImageId picture, gpu::ImageId sums, gpu::BufferId pixels,
                      glm::uvec2 size_px, const Accumulation& accumulation)
{
    auto pass = graph.compute("develop", shaders::develop_comp);
    pass.sample(picture);
    const gpu::ImageId added = pass.modify(sums);
    const gpu::BufferId written = pass.write(pixels);
    const bool is_last = accumulation.sample_index + 1 == accumulation.sample_count;
    pass.variant((accumulation.sample_count > 1 ? shared::develop_has_samples : 0U) |
                 (is_last ? shared::develop_is_last : 0U));
    pass.push(shared::DevelopConstants{
                  .width = size_px.x, .height = size_px.y, .sample_index = accumulation.sample_index})
        .dispatch_over(size_px.x, size_px.y);
    return {added, written};
}

} // namespace estampe::paper
