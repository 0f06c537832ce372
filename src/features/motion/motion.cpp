// SPDX-License-Identifier: MIT
#include "features/motion/motion.hpp"

#include <cstring>

#include "gpu/transfers.hpp"

namespace estampe::features {

void ensure_motion(gpu::Device& device, gpu::Buffer& pixels, const RenderSettings& settings)
{
    const uint64_t size_bytes = sizeof(glm::vec4) * settings.width * settings.height;
    if (pixels.empty() || pixels.size_bytes() != size_bytes) {
        pixels = gpu::Buffer(device, "motion read-back", size_bytes, gpu::MemoryUse::readback);
    }
}

void declare_motion(gpu::Graph& graph, const motion::MotionInputs& in, gpu::Buffer& pixels)
{
    gpu::add_read_back(graph, "motion/read back", motion::add_motion(graph, in), pixels);
}

Motion read_motion(const gpu::Buffer& pixels, const RenderSettings& settings)
{
    Motion motion{.width = settings.width, .height = settings.height, .pixels = {}};
    motion.pixels.resize(static_cast<size_t>(settings.width) * settings.height);
    std::memcpy(motion.pixels.data(), pixels.mapped().data(), sizeof(glm::vec4) * motion.pixels.size());
    return motion;
}

} // namespace estampe::features
