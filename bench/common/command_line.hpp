// SPDX-License-Identifier: MIT
#pragma once

// The command line of every measuring program: its common options, its messages and its exit status.

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <estampe/renderer.hpp>

namespace estampe::bench {

/// Parses the command line and calls `measure`. Returns the exit status: 0 done, 1 measuring failed, 2 the
/// command line is wrong. Failures are one line on standard error. `measure` may throw CLI::ValidationError
/// for options that contradict each other.
int run(CLI::App& app, int argc, char** argv, const std::function<void()>& measure);

/// The measurement that a command runs after the command line is parsed.
using Job = std::function<void()>;

/// Adds a command, with the options that `add_options` adds. If the user types this command, `job` becomes
/// the result of `add_options`.
void add_command(CLI::App& app, const std::string& name, const std::string& about,
                 Job (*add_options)(CLI::App&), Job& job);

/// Width and height in pixels, typed like 1280x720.
struct Size {
    uint32_t width = 1280;
    uint32_t height = 720;
};

std::istream& operator>>(std::istream& stream, Size& size);
std::ostream& operator<<(std::ostream& stream, const Size& size);

/// Adds --device.
void add_device_option(CLI::App& command, std::string& device);

/// Adds --no-cache, which takes effect during parsing: see gpu::keep_pipelines().
void add_no_cache_flag(CLI::App& command);

/// Adds --device, --raster and --no-cache.
void add_renderer_options(CLI::App& command, RendererOptions& options);

/// Adds --size.
void add_size_option(CLI::App& command, Size& size);

/// Adds --set, which may be repeated.
void add_set_option(CLI::App& command, std::vector<std::string>& assignments);

/// Accepts 1 to `most`.
[[nodiscard]] CLI::Validator up_to(uint32_t most);

/// Accepts file names with this extension, such as ".json".
[[nodiscard]] CLI::Validator ends_in(const std::string& extension);

/// Accepts one of `names`, which are names of a `kind`, such as "series".
[[nodiscard]] CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names);

} // namespace estampe::bench
