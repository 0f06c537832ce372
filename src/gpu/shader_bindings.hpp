// SPDX-License-Identifier: MIT
#pragma once

// What a compiled shader declares at its bindings, read from its SPIR-V; whether passes bind that, and
// shaders that replace it may stand there.

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
    other, ///< nothing that a pass can bind
};

/// What texels are to the shader.
enum class TexelKind : uint8_t { none, real, signed_whole, unsigned_whole };

/// One binding, as a shader declares it or as a pass fills it.
struct Binding {
    BindingKind kind = BindingKind::other;
    TexelKind texel = TexelKind::none; ///< of texel buffers and sampled images
    uint32_t image_format = 0;         ///< of storage images, as SPIR-V numbers formats
    uint32_t set = 0;
    uint32_t count = 1; ///< elements of an array; 0 for one without a size
    bool operator==(const Binding&) const = default;
};

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

/// From now on all devices draw with these words in place of the shader of that name; empty: with its own
/// again. Any thread may call it. The words stay for as long as the program runs.
void replace_shader(const std::string& name, std::vector<uint32_t> spirv);

/// The shader, or what replaces it. Throws Error, once, for a replacement that declares a binding that the
/// shader does not, in the same words: it is then dropped. Cost: nothing while nothing is replaced.
[[nodiscard]] Shader current_build(const Shader& shader);

} // namespace estampe::gpu
