// SPDX-License-Identifier: MIT
#include "techniques/ink/ink.hpp"

#include <tuple>

#include "gpu/imports.hpp"
#include "shaders/ink_lay_comp.hpp"
#include "shaders/ink_measure_comp.hpp"
#include "shaders/ink_source_comp.hpp"
#include "shaders/ink_step_comp.hpp"
#include "shaders/ink_stream_comp.hpp"

namespace estampe::ink {

/// The passes of one picture, and what they hand on.
class Passes {
public:
    Passes(gpu::Graph& graph, Memory& memory, const Plan& plan)
        : graph_(graph), memory_(memory), plan_(plan),
          globals_(gpu::import_whole(graph, "ink", memory.globals_)),
          cells_{gpu::import_whole(graph, "ink/even", memory.cells_[0]),
                 gpu::import_whole(graph, "ink/odd", memory.cells_[1])},
          sums_(gpu::import_whole(graph, "ink/sums", memory.sums_))
    {
    }

    void add_steps(const Inputs& in)
    {
        const gpu::BufferId source = add_source(in);
        for (size_t i = 0; i < plan_.steps.size(); ++i) {
            shared::InkStep step = plan_.steps[i];
            step.sum_before = memory_.sum_now_;
            step.sum_now = step.sum_now < 2 ? 1 - memory_.sum_now_ : step.sum_now;
            add_step(in, source, step, i == 0 ? plan_.first_variant : 0);
            if (step.sum_now < 2) {
                memory_.sum_now_ = step.sum_now;
                add_measure(in.frame);
            }
        }
    }

    [[nodiscard]] Flowing flowing() const
    {
        return {.globals = globals_,
                .cells = cells_.at(memory_.newest_),
                .sums = sums_,
                .sum_now = memory_.sum_now_,
                .variant = plan_.variant & shared::ink_is_around};
    }

private:
    gpu::BufferId add_source(const Inputs& in)
    {
        auto pass = graph_.compute("ink/source", shaders::ink_source_comp);
        pass.uniform(in.frame).uniform(globals_);
        pass.sample(in.hatch, gpu::Sampling::linear).sample(in.lines, gpu::Sampling::linear);
        pass.sample(in.light, gpu::Sampling::linear).sample(in.draw);
        pass.sample(gpu::import_whole(graph_, "ink/mask", memory_.mask_), gpu::Format::r32ui);
        pass.sample(cells_.at(memory_.newest_), gpu::Format::r32ui)
            .sample(in.coordinate)
            .sample(in.footprint)
            .sample(in.depth);
        const glm::uvec2 size = plan_.grid.size;
        const gpu::BufferId source = pass.write(
            graph_.buffer("ink/source", {.size_bytes = sizeof(uint32_t) * uint64_t{size.x} * size.y}));
        const uint32_t strip =
            (plan_.variant & shared::ink_in_strips) != 0 ? uint32_t{shared::ink_strip} : 1U;
        pass.push(plan_.spots)
            .variant(plan_.variant | (plan_.mask.empty() ? 0U : shared::ink_has_mask))
            .dispatch_over(size.x, (size.y + strip - 1) / strip);
        return source;
    }

    /// Around the eye the flow is worked out cell by cell.
    gpu::BufferId add_stream(const shared::InkStep& step)
    {
        const gpu::BufferId map = gpu::import_whole(graph_, "ink/flow map", memory_.map_);
        if (plan_.grid.face_side > 0) {
            return map;
        }
        const glm::uvec2 nodes = plan_.grid.size / shared::ink_node_cells + 4U;
        auto pass = graph_.compute("ink/stream", shaders::ink_stream_comp);
        pass.uniform(globals_).sample(map, gpu::Format::r32f).sample(map, gpu::Format::r32f);
        const gpu::BufferId stream = pass.write(
            graph_.buffer("ink/stream", {.size_bytes = sizeof(float) * uint64_t{nodes.x} * nodes.y}));
        pass.push(step).variant(plan_.variant).dispatch_over(nodes.x, nodes.y);
        return stream;
    }

