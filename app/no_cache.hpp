// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace estampe::app {

/// Adds `--no-cache`, which takes effect while the command line is read: see gpu::keep_pipelines().
void add_no_cache_flag(CLI::App& command);

} // namespace estampe::app
