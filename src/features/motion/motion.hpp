// SPDX-License-Identifier: MIT
#pragma once

// Records the motion pass of a frame and reads its motion vectors back.

#include <estampe/renderer.hpp>

#include "gpu/resources.hpp"
#include "techniques/motion/motion.hpp"

namespace estampe::features {

/// Allocates the buffer that receives the motion vectors of a picture of this size.
void ensure_motion(gpu::Device& device, gpu::Buffer& pixels, const RenderSettings& settings);

/// Declares the motion pass, and a pass that copies its image into `pixels`.
void declare_motion(gpu::Graph& graph, const motion::MotionInputs& in, gpu::Buffer& pixels);

/// Returns the motion vectors in `pixels`. Call this function after the frame has been drawn.
[[nodiscard]] Motion read_motion(const gpu::Buffer& pixels, const RenderSettings& settings);

} // namespace estampe::features
