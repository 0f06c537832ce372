// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/scan/scan.hpp"

#include "gpu/transfers.hpp"
#include "shaders/scan_comp.hpp"
#include "shaders/scan_spread_comp.hpp"
#include "shaders/scan_sums_comp.hpp"

namespace estampe::contour {
namespace {

Scanned add_spread_scan(gpu::Graph& graph, const gpu::Name& name, const ScanInputs& in)
{
    const gpu::BufferId sizes_before =
        in.sizes_are_new
            ? gpu::add_zeros(graph, "contour/no sizes", shared::list_count * sizeof(shared::ListSize))
            : in.sizes;
    auto summing = graph.compute("contour/sum " + name, shaders::scan_sums_comp);
    summing.read(sizes_before).read(in.values);
    const gpu::BufferId sums = summing.write(
        graph.buffer("contour/sums " + name, list_of(shared::scan_parts + 1, sizeof(uint32_t))));
    summing.push(in.constants).dispatch(shared::scan_parts);

    auto pass = graph.compute("contour/scan " + name, shaders::scan_spread_comp);
    const gpu::BufferId sizes = in.sizes_are_new ? pass.write(in.sizes) : pass.modify(in.sizes);
    pass.read(in.values).read(sums);
    const gpu::BufferId before = pass.write(
        graph.buffer("contour/before " + name, list_of(uint64_t{in.value_capacity} + 1, sizeof(uint32_t))));
    pass.push(in.constants).dispatch(shared::scan_parts);
    return {sizes, before};
}

} // namespace

Scanned add_scan(gpu::Graph& graph, const gpu::Name& name, const ScanInputs& in)
{
    if (in.is_spread) {
        return add_spread_scan(graph, name, in);
    }
    auto pass = graph.compute("contour/scan " + name, shaders::scan_comp);
    const gpu::BufferId sizes = in.sizes_are_new ? pass.write(in.sizes) : pass.modify(in.sizes);
    pass.read(in.values);
    const gpu::BufferId before = pass.write(
        graph.buffer("contour/before " + name, list_of(uint64_t{in.value_capacity} + 1, sizeof(uint32_t))));
    pass.push(in.constants).dispatch(1);
    return {sizes, before};
}

} // namespace estampe::contour
