// SPDX-License-Identifier: MIT
#pragma once

// Fields of a fluid for the processor: tests and measurements read them.

#include <vector>

#include "gpu/graph/execute.hpp"

namespace estampe::fluid {

/// Leaves an image as later graphs take it in, by gpu::import_uploaded.
void hand_on(gpu::Graph& graph, gpu::ImageId image);

/// Adds a copy of all layers of `image`, one after the other, and leaves the image as later graphs take it
/// in.
[[nodiscard]] gpu::BufferId add_layers_copy(gpu::Graph& graph, gpu::ImageId image);

/// The same, read after a run of `graph`.
[[nodiscard]] std::vector<float> run_and_read(gpu::Device& device, gpu::Executor& executor, gpu::Graph& graph,
                                              gpu::ImageId image);

} // namespace estampe::fluid
