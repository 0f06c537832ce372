// SPDX-License-Identifier: MIT
#include "core/long_jobs.hpp"

#include <utility>

#include <estampe/error.hpp>

#include "core/job_limits.hpp"

namespace estampe {
namespace {

thread_local std::function<bool(double)> watching;

} // namespace

ProgressWatch::ProgressWatch(std::function<bool(double share)> go_on)
{
    watching = std::move(go_on);
}

ProgressWatch::~ProgressWatch()
{
    watching = nullptr;
}

void report_progress(double share)
{
    check_time();
    if (watching && !watching(share)) {
        throw Error("was not wanted any more");
    }
}

} // namespace estampe
