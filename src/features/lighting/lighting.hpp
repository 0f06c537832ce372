// SPDX-License-Identifier: MIT
#pragma once

// The lights of a picture on the device, and the exposure that goes on from picture to picture.

#include <span>

#include "features/common/feature.hpp"
#include "techniques/light/exposure/exposure.hpp"
#include "techniques/light/light.glsl.h"

namespace estampe::features {

class Lighting final : public Feature {
public:
    /// The eye gets used to another scene afresh.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override
    {
        return FilmSection{"exposure", 1};
    }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Uploads what the light's shaders read.
    void upload(gpu::Device& device, const shared::LightGlobals& globals,
                std::span<const shared::LightRecord> lights);

    [[nodiscard]] light::ExposureMemory& exposure() { return exposure_; }

    [[nodiscard]] gpu::Buffer& globals() { return globals_; }

    /// LightRecord, one per light.
    [[nodiscard]] gpu::Buffer& lights() { return lights_; }

private:
    light::ExposureMemory exposure_;
    gpu::Buffer globals_;
    gpu::Buffer lights_;
};

} // namespace estampe::features
