// SPDX-License-Identifier: MIT
#pragma once

// What a compiled shader declares at its bindings, read from its SPIR-V.

#include <cstdint>
#include <map>
#include <span>
#include <string>

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

/// What the shader declares, by number of the binding. Declarations that the compiler found unused are not
/// there. Throws std::logic_error when the words are no SPIR-V.
///
/// Cost    linear in words, some 50 us for a large shader
/// Source  Khronos, "SPIR-V Specification", version 1.6
[[nodiscard]] std::map<uint32_t, Binding> bindings_of(const Shader& shader);

/// What a pass fills a binding with.
[[nodiscard]] Binding binding_of(const Use& use, const ResourceRecord& resource);

/// "storage image of r16f", "texel buffer of unsigned numbers".
[[nodiscard]] std::string in_words(const Binding& binding);

} // namespace estampe::gpu
