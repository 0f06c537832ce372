// SPDX-License-Identifier: MIT
// The table of cloth solvers, and the passes of a simulation step of the default solver.
#include "techniques/cloth/cloth.hpp"

#include "shaders/cloth_step_comp.hpp"

namespace estampe::cloth {

const Cloths::Solver& Cloths::solver_named(ClothSolver name)
{
    static constexpr std::array solvers{
        Solver{.takes_small_sheets = true, .lowers_rigidity = true, .add_step = &Cloths::add_small_steps},
        Solver{.relaxations = 10, .add_step = &Cloths::add_relaxations},
        Solver{.bits = shared::cloth_bit_descent, .sweeps = 4, .add_step = &Cloths::add_descents}};
    return solvers.at(name == ClothSolver::verlet ? 1 : name == ClothSolver::block_descent ? 2 : 0);
}

void Cloths::add_pass_of_step(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step,
                              std::string_view name, const gpu::Shader& shader, uint32_t small_step)
{
    const uint32_t newest = small_step % 2;
    auto pass = graph.compute(name, shader);
    bind_common(graph, pass, handles, kind.run, sheet_of_group_);
    handles.places = pass.modify(handles.places);
    handles.speeds = pass.modify(handles.speeds);
    pass.read(handles.pushes).sample(handles.predicted.at(newest), gpu::Format::rgba32f);
    handles.predicted.at(1 - newest) = pass.modify(handles.predicted.at(1 - newest));
    pass.sample(handles.near).read(step.awake).read(step.began).read(step.met);
    pass.sample(handles.torn, gpu::Format::rg32ui);
    const bool is_last = small_step + 1 == step.small_steps;
    pass.variant(kind.variant | (is_last ? shared::cloth_bit_last : 0U))
        .push(shared::ClothMoment{
            .step = step.number, .small_step = small_step, .first_group = kind.first_group});
    pass.dispatch(kind.group_count);
}

void Cloths::add_small_step(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step,
                            uint32_t small_step)
{
    add_pass_of_step(graph, handles, kind, step, "cloth/step", shaders::cloth_step_comp, small_step);
}

void Cloths::add_small_steps(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step)
{
    for (uint32_t i = 0; i < step.small_steps; ++i) {
        add_small_step(graph, handles, kind, step, i);
    }
}

} // namespace estampe::cloth
