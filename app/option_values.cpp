// SPDX-License-Identifier: MIT
#include "option_values.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "text.hpp"
#include "usage_error.hpp"

namespace estampe::app {
namespace {

constexpr const char* camera_syntax =
    "write \"eye=x,y,z target=x,y,z fov=degrees\", or a camera's name, or auto";

template <typename Number>
std::optional<Number> parse_number(std::string_view text)
{
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    return problem == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

[[noreturn]] void fail_camera(const std::string& what)
{
    throw UsageError(what, "--camera", camera_syntax);
}

/// Looks at the origin unless told otherwise.
Camera parse_placement(const std::string& text)
{
    try {
        return estampe::parse_camera(text.find("target=") == std::string::npos ? text + " target=0,0,0"
                                                                               : text);
    } catch (const Error& problem) {
        throw UsageError(problem.what(), "--camera");
    }
}

} // namespace

std::pair<uint32_t, uint32_t> parse_size(const std::string& text)
{
    const size_t cross = text.find('x');
    const auto width = parse_number<uint32_t>(std::string_view(text).substr(0, cross));
    const auto height = cross == std::string::npos
                            ? std::nullopt
                            : parse_number<uint32_t>(std::string_view(text).substr(cross + 1));
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
    } else if (text.find("eye=") != std::string::npos || text.find("target=") != std::string::npos ||
               text.find("fov=") != std::string::npos) {
        choice.kind = CameraChoice::Kind::placed;
        choice.placed = parse_placement(text);
    } else if (text.empty()) {
        fail_camera("is empty");
    } else {
        choice.kind = CameraChoice::Kind::named;
        choice.name = text;
    }
    return choice;
}

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
    if (text != "auto" && text != "cpu" && !parse_number<uint32_t>(text)) {
        throw UsageError(fmt::format("{} is not a device", in_quotes(text)), "--device",
                         "write auto, cpu, or an index that estampe devices lists");
    }
}

void check_count(const char* option, uint32_t count, uint32_t most)
{
    if (count < 1 || count > most) {
        throw UsageError(fmt::format("{} is out of range", count), option,
                         fmt::format("allowed: 1 to {}", most));
    }
}

Style read_style(const std::string& name, const std::vector<std::string>& assignments)
{
    Style style = name.empty() ? Style() : Style::load(name);
    for (const std::string& assignment : assignments) {
        try {
            style.set(assignment);
        } catch (const Error& problem) {
            throw UsageError(problem.what());
        }
    }
    return style;
}

} // namespace estampe::app
