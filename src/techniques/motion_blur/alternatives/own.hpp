// SPDX-License-Identifier: MIT
#pragma once

// Blur within the outline of what moves.

#include "techniques/motion_blur/motion_blur.hpp"

namespace estampe::motion_blur {

/// Blurs each pixel along its own way, from velocity to velocity: nothing is spread over what it passes.
///
/// Reads   `page`: the layers and half their way, packed
/// Writes  new layers
/// Cost    one full-screen dispatch, 17 texels a pixel
[[nodiscard]] MotionBlurLayers add_own_blur(gpu::Graph& graph, const MotionBlurInputs& in, gpu::ImageId page,
                                            const shared::MotionBlurConstants& constants);

} // namespace estampe::motion_blur
