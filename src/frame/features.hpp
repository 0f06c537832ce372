// SPDX-License-Identifier: MIT
#pragma once

// All features of a renderer in one place. Events, such as a new scene, are passed on to each feature. The
// saved state of a film consists of the states of all features.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "features/cloth/cloth_simulation.hpp"
#include "features/clouds/clouds.hpp"
#include "features/culling/culling.hpp"
#include "features/hatching/hatching.hpp"
#include "features/ink/flowing_ink.hpp"
#include "features/lighting/lighting.hpp"
#include "features/lines/lines.hpp"
#include "features/motion/motion_blur.hpp"
#include "features/occlusion/occlusion.hpp"
#include "features/particles/particles.hpp"
#include "features/shadows/shadows.hpp"
#include "features/smoke/rising_smoke.hpp"
#include "features/toon/toon.hpp"

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
    features::Toon toon;
    features::Culling culling;

    /// All features, in the order of their sections in a film's saved state.
    [[nodiscard]] std::array<features::Feature*, 13> all();

    void invalidate(features::Event event);
};

/// Returns the state that the next frame of a film takes over from the last one. Cost: a copy from the
/// device.
[[nodiscard]] std::vector<std::byte> save_film(Features& features, gpu::Device& device,
                                               gpu::Executor& executor);

/// Restores the state that save_film() returned, so that the next frame continues from it. Throws Error when
/// `memory` is damaged or comes from another version or another scene; the next frame then starts as the
/// first frame of a film.
void load_film(Features& features, gpu::Device& device, std::span<const std::byte> memory);

} // namespace estampe::frame
