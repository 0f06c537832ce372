// SPDX-License-Identifier: MIT
#pragma once

// `estampe batch`: its options, its job file, and the report of the results.

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"

namespace estampe::app {

/// The options of `estampe batch` as typed.
class BatchOptions {
public:
    /// Adds the command to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// Checks and returns the options. Throws UsageError for invalid options.
    [[nodiscard]] BatchCommand read() const;

private:
    std::string jobs_;
    std::string report_;
    std::string shard_;
    std::string device_ = "auto";
    std::string raster_ = "auto";
};

/// One picture or film of a batch, as it would be typed on the command line.
struct BatchJob {
    uint32_t number = 1; ///< number among all jobs of the file
    std::string where;   ///< file:line:column of the job
    std::string scene;
    std::string output;
    std::vector<std::string> arguments; ///< arguments of `estampe render`
};

/// Reads a job file and combines every scene, camera and style in its lists. Throws Error for an invalid job,
/// with its file, line and column, and for two jobs with one output.
[[nodiscard]] std::vector<BatchJob> read_jobs(const std::string& file);

/// The command of a job. Throws Error for invalid options and for a style that cannot be read.
[[nodiscard]] RenderCommand command_of(const BatchJob& job, const RendererOptions& device);

} // namespace estampe::app
