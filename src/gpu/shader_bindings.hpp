// SPDX-License-Identifier: MIT
#pragma once

// Reads the bindings that a compiled shader declares from its SPIR-V. Checks that passes bind matching
// resources. Replaces shaders at run time.

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
    other, ///< A kind of binding that no pass can set
};

/// Number type that the shader declares for texels.
enum class TexelKind : uint8_t { none, real, signed_whole, unsigned_whole };

/// One descriptor binding, as a shader declares it or as a pass fills it.
struct Binding {
    BindingKind kind = BindingKind::other;
    /// Number type of the texels; only for texel buffers and sampled images.
    TexelKind texel = TexelKind::none;
    uint32_t image_format = 0; ///< SPIR-V's number of the format; only for storage images
    uint32_t set = 0;
    uint32_t count = 1; ///< Number of array elements; 0 for a runtime-sized array
    bool operator==(const Binding&) const = default;
};

/// Checks that passes bind what their shaders declare. Caches the declared bindings of each shader.
class BindingCheck {
public:
    /// Throws std::logic_error unless the pass binds everything that its shaders declare, with equal resource
    /// kind, array count and texel type. The message names the pass, the shader, the binding, the declared
    /// resource and the bound resource. A pass may bind more than the shaders declare, because the compiler
    /// removes unused declarations and because similar shaders share one list of bindings.
    void check(const Graph& graph, const PassRecord& pass);

private:
    [[nodiscard]] const std::map<uint32_t, Binding>& declared_by(const Shader& shader);

    /// The declared bindings of each shader, by the address of the shader's SPIR-V words.
    std::map<const uint32_t*, std::map<uint32_t, Binding>> declared_;
};

/// Replaces the shader named `name` by `spirv`, for all devices; an empty `spirv` restores the original.
/// Thread-safe. The new SPIR-V stays in memory until the program ends.
void replace_shader(const std::string& name, std::vector<uint32_t> spirv);

/// Returns `shader` or its replacement. If the replacement declares a binding that the original does not
/// declare identically, throws Error once and discards the replacement. Costs nothing while no shader is
/// replaced.
[[nodiscard]] Shader current_build(const Shader& shader);

} // namespace estampe::gpu
