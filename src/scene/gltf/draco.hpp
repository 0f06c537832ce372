// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// What a Draco stream holds: attributes as floats, converted as their accessors say, and triangles.
struct DracoMesh {
    std::map<std::string, std::vector<float>> attributes;
    std::vector<uint32_t> indices; ///< a triangle list

    [[nodiscard]] const std::vector<float>* attribute(const std::string& name) const
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? nullptr : &found->second;
    }
};

/// Decodes KHR_draco_mesh_compression; nothing for a primitive without it. Throws Error with a pointer when
/// the stream is damaged or does not match the accessors.
[[nodiscard]] std::optional<DracoMesh> decode_draco(Data& data, const tinygltf::Primitive& source,
                                                    const std::string& pointer);

} // namespace estampe::gltf
