// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "scene/gltf/container.hpp"

namespace estampe::gltf {

/// Where a buffer's bytes are. Kept out of tinygltf's model, which would read them unasked.
struct BufferSource {
    std::string uri; ///< empty: the binary chunk, or a fallback that nobody reads
    uint64_t byte_length = 0;
};

/// Where an image is: a data URI, a relative path, or a buffer view.
struct ImageSource {
    std::string name;
    std::string uri;
    int view = -1;
};

struct Document {
    tinygltf::Model model; ///< without buffers, images, and the indices of primitives
    std::vector<BufferSource> buffers;
    std::vector<ImageSource> images;

    /// The index accessor of each primitive of each mesh, or -1. tinygltf refuses one without a buffer view,
    /// which glTF allows.
    std::vector<std::vector<int>> indices;

    /// Names of the material variants (KHR_materials_variants). tinygltf drops those without a name.
    std::vector<std::string> variants;
};

/// Parses and checks the JSON. Afterwards every index in the model is inside its array and every number is in
/// range. Throws Error with a JSON pointer, a line and column, or a byte.
[[nodiscard]] Document read_document(const Container& container, const std::string& file);

} // namespace estampe::gltf
