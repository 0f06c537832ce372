// SPDX-License-Identifier: MIT
#include "no_cache.hpp"

#include <CLI/CLI.hpp>

#include "gpu/pipeline_store.hpp"

namespace estampe::app {

void add_no_cache_flag(CLI::App& command)
{
    command.add_flag_callback(
        "--no-cache", [] { gpu::keep_pipelines(false); },
        "Neither use nor keep pipelines on disk that the driver has compiled");
}

} // namespace estampe::app