    void add_step(const Inputs& in, gpu::BufferId source, const shared::InkStep& step, uint32_t more)
    {
        const uint32_t before = memory_.newest_;
        const uint32_t now = 1 - before;
        const uint32_t depth_now = 1 - memory_.newest_depth_;
        const bool keeps_depth = (more & shared::ink_keeps_depth) != 0;
        const gpu::BufferId stream = add_stream(step);
        auto pass = graph_.compute("ink/step", shaders::ink_step_comp);
        pass.uniform(globals_)
            .sample(cells_.at(before), gpu::Format::r32ui)
            .sample(cells_.at(before), gpu::Format::rgba32ui)
            .sample(source, gpu::Format::r32ui);
        pass.sample(stream, gpu::Format::r32f).sample(in.depth);
        // Read in the first step alone, and written there: later ones take the place of what they do not
        // read.
        pass.sample(keeps_depth ? depths(memory_.newest_depth_)
                                : gpu::import_whole(graph_, "ink/flow map", memory_.map_),
                    gpu::Format::r32f);
        pass.sample(in.motion.value_or(in.depth));
        sums_ = pass.modify(sums_);
        cells_.at(now) = pass.write(cells_.at(now));
        std::ignore =
            pass.write(keeps_depth ? depths(depth_now)
                                   : graph_.buffer("ink/no depth", {.size_bytes = sizeof(glm::vec4)}));
        pass.push(step).variant(plan_.variant | more);
        pass.dispatch_over(plan_.grid.size.x, plan_.grid.size.y);
        memory_.newest_ = now;
        memory_.newest_depth_ = keeps_depth ? depth_now : memory_.newest_depth_;
    }

    void add_measure(gpu::BufferId frame)
    {
        auto pass = graph_.compute("ink/measure", shaders::ink_measure_comp);
        pass.uniform(frame).uniform(globals_).sample(cells_.at(memory_.newest_), gpu::Format::r32ui);
        sums_ = pass.modify(sums_);
        const glm::uvec2 measured = (plan_.globals.measured_px + 1U) / 2U;
        pass.push(shared::InkMeasure{.sum_now = memory_.sum_now_})
            .variant(plan_.variant & shared::ink_is_around)
            .dispatch_over(measured.x, (measured.y + shared::ink_block - 1) / shared::ink_block);
    }

    gpu::BufferId depths(uint32_t which)
    {
        return gpu::import_whole(graph_, which == 0 ? "ink/depth even" : "ink/depth odd",
                                 memory_.depths_.at(which));
    }

    gpu::Graph& graph_;
    Memory& memory_;
    const Plan& plan_;
    gpu::BufferId globals_;
    std::array<gpu::BufferId, 2> cells_;
    gpu::BufferId sums_;
};

Flowing add_steps(gpu::Graph& graph, Memory& memory, const Plan& plan, const Inputs& in)
{
    Passes passes(graph, memory, plan);
    if (!plan.steps.empty()) {
        passes.add_steps(in);
    }
    return passes.flowing();
}

Flowing add_standing(gpu::Graph& graph, Memory& memory, const Plan& plan)
{
    return Passes(graph, memory, plan).flowing();
}

gpu::ImageId add_layer(gpu::Graph& graph, const Flowing& ink, gpu::BufferId frame, glm::uvec2 size_px)
{
    auto pass = graph.compute("ink/lay", shaders::ink_lay_comp);
    pass.uniform(frame).uniform(ink.globals).sample(ink.cells, gpu::Format::r32ui).read(ink.sums);
    const gpu::ImageId layer = pass.write(
        graph.image("ink/layer", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba8}));
    pass.push(shared::InkMeasure{.sum_now = ink.sum_now}).variant(ink.variant);
    pass.dispatch_over_page(size_px.x, size_px.y);
    return layer;
}

} // namespace estampe::ink
