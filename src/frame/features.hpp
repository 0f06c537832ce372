// SPDX-License-Identifier: MIT
#pragma once

// The features of a renderer in one place: events go to each of them, and a film's memory is what they save.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "features/cloth/cloth_simulation.hpp"
#include "features/clouds/clouds.hpp"
#include "features/hatching/hatching.hpp"
#include "features/ink/flowing_ink.hpp"
#include "features/lighting/lighting.hpp"
#include "features/lines/lines.hpp"
#include "features/motion/motion_blur.hpp"
#include "features/occlusion/occlusion.hpp"
#include "features/particles/particles.hpp"
#include "features/shadows/shadows.hpp"
#include "features/smoke/rising_smoke.hpp"

namespace estampe::frame {

struct Features {
    features::Shadows shadows;
    features::Lighting lighting;
    features::Occlusion occlusion;
    features::Lines lines;
    features::Hatching hatching;
    features::ClothSimulation cloth;
    features::FlowingInk ink;
    features::RisingSmoke smoke;
    features::Clouds clouds;
    features::Particles particles;
    features::MotionBlur motion_blur;

    /// In the order in which a film's memory holds them.
    [[nodiscard]] std::array<features::Feature*, 11> all();

    void invalidate(features::Event event);
};

/// What the next frame of a film takes from the last one. Cost: a copy from the device.
[[nodiscard]] std::vector<std::byte> save_film(Features& features, gpu::Device& device,
                                               gpu::Executor& executor);

/// Makes the next frame go on from what save_film() returned. Throws Error when `memory` is damaged, another
/// version's, or another scene's; the next frame then goes on from nothing.
void load_film(Features& features, gpu::Device& device, std::span<const std::byte> memory);

} // namespace estampe::frame
