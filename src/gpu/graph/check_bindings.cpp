// SPDX-License-Identifier: MIT
#include "gpu/graph/check_bindings.hpp"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace estampe::gpu {
namespace {

std::vector<const Use*> bound_uses(const PassRecord& pass)
{
    std::vector<const Use*> bound;
    for (const Use& use : pass.uses) {
        if (use.bound) {
            bound.push_back(&use);
        }
    }
    return bound;
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
    const std::vector<const Use*> bound = bound_uses(pass);
    for (const Shader* shader : {pass.shader, pass.draw.vertex, pass.draw.fragment}) {
        if (shader == nullptr) {
            continue;
        }
        for (const auto& [number, declared] : declared_by(*shader)) {
            if (number >= bound.size()) {
                throw std::logic_error(
                    fmt::format("pass '{}' binds {} resources: shader '{}' declares a {} at binding {}",
                                pass.name, bound.size(), shader->name, in_words(declared), number));
            }
            const ResourceRecord& resource = graph.resources()[bound[number]->resource];
            const Binding given = binding_of(*bound[number], resource);
            if (given != declared) {
                throw std::logic_error(fmt::format(
                    "pass '{}' binds '{}' at binding {} as a {}: shader '{}' declares a {}", pass.name,
                    resource.name, number, in_words(given), shader->name, in_words(declared)));
            }
        }
    }
}

} // namespace estampe::gpu
