// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the bytes, a picture of any format that textures have, an OpenEXR picture or a
// lightmap is read or refused with an Error.

#include <cstddef>
#include <cstdint>
#include <span>

#include <estampe/error.hpp>

#include "core/exr.hpp"
#include "core/image_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    try {
        if (size >= 4 && estampe::is_exr(bytes)) {
            estampe::ExrFile file = estampe::decode_exr(bytes, "fuzz.exr");
            (void)estampe::baked_lightmap(std::move(file), "fuzz.exr");
        } else {
            (void)estampe::decode_deep_image(bytes, "fuzz.png");
            (void)estampe::decode_image(bytes, "fuzz.png");
        }
    } catch (const estampe::Error&) {
        return 0;
    }
    return 0;
}
