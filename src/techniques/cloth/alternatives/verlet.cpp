// SPDX-License-Identifier: MIT
// The Verlet solver of cloth: one Verlet step, and then relaxations of all links. Zanuttini, "Recherches en
// rendu non réaliste temps réel", Université Paris 8, 2008, chapter 7.
#include "techniques/cloth/cloth.hpp"

#include "shaders/cloth_relax_comp.hpp"

namespace estampe::cloth {

void Cloths::add_relaxations(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step)
{
    for (uint32_t i = 0; i < step.small_steps; ++i) {
        add_pass_of_step(graph, handles, kind, step, "cloth/relax", shaders::cloth_relax_comp, i);
    }
}

} // namespace estampe::cloth
