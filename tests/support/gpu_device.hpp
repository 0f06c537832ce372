// SPDX-License-Identifier: MIT
#pragma once

// The device that tests draw on: lavapipe, with validation and synchronization validation. A validation
// message fails the test that caused it (see validation_gate.hpp). Without the device or the layer, all tests
// fail.

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"

namespace estampe::test {

/// Returns the messages of the validation layer since the last call.
[[nodiscard]] std::vector<std::string> take_validation_messages();

/// Options for a renderer on lavapipe whose validation messages fail the running test.
[[nodiscard]] RendererOptions validated();

/// A device shared by all tests of the program.
[[nodiscard]] gpu::Device& shared_device();

/// A renderer shared by all tests of the program.
[[nodiscard]] Renderer& shared_renderer();

/// Destroys device and renderer, so that the layer can report leaked objects. No object of the device may
/// exist after this call.
void destroy_shared();

template <class T>
[[nodiscard]] std::vector<T> items_of(const std::vector<std::byte>& bytes)
{
    std::vector<T> items(bytes.size() / sizeof(T));
    std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
    return items;
}

/// Runs `graph` on the shared device. Returns the bytes of each of `buffers`, which the graph must produce.
[[nodiscard]] std::vector<std::vector<std::byte>> run_and_read(gpu::Graph& graph,
                                                               std::span<const gpu::BufferId> buffers);

/// Runs `graph` on the shared device. Returns the bytes of one buffer.
[[nodiscard]] std::vector<std::byte> run_and_read(gpu::Graph& graph, gpu::BufferId buffer);

template <class T>
[[nodiscard]] std::vector<T> run_and_read_as(gpu::Graph& graph, gpu::BufferId buffer)
{
    return items_of<T>(run_and_read(graph, buffer));
}

/// Runs `graph` on the shared device. Returns an image of `bytes_per_texel`, tightly packed.
[[nodiscard]] std::vector<std::byte> run_and_read(gpu::Graph& graph, gpu::ImageId image,
                                                  uint32_t bytes_per_texel);

template <class T>
[[nodiscard]] std::vector<T> run_and_read_as(gpu::Graph& graph, gpu::ImageId image)
{
    return items_of<T>(run_and_read(graph, image, sizeof(T)));
}

} // namespace estampe::test
