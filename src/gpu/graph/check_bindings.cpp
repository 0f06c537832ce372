// SPDX-License-Identifier: MIT
#include "gpu/graph/check_bindings.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace estampe::gpu {
namespace {

/// The use at a binding; null where the pass binds fewer.
const Use* bound_at(const PassRecord& pass, uint32_t number)
{
    for (const Use& use : pass.uses) {
        if (use.bound && number-- == 0) {
            return &use;
        }
    }
    return nullptr;
}

} // namespace

const std::map<uint32_t, Binding>& BindingCheck::declared_by(const Shader& shader)
{
    const auto known = declared_.find(shader.spirv.data());
    return known != declared_.end()
               ? known->second
               : declared_.emplace(shader.spirv.data(), bindings_of(shader)).first->second;
}

void BindingCheck::check(const Graph& graph, const PassRecord& pass)
{
    for (const Shader* shader : {pass.shader, pass.draw.vertex, pass.draw.fragment}) {
        if (shader == nullptr) {
            continue;
        }
        for (const auto& [number, declared] : declared_by(*shader)) {
            const Use* const bound = bound_at(pass, number);
            if (bound == nullptr) {
                throw std::logic_error(
                    fmt::format("pass '{}' binds {} resources: shader '{}' declares a {} at binding {}",
                                pass.name, std::ranges::count(pass.uses, true, &Use::bound), shader->name,
                                in_words(declared), number));
            }
            const ResourceRecord& resource = graph.resources()[bound->resource];
            const Binding given = binding_of(*bound, resource);
            if (given != declared) {
                throw std::logic_error(fmt::format(
                    "pass '{}' binds '{}' at binding {} as a {}: shader '{}' declares a {}", pass.name,
                    resource.name, number, in_words(given), shader->name, in_words(declared)));
            }
        }
    }
}

} // namespace estampe::gpu
