// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace estampe::app {

/// One picture or film of a batch, as it would be typed.
struct BatchJob {
    uint32_t number = 1; ///< of all jobs of the file
    std::string where;   ///< file:line:column
    std::string scene;
    std::string output;
    std::vector<std::string> arguments; ///< of `estampe render`
};

/// Reads a file of jobs, lists of scenes, cameras and styles each with each. Throws Error naming file, line
/// and column for what is no job, and when two jobs have one output.
[[nodiscard]] std::vector<BatchJob> read_jobs(const std::string& file);

/// The jobs of one of `shards` parts, from 1 on: runs in their order, whose lengths differ by one at most.
[[nodiscard]] std::vector<BatchJob> shard_of(const std::vector<BatchJob>& jobs, uint32_t shard,
                                             uint32_t shards);

/// What a job is to draw. Throws Error for a mistake in its options, and for a style that cannot be read.
[[nodiscard]] RenderCommand command_of(const BatchJob& job, const RendererOptions& device);

} // namespace estampe::app
