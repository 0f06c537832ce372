// SPDX-License-Identifier: MIT
#include "option_values.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/text.hpp"
#include "gpu/pipelines.hpp"
#include "options.hpp"
#include "piped_scene.hpp"

namespace estampe::app {
namespace {

constexpr const char* camera_syntax =
    "write \"eye=2,1,3 target=0,0.5,0 fov=35\", \"azimuth=30 elevation=20\", a camera's name, or auto";

[[noreturn]] void fail_camera(const std::string& what)
{
    throw UsageError(what, "--camera", camera_syntax);
}

/// Parses the value of --camera with `parse`, and reports an Error of `parse` as a mistake in the command
/// line.
template <typename Parse>
auto parsed(const Parse& parse)
{
    try {
        return parse();
    } catch (const Error& problem) {
        throw UsageError(problem.what(), "--camera");
    }
}

bool has_any(const std::string& text, std::initializer_list<const char*> keys)
{
    return std::ranges::any_of(keys, [&](const char* key) { return text.find(key) != std::string::npos; });
}

} // namespace

const CLI::Option* find_option(const CLI::App& command, const std::string& long_name)
{
    const std::vector<const CLI::Option*> found =
        command.get_options([&](const CLI::Option* option) { return option->check_lname(long_name); });
    return found.empty() ? nullptr : found.front();
}

std::pair<uint32_t, uint32_t> parse_size(const std::string& text)
{
    const size_t cross = text.find('x');
    const auto width = number_from<uint32_t>(std::string_view(text).substr(0, cross));
    const auto height = cross == std::string::npos
                            ? std::nullopt
                            : number_from<uint32_t>(std::string_view(text).substr(cross + 1));
    if (!width || !height) {
        throw UsageError(fmt::format("{} is not a size", in_quotes(text)), "--size",
                         "write WIDTHxHEIGHT in pixels, such as 1920x1080");
    }
    if (std::min(*width, *height) < 1 || std::max(*width, *height) > largest_side_px) {
        throw UsageError(fmt::format("{} is out of range", text), "--size",
                         fmt::format("each side may have 1 to {} pixels", largest_side_px));
    }
    return {*width, *height};
}

CameraChoice parse_camera(const std::string& text)
{
    CameraChoice choice;
    if (text == "auto") {
        choice.kind = CameraChoice::Kind::framing;
    } else if (has_any(text, {"azimuth=", "elevation=", "distance="})) {
        choice.kind = CameraChoice::Kind::directed;
        choice.direction = parsed([&] { return parse_view_direction(text); });
    } else if (has_any(text, {"eye=", "target=", "fov="})) {
        choice.kind = CameraChoice::Kind::placed;
        const bool has_target = has_any(text, {"target="}); // Without a target the camera looks at the origin
        choice.placed =
            parsed([&] { return estampe::parse_camera(has_target ? text : text + " target=0,0,0"); });
    } else if (text.empty()) {
        fail_camera("is empty");
    } else {
        choice.kind = CameraChoice::Kind::named;
        choice.name = text;
    }
    return choice;
}

CameraChoice parse_view(const std::string& text)
{
    const std::optional<NamedView> view = named_view(text);
    if (!view) {
        throw UsageError(fmt::format("there is no view {}", in_quotes(text)), "--view",
                         fmt::format("allowed: {}", fmt::join(view_names(), ", ")));
    }
    CameraChoice choice;
    choice.kind = CameraChoice::Kind::directed;
    choice.direction = direction_of(*view);
    return choice;
}

namespace {

/// Parses an axis: "x", "y", "z", "-x", "-y" or "-z". Throws UsageError for any other text.
UpAxis parse_up_axis(const std::string& text)
{
    constexpr std::array<std::pair<std::string_view, UpAxis>, 6> axes{{{"x", UpAxis::x},
                                                                       {"y", UpAxis::y},
                                                                       {"z", UpAxis::z},
                                                                       {"-x", UpAxis::minus_x},
                                                                       {"-y", UpAxis::minus_y},
                                                                       {"-z", UpAxis::minus_z}}};
    const std::string low = lower_case(text);
    const auto* const found =
        std::ranges::find(axes, std::string_view(low), &decltype(axes)::value_type::first);
    if (found == axes.end()) {
        throw UsageError(fmt::format("{} is no axis", in_quotes(text)), "--up",
                         "write x, y, z, -x, -y or -z, as the file's coordinates have it");
    }
    return found->second;
}

/// Checks the value of --input-format. Throws UsageError unless `text` is empty or a known format.
void check_input_format(const std::string& text)
{
    const auto formats = input_formats();
    if (!text.empty() && std::ranges::find(formats, std::string_view(text)) == formats.end()) {
        throw UsageError(fmt::format("{} is no format of scenes", in_quotes(text)), "--input-format",
                         fmt::format("allowed: {}", fmt::join(formats, ", ")));
    }
}

} // namespace

RasterPath parse_raster_path(const std::string& text)
{
    for (const RasterPath path : {RasterPath::automatic, RasterPath::hardware, RasterPath::compute}) {
        if (text == name_of(path)) {
            return path;
        }
    }
    throw UsageError(fmt::format("{} is not a way to draw triangles", in_quotes(text)), "--raster",
                     "write auto, hardware or compute");
}

void check_device(const std::string& text)
{
    if (text != "auto" && text != "cpu" && !number_from<uint32_t>(text)) {
        throw UsageError(fmt::format("{} is not a device", in_quotes(text)), "--device",
                         "write auto, cpu, or an index that estampe devices lists");
    }
}

void check_range(const char* option, uint32_t typed, uint32_t least, uint32_t most)
{
    if (typed < least || typed > most) {
        throw UsageError(fmt::format("{} is out of range", typed), option,
                         fmt::format("allowed: {} to {}", least, most));
    }
}

ReadScope style_scope(const std::string& name, const Confinement& confine)
{
    const bool is_beside = confine.is_on && !confine.jobs.is_limited() && !name.empty();
    return is_beside ? Style::scope_of(name) : confine.jobs;
}

Style read_style(const std::string& name, const std::vector<std::string>& assignments,
                 const Confinement& confine)
{
    ReadScope scope = style_scope(name, confine);
    Style style = name.empty() ? Style() : Style::load(name, scope);
    const std::vector<std::filesystem::path> named = style.files();
    for (const std::string& assignment : assignments) {
        try {
            style.set(assignment);
        } catch (const Error& problem) {
            throw UsageError(problem.what());
        }
    }
    // The user of the command line may let an assignment name a file anywhere; a job may not.
    for (const std::filesystem::path& file : style.files()) {
        const bool is_assigned = std::ranges::find(named, file) == named.end();
        if (is_assigned && confine.is_on && !confine.jobs.is_limited()) {
            scope.folders.push_back(ReadScope::beside(file).folders.front());
        }
    }
    style.limit_files(scope);
    return style;
}

void SceneOptions::add_to(CLI::App& command)
{
    command
        .add_option("--up", up_,
                    "Axis of the file that points up: x, y, z, -x, -y or -z. The scene is\n"
                    "turned so that this axis becomes y. [what the file says, else y]")
        ->type_name("AXIS");
    command
        .add_option("--input-format", format_,
                    "Format of a scene on standard input: glb, gltf, obj, ply, stl, fbx or\n"
                    "dae [recognised by its content, if possible]")
        ->type_name("NAME");
    add_confine_flag(command, is_confined_);
}

std::optional<UpAxis> SceneOptions::up() const
{
    return up_.empty() ? std::nullopt : std::optional(parse_up_axis(up_));
}

std::string SceneOptions::format() const
{
    check_input_format(format_);
    return format_;
}

void LimitOptions::add_to(CLI::App& command)
{
    command
        .add_option("--max-memory", memory_,
                    "Most memory that may be used, such as 500M or 4G. Work that needs more\n"
                    "is refused before it begins. [what is free]")
        ->type_name("SIZE");
    command
        .add_option("--max-seconds", seconds_,
                    "Most seconds until the program stops, without an output [no limit]")
        ->type_name("N");
}

WorkLimits LimitOptions::read() const
{
    WorkLimits limits;
    if (!memory_.empty()) {
        const std::optional<uint64_t> bytes = parse_bytes(memory_);
        if (!bytes) {
            throw UsageError(fmt::format("{} is no amount of memory", in_quotes(memory_)), "--max-memory",
                             "write 500M for 500 MiB, or 4G for 4 GiB");
        }
        limits.max_memory_bytes = *bytes;
    }
    if (seconds_) {
        if (!(*seconds_ > 0.0)) {
            throw UsageError("is not more than 0", "--max-seconds", "write the seconds, such as 60");
        }
        limits.max_seconds = *seconds_;
    }
    return limits;
}

std::optional<uint64_t> parse_bytes(std::string_view text)
{
    std::string low = lower_case(text);
    for (const char* unit : {"ib", "b"}) {
        if (low.ends_with(unit)) {
            low.resize(low.size() - std::string_view(unit).size());
            break;
        }
    }
    constexpr std::string_view prefixes = "kmgt";
    double factor = 1.0;
    if (const size_t prefix = low.empty() ? std::string_view::npos : prefixes.find(low.back());
        prefix != std::string_view::npos) {
        factor = std::exp2(10.0 * static_cast<double>(prefix + 1));
        low.pop_back();
    }
    constexpr double most_bytes = 1e18;
    const std::optional<double> number = number_from<double>(low);
    const double bytes = number.value_or(0.0) * factor;
    return bytes >= 1.0 && bytes <= most_bytes ? std::optional(static_cast<uint64_t>(bytes)) : std::nullopt;
}

void add_no_cache_flag(CLI::App& command)
{
    command.add_flag_callback(
        "--no-cache", [] { gpu::keep_pipelines(false); },
        "Compile all shaders again, and keep no compiled shaders on disk");
}

} // namespace estampe::app
