// SPDX-License-Identifier: MIT
#include "support/gpu_device.hpp"

#include <mutex>
#include <optional>
#include <utility>

namespace estampe::test {
namespace {

struct Messages {
    std::mutex mutex;
    std::vector<std::string> texts;
};

Messages& messages()
{
    static Messages held;
    return held;
}

/// In order of making: each goes before what it stands on.
struct Shared {
    std::optional<gpu::Device> device;
    std::optional<gpu::Executor> executor;
    std::optional<Renderer> renderer;
};

Shared& shared()
{
    static Shared held;
    return held;
}

gpu::Executor& shared_executor()
{
    auto& executor = shared().executor;
    return executor ? *executor : executor.emplace(shared_device());
}

} // namespace

std::vector<std::string> take_validation_messages()
{
    const std::lock_guard lock(messages().mutex);
    return std::exchange(messages().texts, {});
}

RendererOptions validated()
{
    return {.device = "cpu", .validation = true, .on_validation_message = [](const std::string& text) {
                const std::lock_guard lock(messages().mutex);
                messages().texts.push_back(text);
            }};
}

gpu::Device& shared_device()
{
    auto& device = shared().device;
    return device ? *device : device.emplace(validated());
}

Renderer& shared_renderer()
{
    auto& renderer = shared().renderer;
    return renderer ? *renderer : renderer.emplace(validated());
}

void destroy_shared()
{
    shared().renderer.reset();
    shared().executor.reset();
    shared().device.reset();
}

std::vector<std::vector<std::byte>> run_and_read(gpu::Graph& graph, std::span<const gpu::BufferId> buffers)
{
    std::vector<gpu::Buffer> targets;
    targets.reserve(buffers.size());
    for (const gpu::BufferId buffer : buffers) {
        const uint64_t size_bytes = graph.describe(buffer).size_bytes;
        targets.emplace_back(shared_device(), "read-back", size_bytes, gpu::MemoryUse::readback);
        auto copy = graph.custom("copy");
        copy.touch(buffer, gpu::Access::transfer_read);
        const auto copied =
            copy.touch_write(graph.import_buffer("read-back", targets.back(), {.size_bytes = size_bytes}),
                             gpu::Access::transfer_write);
        copy.execute([buffer, copied, size_bytes](gpu::Recorder& recorder) {
            const VkBufferCopy region{.size = size_bytes};
            vkCmdCopyBuffer(recorder.commands(), recorder.buffer(buffer).handle(),
                            recorder.buffer(copied).handle(), 1, &region);
        });
        graph.custom("host").touch(copied, gpu::Access::host_read).keep();
    }
    shared_executor().run(graph);
    std::vector<std::vector<std::byte>> bytes;
    bytes.reserve(targets.size());
    for (gpu::Buffer& target : targets) {
        bytes.emplace_back(target.mapped().begin(), target.mapped().end());
    }
    return bytes;
}

std::vector<std::byte> run_and_read(gpu::Graph& graph, gpu::BufferId buffer)
{
    return run_and_read(graph, std::span(&buffer, 1)).front();
}

std::vector<std::byte> run_and_read(gpu::Graph& graph, gpu::ImageId image, uint32_t bytes_per_texel)
{
    const gpu::ImageDesc desc = graph.describe(image);
    const uint64_t size_bytes = static_cast<uint64_t>(desc.width) * desc.height * bytes_per_texel;
    gpu::Buffer target(shared_device(), "read-back", size_bytes, gpu::MemoryUse::readback);
    auto copy = graph.custom("copy");
    copy.touch(image, gpu::Access::transfer_read);
    const auto copied =
        copy.touch_write(graph.import_buffer("read-back", target, {.size_bytes = target.size_bytes()}),
                         gpu::Access::transfer_write);
    copy.execute([image, copied, desc](gpu::Recorder& recorder) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(image).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, recorder.buffer(copied).handle(), 1,
                               &region);
    });
    graph.custom("host").touch(copied, gpu::Access::host_read).keep();
    shared_executor().run(graph);
    return {target.mapped().begin(), target.mapped().begin() + static_cast<ptrdiff_t>(size_bytes)};
}

} // namespace estampe::test
