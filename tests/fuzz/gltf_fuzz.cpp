// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the bytes, the glTF importer gives a scene or an Error.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include <estampe/error.hpp>

#include "scene/importers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    try {
        const estampe::Scene scene =
            estampe::load_gltf_bytes({reinterpret_cast<const std::byte*>(data), size}, "fuzz.glb");
        if (!estampe::faults(scene).empty()) {
            std::abort();
        }
    } catch (const estampe::Error&) {
        return 0;
    }
    return 0;
}
