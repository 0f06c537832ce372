// SPDX-License-Identifier: MIT
#pragma once

// `estampe batch`: its options, its job file, and the report of the results.

#include <optional>
#include <string>
#include <vector>

#include "option_values.hpp"
#include "options.hpp"

namespace estampe::app {

/// The options of `estampe batch` as the user typed them.
class BatchOptions {
public:
    /// Adds the command `batch` to `app`; this object must outlive the parsing.
    void add_to(CLI::App& app);

    /// Checks the typed options and returns them as a command. Throws UsageError for invalid options.
    [[nodiscard]] BatchCommand read() const;

private:
    std::string jobs_;
    std::string report_;
    std::string shard_;
    bool is_confined_ = false;
    LimitOptions limits_;
    std::string device_ = "auto";
    std::string raster_ = "auto";
};

/// A job of a batch: one picture or film, in the form of a command line.
struct BatchJob {
    uint32_t number = 1; ///< Number of the job among all jobs of the job file, from 1
    std::string where;   ///< Place of the job in its file, as file:line:column
    std::string scene;
    std::string output;
    std::vector<std::string> arguments; ///< Arguments of `estampe render` for this job
};

/// Reads a job file. Each combination of the listed scenes, cameras and styles becomes a job. Throws Error,
/// with file, line and column, for an invalid job, for two jobs with the same output, and for a jobs file
/// outside of `scope`.
[[nodiscard]] std::vector<BatchJob> read_jobs(const std::string& file, const ReadScope& scope = {});

/// Returns the render command of a batch job. Throws Error for invalid options, for a style that cannot be
/// read, and for an output outside of the scope of `confine`.
[[nodiscard]] RenderCommand command_of(const BatchJob& job, const RendererOptions& device,
                                       const Confinement& confine = {});

} // namespace estampe::app
