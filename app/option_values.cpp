// SPDX-License-Identifier: MIT
#include "option_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>

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

std::optional<double> parse_finite(std::string_view text)
{
    const std::optional<double> number = parse_number<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<glm::dvec3> parse_point(std::string_view text)
{
    const size_t first = text.find(',');
    const size_t second = first == std::string_view::npos ? first : text.find(',', first + 1);
    if (second == std::string_view::npos) {
        return std::nullopt;
    }
    const auto x = parse_finite(text.substr(0, first));
    const auto y = parse_finite(text.substr(first + 1, second - first - 1));
    const auto z = parse_finite(text.substr(second + 1));
    return x && y && z ? std::optional(glm::dvec3(*x, *y, *z)) : std::nullopt;
}

[[noreturn]] void fail_camera(const std::string& what)
{
    throw UsageError(what, "--camera", camera_syntax);
}

/// An `up` that is not the direction of view, for cameras that look straight down or up.
glm::dvec3 up_for(const glm::dvec3& direction)
{
    constexpr double parallel = 1.0e-6;
    const glm::dvec3 up{0.0, 1.0, 0.0};
    return glm::length(glm::cross(glm::normalize(direction), up)) > parallel ? up
                                                                             : glm::dvec3{0.0, 0.0, -1.0};
}

Camera parse_placement(const std::string& text)
{
    Camera camera;
    bool has_eye = false;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::string_view value =
            std::string_view(word).substr(std::min(word.size(), word.find('=') + 1));
        const auto point = parse_point(value);
        if (word.starts_with("eye=") && point) {
            camera.eye = *point;
            has_eye = true;
        } else if (word.starts_with("target=") && point) {
            camera.target = *point;
        } else if (const auto degrees = parse_finite(value); word.starts_with("fov=") && degrees) {
            if (*degrees < 1.0 || *degrees > 170.0) {
                throw UsageError(fmt::format("fov={} is out of range", value), "--camera",
                                 "allowed: 1 to 170 degrees");
            }
            camera.vertical_fov_rad = *degrees * std::numbers::pi / 180.0;
        } else {
            fail_camera(fmt::format("cannot read {}", in_quotes(word)));
        }
    }
    if (!has_eye) {
        fail_camera("no eye is given");
    }
    if (camera.eye == camera.target) {
        fail_camera("eye and target are the same point");
    }
    camera.up = up_for(camera.target - camera.eye);
    return camera;
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
