// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "batch_jobs.hpp"

namespace estampe::app {

/// What became of a job.
struct JobResult {
    enum class Status : uint8_t { not_begun, done, failed };
    Status status = Status::not_begun;
    std::string error; ///< of one that failed
    double seconds = 0.0;
};

/// Writes what became of the jobs, one result each, to the command's report, whole or not at all. Throws
/// Error when it cannot be written.
void write_report(const BatchCommand& command, const std::string& device, const std::vector<BatchJob>& jobs,
                  const std::vector<JobResult>& results);

} // namespace estampe::app
