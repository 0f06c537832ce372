// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the bytes, the PLY reader gives a scene that can be posed, or an Error.

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
            estampe::load_ply_bytes({reinterpret_cast<const std::byte*>(data), size}, "fuzz.ply");
        if (!estampe::faults(scene).empty()) {
            std::abort();
        }
        (void)estampe::scene_bounds(scene, estampe::pose_scene(scene, 0.0));
    } catch (const estampe::Error&) {
        return 0;
    }
    return 0;
}
