// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/scan.hpp"

#include "shaders/scan_comp.hpp"

namespace estampe::contour {

Scanned add_scan(gpu::Graph& graph, const std::string& name, const ScanInputs& in)
{
    auto pass = graph.compute("contour/scan " + name, shaders::scan_comp);
    const gpu::BufferId sizes = in.sizes_are_new ? pass.write(in.sizes) : pass.modify(in.sizes);
    pass.read(in.values);
    const gpu::BufferId before = pass.write(
        graph.buffer("contour/before " + name, list_of(uint64_t{in.value_capacity} + 1, sizeof(uint32_t))));
    pass.push(in.constants).dispatch(1);
    return {sizes, before};
}

} // namespace estampe::contour
