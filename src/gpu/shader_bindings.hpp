// SPDX-License-Identifier: MIT
#pragma once

// Reads the bindings that a compiled shader declares from its SPIR-V, checks that passes match them, and
// replaces shaders at run time.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

enum class BindingKind : uint8_t {
    storage_buffer,
    uniform_buffer,
    texel_buffer,
    sampled_image,
    storage_image,
    other, ///< Cannot be bound by a pass
};

/// Number type of the texels in the shader.
enum class TexelKind : uint8_t { none, real, signed_whole, unsigned_whole };

/// One binding, as declared by a shader or as filled by a pass.
struct Binding {
    BindingKind kind = BindingKind::other;
    TexelKind texel = TexelKind::none; ///< Only for texel buffers and sampled images
    uint32_t image_format = 0;         ///< SPIR-V's format number; only for storage images
    uint32_t set = 0;
    uint32_t count = 1; ///< Length of an array; 0 for a runtime-sized array
    bool operator==(const Binding&) const = default;
};

/// Checks passes against their shaders. Caches what each shader declares.
class BindingCheck {
public:
    /// Throws std::logic_error unless the pass binds everything that its shaders declare, with the same
    /// kind, count and texels. The message names pass, shader, binding and both sides. A pass may bind more,
    /// because the compiler removes unused declarations and similar shaders share one list of bindings.
    void check(const Graph& graph, const PassRecord& pass);

private:
    [[nodiscard]] const std::map<uint32_t, Binding>& declared_by(const Shader& shader);

    /// By the address of a shader's words.
    std::map<const uint32_t*, std::map<uint32_t, Binding>> declared_;
};

/// From now on all devices use these words in place of the shader named `name`; empty words restore the
/// original. Thread-safe. The words stay in memory until the program ends.
void replace_shader(const std::string& name, std::vector<uint32_t> spirv);

/// Returns the shader or its replacement. Throws Error once, and drops the replacement, if it declares a
/// binding that the original does not declare identically. Cost: none while nothing is replaced.
[[nodiscard]] Shader current_build(const Shader& shader);

} // namespace estampe::gpu
