// SPDX-License-Identifier: MIT
#include "batch_report.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"

namespace estampe::app {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of_status(JobResult::Status status)
{
    return status == JobResult::Status::done     ? "done"
           : status == JobResult::Status::failed ? "failed"
                                                 : "not begun";
}

Json job_json(const BatchJob& job, const JobResult& result)
{
    Json json{{"job", job.number},
              {"place", job.where},
              {"scene", job.scene},
              {"output", job.output},
              {"status", name_of_status(result.status)}};
    if (result.status != JobResult::Status::not_begun) {
        json["seconds"] = result.seconds;
    }
    if (!result.error.empty()) {
        json["error"] = result.error;
    }
    return json;
}

} // namespace

void write_report(const BatchCommand& command, const std::string& device, const std::vector<BatchJob>& jobs,
                  const std::vector<JobResult>& results)
{
    const auto count = [&](JobResult::Status status) {
        return std::ranges::count(results, status, &JobResult::status);
    };
    Json json{{"program", "estampe " ESTAMPE_VERSION},
              {"device", device},
              {"jobs_file", command.jobs},
              {"shard", fmt::format("{}/{}", command.shard, command.shards)},
              {"done", count(JobResult::Status::done)},
              {"failed", count(JobResult::Status::failed)},
              {"not_begun", count(JobResult::Status::not_begun)},
              {"jobs", Json::array()}};
    for (size_t i = 0; i < jobs.size(); ++i) {
        json["jobs"].push_back(job_json(jobs[i], results[i]));
    }
    // Names come from files and may hold bytes that are not UTF-8.
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    write_file_atomically(command.report, std::as_bytes(std::span(text)));
}

} // namespace estampe::app
