// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the bytes, the OBJ reader gives a scene that can be posed, or an Error;
// and its reader of material libraries ends.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include <estampe/error.hpp>

#include "scene/importers.hpp"
#include "scene/obj/obj_materials.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    try {
        estampe::Input library(bytes, "fuzz.mtl");
        (void)estampe::obj::parse_mtl(library);
        const estampe::Scene scene = estampe::load_obj_bytes(bytes, "fuzz.obj");
        if (!estampe::faults(scene).empty()) {
            std::abort();
        }
        (void)estampe::scene_bounds(scene, estampe::pose_scene(scene, 0.0));
    } catch (const estampe::Error&) {
        return 0;
    }
    return 0;
}
