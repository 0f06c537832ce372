// SPDX-License-Identifier: MIT
#pragma once

// A puff of smoke, worked out once by the solver and kept as frames: what section 6.5 of the thesis calls a
// mixed technique, one small simulation shown on dozens of sprites.

#include "gpu/graph/execute.hpp"
#include "techniques/particles/particles.hpp"

namespace estampe::features {

/// 6 x 6 frames of 64 x 64 pixels over four seconds: a warm puff that rises, rolls up and thins. The same on
/// the same device. Cost: 240 steps of the solver.
[[nodiscard]] particles::SheetImage smoke_sheet(gpu::Device& device, gpu::Executor& executor);

} // namespace estampe::features
