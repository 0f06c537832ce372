// SPDX-License-Identifier: MIT
// Vertex block descent: particles of sheets sorted by colour (a set of particles without links between them),
// and the sweeps over the colours. Chen, Liu, Yang and Yuksel, "Vertex Block Descent", SIGGRAPH 2024.
#include "techniques/cloth/cloth.hpp"

#include "shaders/cloth_descend_comp.hpp"

namespace estampe::cloth {

void Cloths::append_colours(Kind& kind, std::vector<uint32_t>& groups) const
{
    for (size_t colour = 0;; ++colour) {
        const size_t first = groups.size() / 2;
        bool is_any = false;
        for (uint32_t sheet = 0; sheet < records_.size(); ++sheet) {
            if (variant_of(sheet) != kind.variant || colour >= colours_[sheet].size()) {
                continue;
            }
            is_any = true;
            const glm::uvec2 span = colours_[sheet][colour];
            for (uint32_t i = 0; i < span.y; i += shared::cloth_group) {
                groups.insert(groups.end(), {sheet, span.x + i});
            }
        }
        if (!is_any) {
            return;
        }
        kind.colours.emplace_back(first, groups.size() / 2 - first);
    }
}

void Cloths::add_descents(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step)
{
    for (uint32_t i = 0; i < step.small_steps; ++i) {
        for (uint32_t sweep = 0; sweep < kind.solver->sweeps; ++sweep) {
            for (const glm::uvec2& colour : kind.colours) {
                auto pass = graph.compute("cloth/descend", shaders::cloth_descend_comp);
                bind_common(graph, pass, handles, kind.run, sheet_of_group_);
                pass.read(handles.places).read(handles.speeds).read(handles.pushes);
                handles.predicted.at(i % 2) = pass.modify(handles.predicted.at(i % 2));
                pass.sample(gpu::import_whole(graph, "cloth/by colour", by_colour_), gpu::Format::r32ui)
                    .read(step.awake)
                    .sample(handles.torn, gpu::Format::rg32ui);
                pass.variant(kind.variant)
                    .push(shared::ClothMoment{.step = step.number, .small_step = i, .first_group = colour.x})
                    .dispatch(colour.y);
            }
        }
        add_small_step(graph, handles, kind, step, i);
    }
}

} // namespace estampe::cloth
