// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace estampe::gltf {

/// What EXT_meshopt_compression says of a buffer view.
struct MeshoptLayout {
    uint64_t count = 0;
    uint64_t stride = 0;
    std::string mode;   ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string filter; ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// count * stride bytes. Throws Error without a place when layout and data do not fit together or the data is
/// damaged.
[[nodiscard]] std::vector<std::byte> decode_meshopt(std::span<const std::byte> source,
                                                    const MeshoptLayout& layout);

} // namespace estampe::gltf
