// SPDX-License-Identifier: MIT
#pragma once

// Whether passes bind what their shaders declare.

#include <map>

#include "gpu/graph/graph.hpp"
#include "gpu/shader_bindings.hpp"

namespace estampe::gpu {

/// Compares passes with their shaders, and remembers what each shader declares.
class BindingCheck {
public:
    /// Throws std::logic_error naming pass, shader and binding, what the pass binds and what the shader
    /// declares, unless all that its shaders declare is bound, and both agree in kind, count and texels. The
    /// compiler leaves out declarations that a shader does not use, and shaders that differ little share the
    /// list of one, so a pass may bind more.
    void check(const Graph& graph, const PassRecord& pass);

private:
    [[nodiscard]] const std::map<uint32_t, Binding>& declared_by(const Shader& shader);

    std::map<const uint32_t*, std::map<uint32_t, Binding>> declared_; ///< by a shader's words
};

} // namespace estampe::gpu
