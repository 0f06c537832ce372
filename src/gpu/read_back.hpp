// SPDX-License-Identifier: MIT
#pragma once

// Passes that copy what a graph has made into memory that the host reads after the run.

#include <string>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

/// Copies `from` to the start of `to`, which is at least as large, of MemoryUse::readback, and outlives the
/// run of `graph`.
void add_read_back(Graph& graph, const std::string& name, BufferId from, Buffer& to);

/// The same of an image, its first layer and mip, row by row without gaps.
void add_read_back(Graph& graph, const std::string& name, ImageId from, Buffer& to);

} // namespace estampe::gpu
