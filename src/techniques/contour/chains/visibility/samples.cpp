// SPDX-License-Identifier: MIT
#include "shaders/divide_comp.hpp"
#include "shaders/sample_comp.hpp"
#include "shaders/settle_comp.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {

ChainSamples add_samples(gpu::Graph& graph, const ChainInputs& in, const Chains& chains)
{
    const shared::ChainConstants& constants = chains.constants;
    const uint32_t slots_most = constants.segment_capacity + constants.feature_chain_count;
    const uint32_t samples_most = constants.sample_capacity;
    const Scanned lengths = add_scan(graph, "lengths",
                                     {.sizes = chains.sizes,
                                      .values = chains.lengths,
                                      .value_capacity = constants.point_capacity,
                                      .is_spread = in.execution.spreads_scans(),
                                      .constants = scan_of_list(shared::list_points, shared::no_list, 0)});

    auto divide = graph.compute("contour/divide", shaders::divide_comp);
    divide.read(lengths.sizes).sample(chains.points_before, gpu::Format::r32ui);
    divide.read(chains.flags_of_slot).sample(lengths.before, gpu::Format::r32ui);
    const gpu::BufferId samples_of_slot =
        divide.write(graph.buffer("contour/samples of slot", list_of(slots_most, sizeof(uint32_t))));
    const gpu::BufferId no_rotation =
        divide.write(graph.buffer("contour/rotation", list_of(slots_most, sizeof(uint32_t))));
    divide.push(constants).dispatch_indirect(lengths.sizes, indirect_offset(shared::list_slots));
    const Scanned divided =
        add_scan(graph, "samples",
                 {.sizes = lengths.sizes,
                  .values = samples_of_slot,
                  .value_capacity = slots_most,
                  .is_spread = in.execution.spreads_scans(),
                  .constants = scan_of_list(shared::list_slots, shared::list_samples, samples_most)});

    const uint64_t per_sample = indirect_offset(shared::list_samples);
    auto sample = graph.compute("contour/sample", shaders::sample_comp);
    sample.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices).read(in.visibility);
    sample.read(divided.sizes);
    for (const gpu::BufferId before : {divided.before, chains.points_before, lengths.before}) {
        sample.sample(before, gpu::Format::r32ui);
    }
    sample.sample(chains.points);
    const gpu::BufferId samples =
        sample.write(graph.buffer("contour/samples", list_of(samples_most, sizeof(shared::LineSample))));
    sample.push(constants).dispatch_indirect(divided.sizes, per_sample);

    auto settle = graph.compute("contour/settle", shaders::settle_comp);
    settle.read(divided.sizes).sample(divided.before, gpu::Format::r32ui);
    settle.read(chains.flags_of_slot).sample(samples);
    const gpu::BufferId states =
        settle.write(graph.buffer("contour/states", list_of(samples_most, sizeof(uint32_t))));
    const gpu::BufferId rotation = settle.modify(no_rotation);
    settle.dispatch_indirect(divided.sizes, per_sample);

    return {.sizes = divided.sizes,
            .lengths_before = lengths.before,
            .samples_before = divided.before,
            .flags_of_slot = chains.flags_of_slot,
            .samples = samples,
            .states = states,
            .rotation = rotation,
            .execution = in.execution};
}

} // namespace estampe::contour
