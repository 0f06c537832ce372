// SPDX-License-Identifier: MIT
#include "common/command_line.hpp"

#include <algorithm>
#include <cstdio>
#include <istream>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "gpu/pipelines.hpp"

namespace estampe::bench {
namespace {

int fail(const CLI::App& app, const std::string& message, int status)
{
    say(fmt::format("{}: error: {}\n", app.get_name(), shortened(one_line(message))));
    return status;
}

std::string help_of(const CLI::App& app)
{
    std::string typed = app.get_name();
    for (const CLI::App* command : app.get_subcommands()) {
        typed += " " + command->get_name();
    }
    return typed + " --help";
}

/// A validator without a description, because --help would append the description to the value's type.
CLI::Validator quiet(const std::function<std::string(const std::string&)>& complaint_about)
{
    return {[complaint_about](std::string& value) { return complaint_about(value); }, ""};
}

} // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<void()>& measure)
{
    try {
        app.parse(argc, argv);
        measure();
        if (std::fflush(stdout) != 0) {
            throw Error("standard output cannot be written");
        }
    } catch (const CLI::ParseError& problem) {
        if (problem.get_exit_code() == 0) { // --help
            return app.exit(problem);
        }
        return fail(app, Error(problem.what(), {}, "see " + help_of(app)).what(), 2);
    } catch (const std::exception& problem) {
        return fail(app, problem.what(), 1);
    }
    return 0;
}

void add_command(CLI::App& app, const std::string& name, const std::string& about,
                 Job (*add_options)(CLI::App&), Job& job)
{
    CLI::App& command = *app.add_subcommand(name, about);
    command.callback([&job, chosen = add_options(command)] { job = chosen; });
}

std::istream& operator>>(std::istream& stream, Size& size)
{
    constexpr uint32_t most = 65535;
    const auto is_side = [](uint32_t side) { return side >= 1 && side <= most; };
    char cross = 0;
    stream >> size.width >> cross >> size.height;
    if (cross != 'x' || !is_side(size.width) || !is_side(size.height)) {
        stream.setstate(std::ios::failbit);
    }
    return stream;
}

std::ostream& operator<<(std::ostream& stream, const Size& size)
{
    return stream << size.width << 'x' << size.height;
}

void add_device_option(CLI::App& command, std::string& device)
{
    command.add_option("--device", device, "auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str()
        ->check(quiet([](const std::string& text) {
            const bool is_one = text == "auto" || text == "cpu" || number_from<uint32_t>(text);
            return is_one ? std::string() : in_quotes(text) + " is not a device";
        }));
}

void add_no_cache_flag(CLI::App& command)
{
    command.add_flag_callback(
        "--no-cache", [] { gpu::keep_pipelines(false); },
        "Neither use nor keep pipelines on disk that the driver has compiled");
}

void add_renderer_options(CLI::App& command, RendererOptions& options)
{
    add_no_cache_flag(command);
    add_device_option(command, options.device);
    const std::map<std::string, RasterPath> paths{{"auto", RasterPath::automatic},
                                                  {"hardware", RasterPath::hardware},
                                                  {"compute", RasterPath::compute}};
    command.add_option("--raster", options.raster, "hardware, compute, or auto")
        ->type_name("PATH")
        ->default_str("auto")
        ->transform(CLI::CheckedTransformer(paths).description(""));
}

void add_size_option(CLI::App& command, Size& size)
{
    command.add_option("--size", size, "Width and height in pixels")->type_name("WxH")->capture_default_str();
}

void add_set_option(CLI::App& command, std::vector<std::string>& assignments)
{
    command.add_option("--set", assignments, "One parameter of the style; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

CLI::Validator up_to(uint32_t most)
{
    return CLI::Range(1U, most).description("");
}

CLI::Validator ends_in(const std::string& extension)
{
    return quiet([extension](const std::string& file) {
        return lower_extension(file) == extension ? std::string()
                                                  : fmt::format("the name must end in {}", extension);
    });
}

CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names)
{
    return quiet([kind, names](const std::string& name) {
        return std::ranges::find(names, name) != names.end()
                   ? std::string()
                   : fmt::format("there is no {} {}; there are {}", kind, in_quotes(name),
                                 fmt::join(names, ", "));
    });
}

} // namespace estampe::bench
