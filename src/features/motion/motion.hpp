// SPDX-License-Identifier: MIT
#pragma once

// Between which two views things moved, and where their motion is read back to.

#include <estampe/renderer.hpp>

#include "gpu/resources.hpp"
#include "techniques/motion/motion.hpp"

namespace estampe::features {

/// Makes room to read back the motion of a picture of this size.
void ensure_motion(gpu::Device& device, gpu::Buffer& pixels, const RenderSettings& settings);

/// Declares the pass, and one that copies its image into `pixels`.
void declare_motion(gpu::Graph& graph, const motion::MotionInputs& in, gpu::Buffer& pixels);

/// What a frame that has been drawn left in `pixels`.
[[nodiscard]] Motion read_motion(const gpu::Buffer& pixels, const RenderSettings& settings);

} // namespace estampe::features
