// SPDX-License-Identifier: MIT
#include "techniques/fluid/read_fields.hpp"

#include "gpu/read_back.hpp"

namespace estampe::fluid {

void hand_on(gpu::Graph& graph, gpu::ImageId image)
{
    auto pass = graph.custom("fluid/keep");
    pass.touch(image, gpu::Access::compute_sampled);
    pass.keep().execute([](gpu::Recorder&) {});
}

gpu::BufferId add_layers_copy(gpu::Graph& graph, gpu::ImageId image)
{
    const gpu::ImageDesc desc = graph.describe(image);
    const gpu::BufferId target = graph.buffer("fluid/layers", {.size_bytes = gpu::size_bytes(desc)});
    auto copy = graph.custom("fluid/layers");
    copy.touch(image, gpu::Access::transfer_read);
    const gpu::BufferId numbers = copy.touch_write(target, gpu::Access::transfer_write);
    copy.execute([image, numbers, desc](gpu::Recorder& recorder) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, desc.layers},
                                       .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(image).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, recorder.buffer(numbers).handle(), 1,
                               &region);
    });
    hand_on(graph, image);
    return numbers;
}

std::vector<float> run_and_read(gpu::Device& device, gpu::Executor& executor, gpu::Graph& graph,
                                gpu::ImageId image)
{
    const gpu::BufferId numbers = add_layers_copy(graph, image);
    gpu::Buffer host(device, "fluid layers", graph.describe(numbers).size_bytes, gpu::MemoryUse::readback);
    gpu::add_read_back(graph, "fluid/read back", numbers, host);
    executor.run(graph);
    const auto items = gpu::items_of<float>(host);
    return {items.begin(), items.end()};
}

} // namespace estampe::fluid
