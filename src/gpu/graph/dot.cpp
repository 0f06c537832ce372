// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "gpu/graph/compile.hpp"

namespace estampe::gpu {

namespace {

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        out += c;
    }
    return out;
}

std::string resource_node(const Graph& graph, const CompiledGraph& compiled, uint32_t index, uint32_t version)
{
    const ResourceRecord& resource = graph.resources()[index];
    std::string label = escaped(resource.name);
    if (resource.newest_version > 1)
        label += fmt::format(" v{}", version);
    if (resource.is_image)
        label += fmt::format("\\n{} x {}", resource.image.width, resource.image.height);
    else
        label += fmt::format("\\n{} bytes", resource.buffer.size_bytes);
    if (compiled.slot_of_resource[index] != UINT32_MAX)
        label += fmt::format(", slot {}", compiled.slot_of_resource[index]);
    const bool is_lasting = resource.exported || resource.is_imported();
    return fmt::format("    r{}_{} [shape=ellipse, label=\"{}\"{}];\n", index, version, label,
                       is_lasting ? ", penwidth=2" : "");
}

} // namespace

std::string to_dot(const Graph& graph, const CompiledGraph& compiled)
{
    std::string nodes;
    std::string edges;
    std::set<std::pair<uint32_t, uint32_t>> versions;
    for (uint32_t i = 0; i < graph.passes().size(); ++i) {
        const PassRecord& pass = graph.passes()[i];
        const auto kept = std::ranges::find(compiled.passes, i, &CompiledPass::pass);
        if (kept == compiled.passes.end())
            nodes += fmt::format("    p{} [shape=box, style=dashed, label=\"{}\"];\n", i, escaped(pass.name));
        else
            nodes += fmt::format("    p{} [shape=box, label=\"{}\\n{} barriers\"];\n", i, escaped(pass.name),
                                 kept->barriers.size());
        for (const Use& use : pass.uses) {
            // Version 0 of a transient has no content, so nothing flows from it.
            if (is_read(use.access) && (use.version > 0 || !is_write(use.access))) {
                edges += fmt::format("    r{}_{} -> p{} [label=\"{}\"];\n", use.resource, use.version, i,
                                     name_of(use.access));
                versions.emplace(use.resource, use.version);
            }
            if (is_write(use.access)) {
                edges += fmt::format("    p{} -> r{}_{} [label=\"{}\"];\n", i, use.resource, use.version + 1,
                                     name_of(use.access));
                versions.emplace(use.resource, use.version + 1);
            }
        }
    }
    for (const auto& [resource, version] : versions)
        nodes += resource_node(graph, compiled, resource, version);
    return fmt::format("digraph frame {{\n    rankdir=LR;\n{}{}}}\n", nodes, edges);
}

} // namespace estampe::gpu
