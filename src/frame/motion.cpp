// SPDX-License-Identifier: MIT
#include "frame/motion.hpp"

#include <cstring>

#include "gpu/graph/execute.hpp"
#include "gpu/imports.hpp"

namespace estampe::frame {

void provide_motion(gpu::Device& device, gpu::Buffer& pixels, const RenderSettings& settings)
{
    const uint64_t size_bytes = sizeof(glm::vec4) * settings.width * settings.height;
    if (pixels.empty() || pixels.size_bytes() != size_bytes) {
        pixels = gpu::Buffer(device, "motion read-back", size_bytes, gpu::MemoryUse::readback);
    }
}

void declare_motion(gpu::Graph& graph, const motion::MotionInputs& in, gpu::Buffer& pixels)
{
    const gpu::ImageId motion = motion::add_motion(graph, in);
    auto copy = graph.custom("motion/read back");
    copy.touch(motion, gpu::Access::transfer_read);
    const gpu::BufferId copied =
        copy.touch_write(gpu::import_whole(graph, "motion pixels", pixels), gpu::Access::transfer_write);
    copy.execute([motion, copied](gpu::Recorder& recorder) {
        const gpu::Image& image = recorder.image(motion);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {image.desc().width, image.desc().height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               recorder.buffer(copied).handle(), 1, &region);
    });
    graph.custom("motion/host").touch(copied, gpu::Access::host_read).keep();
}

Motion read_motion(const gpu::Buffer& pixels, const RenderSettings& settings)
{
    Motion motion{.width = settings.width, .height = settings.height, .pixels = {}};
    motion.pixels.resize(static_cast<size_t>(settings.width) * settings.height);
    std::memcpy(motion.pixels.data(), pixels.mapped().data(), sizeof(glm::vec4) * motion.pixels.size());
    return motion;
}

} // namespace estampe::frame
