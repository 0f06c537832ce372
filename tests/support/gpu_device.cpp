// SPDX-License-Identifier: MIT
#include "support/gpu_device.hpp"

#include <mutex>
#include <optional>
#include <utility>

#include "gpu/transfers.hpp"

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

/// In the order of creation. Each object is destroyed before the objects that it uses.
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
        targets.emplace_back(shared_device(), "read-back", graph.describe(buffer).size_bytes,
                             gpu::MemoryUse::readback);
        gpu::add_read_back(graph, "read back", buffer, targets.back());
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
    gpu::add_read_back(graph, "read back", image, target);
    shared_executor().run(graph);
    return {target.mapped().begin(), target.mapped().begin() + static_cast<ptrdiff_t>(size_bytes)};
}

} // namespace estampe::test
