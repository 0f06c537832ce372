// SPDX-License-Identifier: MIT
#pragma once

// `estampe batch`: its options, its file of jobs, and the report of what became of them.

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"

namespace estampe::app {

/// The options of `estampe batch` as they are typed.
class BatchOptions {
public:
    /// Adds the command to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// What was typed, looked at. Throws UsageError for a mistake in it.
    [[nodiscard]] BatchCommand read() const;

private:
    std::string jobs_;
    std::string report_;
    std::string shard_;
    std::string device_ = "auto";
    std::string raster_ = "auto";
};

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

/// What a job is to draw. Throws Error for a mistake in its options, and for a style that cannot be read.
[[nodiscard]] RenderCommand command_of(const BatchJob& job, const RendererOptions& device);

} // namespace estampe::app
