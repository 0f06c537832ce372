// SPDX-License-Identifier: MIT
#include "gpu/read_back.hpp"

#include "gpu/graph/execute.hpp"
#include "gpu/imports.hpp"

namespace estampe::gpu {
namespace {

/// `copy` is called with the recorder and the handle of `to`.
template <class Id, class Copy>
void add_copy(Graph& graph, const std::string& name, Id from, Buffer& to, const Copy& copy)
{
    auto pass = graph.custom(name);
    pass.touch(from, Access::transfer_read);
    const BufferId copied = pass.touch_write(import_whole(graph, name, to), Access::transfer_write);
    pass.execute([=](Recorder& recorder) { copy(recorder, recorder.buffer(copied).handle()); });
    graph.custom(name + "/host").touch(copied, Access::host_read).keep();
}

} // namespace

void add_read_back(Graph& graph, const std::string& name, BufferId from, Buffer& to)
{
    const uint64_t size_bytes = graph.describe(from).size_bytes;
    add_copy(graph, name, from, to, [=](Recorder& recorder, VkBuffer target) {
        const VkBufferCopy region{.size = size_bytes};
        vkCmdCopyBuffer(recorder.commands(), recorder.buffer(from).handle(), target, 1, &region);
    });
}

void add_read_back(Graph& graph, const std::string& name, ImageId from, Buffer& to)
{
    const ImageDesc desc = graph.describe(from);
    add_copy(graph, name, from, to, [=](Recorder& recorder, VkBuffer target) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(from).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, 1, &region);
    });
}

void add_copy_out(Graph& graph, const std::string& name, BufferId from, Buffer& to)
{
    const uint64_t size_bytes = to.size_bytes();
    auto pass = graph.custom(name);
    pass.touch(from, Access::transfer_read);
    const BufferId copied = pass.touch_write(import_whole(graph, name, to), Access::transfer_write);
    pass.execute([=](Recorder& recorder) {
        const VkBufferCopy region{.size = size_bytes};
        vkCmdCopyBuffer(recorder.commands(), recorder.buffer(from).handle(), recorder.buffer(copied).handle(),
                        1, &region);
    });
}

} // namespace estampe::gpu
