// SPDX-License-Identifier: MIT
#include "features/lighting/lighting.hpp"

#include <array>

#include "gpu/mapped_buffer.hpp"
#include "techniques/light/exposure/exposure.glsl.h"

namespace estampe::features {

void Lighting::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::film_recalled) {
        exposure_.forget();
    }
}

void Lighting::save(FilmWriter& writer)
{
    if (exposure_.time_s()) {
        writer.value(*exposure_.time_s());
        writer.buffers(std::array{&exposure_.buffer()});
    }
}

void Lighting::load(FilmReader& reader)
{
    const auto time_s = reader.value<double>();
    exposure_.recall(reader.buffer("exposure", sizeof(shared::ExposureState)), time_s);
}

void Lighting::upload(gpu::Device& device, const shared::LightGlobals& globals,
                      std::span<const shared::LightRecord> lights)
{
    gpu::upload_items(device, "lighting", std::span(&globals, 1), globals_);
    gpu::upload_items(device, "lights", lights, lights_);
}

} // namespace estampe::features
