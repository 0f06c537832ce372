// SPDX-License-Identifier: MIT
#include "techniques/terrain/trails/trails.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/text.hpp"

namespace estampe {
namespace {

constexpr size_t most_places = 1000;
constexpr double longest_m = 10000.0;

[[noreturn]] void fail(const std::string& word, const std::string& where, const std::string& why)
{
    throw Error(fmt::format("\"{}\" {}", word, why), where,
                "a track is \"x,z x,z ... [pace=1.4] [start=0] [stride=0.75] [foot=0.4] [depth=0.07] "
                "[drag=0]\" in metres and seconds");
}

double number_in(std::string_view text, const std::string& word, const std::string& where)
{
    const std::optional<double> value = number_from<double>(text);
    if (!value || !std::isfinite(*value)) {
        fail(word, where, "is no number");
    }
    return *value;
}

struct Setting {
    std::string_view name;
    double least;
    double most;
    double TerrainTrack::*value;
};

constexpr std::array settings{
    Setting{"pace", 0.01, 100.0, &TerrainTrack::pace_m_per_s},
    Setting{"stride", 0.05, 10.0, &TerrainTrack::stride_m}, Setting{"foot", 0.02, 5.0, &TerrainTrack::foot_m},
    Setting{"depth", 0.001, 2.0, &TerrainTrack::depth_m}, Setting{"drag", 0.0, 10.0, &TerrainTrack::drag_m}};

void set(TerrainTrack& track, const std::string& word, const std::string& where)
{
    const size_t equals = word.find('=');
    const std::string_view name = std::string_view(word).substr(0, equals);
    const double value = number_in(std::string_view(word).substr(equals + 1), word, where);
    if (name == "start") {
        track.start_s = value;
        return;
    }
    const auto* const setting = std::ranges::find(settings, name, &Setting::name);
    if (setting == settings.end()) {
        fail(word, where, "is nothing that a track has");
    }
    if (value < setting->least || value > setting->most) {
        fail(word, where, fmt::format("is not from {} to {}", setting->least, setting->most));
    }
    track.*setting->value = value;
}

} // namespace

TrailStamp TrailStamp::disc(glm::dvec2 place_m, float radius_m, float depth_m)
{
    return drag(place_m, place_m, radius_m, depth_m);
}

TrailStamp TrailStamp::drag(glm::dvec2 from_m, glm::dvec2 to_m, float radius_m, float depth_m)
{
    return {.from_m = from_m,
            .to_m = to_m,
            .from_radius_m = radius_m,
            .to_radius_m = radius_m,
            .depth_m = depth_m};
}

TrailStamp TrailStamp::foot(glm::dvec2 place_m, glm::dvec2 towards, float length_m, float depth_m)
{
    constexpr double heel = 0.13; // radius of a footprint's heel, relative to the length of the foot
    constexpr double ball = 0.18;
    const double length = glm::length(towards);
    const glm::dvec2 ahead =
        static_cast<double>(length_m) * (length > 0.0 ? towards / length : glm::dvec2(1.0, 0.0));
    return {.from_m = place_m - (0.5 - heel) * ahead,
            .to_m = place_m + (0.5 - ball) * ahead,
            .from_radius_m = static_cast<float>(heel) * length_m,
            .to_radius_m = static_cast<float>(ball) * length_m,
            .depth_m = depth_m};
}

TerrainTrack parse_track(const std::string& text, const std::string& name, const std::string& where)
{
    TerrainTrack track{.name = name};
    std::istringstream words(text);
    double length_m = 0.0;
    for (std::string word; words >> word;) {
        if (word.find('=') != std::string::npos) {
            set(track, word, where);
            continue;
        }
        const size_t comma = word.find(',');
        if (comma == std::string::npos) {
            fail(word, where, "is no place");
        }
        const glm::dvec2 place(number_in(std::string_view(word).substr(0, comma), word, where),
                               number_in(std::string_view(word).substr(comma + 1), word, where));
        if (!track.path_m.empty()) {
            length_m += glm::length(place - track.path_m.back());
        }
        track.path_m.push_back(place);
    }
    if (track.path_m.size() < 2 || !(length_m > 0.0)) {
        fail(text, where, "goes nowhere");
    }
    if (track.path_m.size() > most_places || length_m > longest_m) {
        fail(name, where, fmt::format("is longer than {} places or {} m", most_places, longest_m));
    }
    return track;
}

std::string track_text(const TerrainTrack& track)
{
    std::string text;
    for (const glm::dvec2& place : track.path_m) {
        text += fmt::format("{}{},{}", text.empty() ? "" : " ", place.x, place.y);
    }
    const TerrainTrack plain;
    for (const Setting& setting : settings) {
        if (track.*setting.value != plain.*setting.value) {
            text += fmt::format(" {}={}", setting.name, track.*setting.value);
        }
    }
    return track.start_s ? fmt::format("{} start={}", text, *track.start_s) : text;
}

namespace terrain {
namespace {

/// Points on a track's curve, a few centimetres apart, and their distances along the curve.
struct Curve {
    std::vector<glm::dvec2> places_m;
    std::vector<double> along_m;

    [[nodiscard]] glm::dvec2 at(double along) const
    {
        const auto after = std::ranges::upper_bound(along_m, along);
        const auto i = static_cast<size_t>(std::clamp<std::ptrdiff_t>(
            after - along_m.begin(), 1, static_cast<std::ptrdiff_t>(along_m.size()) - 1));
        const double share = (along - along_m[i - 1]) / std::max(along_m[i] - along_m[i - 1], 1e-12);
        return glm::mix(places_m[i - 1], places_m[i], share);
    }
};

Curve curve_through(const std::vector<glm::dvec2>& path_m)
{
    constexpr double part_m = 0.1;
    Curve curve{.places_m = {path_m.front()}, .along_m = {0.0}};
    for (size_t i = 0; i + 1 < path_m.size(); ++i) {
        const glm::dvec2 a = path_m[i];
        const glm::dvec2 b = path_m[i + 1];
        const glm::dvec2 before = i > 0 ? path_m[i - 1] : 2.0 * a - b;
        const glm::dvec2 after = i + 2 < path_m.size() ? path_m[i + 2] : 2.0 * b - a;
        const int parts = 1 + static_cast<int>(glm::length(b - a) / part_m);
        for (int k = 1; k <= parts; ++k) {
            const double t = static_cast<double>(k) / parts;
            const glm::dvec2 place =
                0.5 * (2.0 * a + t * (b - before) + t * t * (2.0 * before - 5.0 * a + 4.0 * b - after) +
                       t * t * t * (3.0 * (a - b) + after - before));
            curve.along_m.push_back(curve.along_m.back() + glm::length(place - curve.places_m.back()));
            curve.places_m.push_back(place);
        }
    }
    return curve;
}

/// Widens the stamp of a foot, because loose sand falls in around a foot.
TrailStamp in_loose_sand(TrailStamp foot)
{
    foot.from_radius_m *= 1.6F;
    foot.to_radius_m *= 1.5F;
    return foot;
}

/// The direction of `way` as a unit vector; the x axis if `way` is zero.
glm::dvec2 direction_of(const glm::dvec2& way)
{
    const double length = glm::length(way);
    return length > 0.0 ? way / length : glm::dvec2(1.0, 0.0);
}

} // namespace

std::vector<TimedStamp> stamps_of(const TerrainTrack& track)
{
    const Curve curve = curve_through(track.path_m);
    const double length_m = curve.along_m.back();
    const double start_s = track.start_s.value_or(-length_m / track.pace_m_per_s);
    const bool is_dragged = track.drag_m > 0.0;
    const double step_m = is_dragged ? std::max(track.drag_m, 0.1) : track.stride_m;
    std::mt19937 random; // always starts with the same seed, so that every track has the same random sequence
    const auto by_chance = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    std::vector<TimedStamp> stamps;
    for (int step = 0; step * step_m <= length_m; ++step) {
        const double along = step * step_m;
        const glm::dvec2 place = curve.at(along);
        const double ahead_m = std::min(along + 0.1, length_m);
        const glm::dvec2 towards = direction_of(curve.at(ahead_m) - curve.at(ahead_m - 0.2));
        TimedStamp stamp{.time_s = start_s + along / track.pace_m_per_s};
        if (is_dragged) {
            stamp.stamp =
                TrailStamp::drag(place, curve.at(std::min(along + step_m, length_m)),
                                 static_cast<float>(0.5 * track.drag_m), static_cast<float>(track.depth_m));
        } else {
            const double side = step % 2 == 0 ? 1.0 : -1.0;
            const glm::dvec2 across(-towards.y, towards.x);
            const double aside_m = track.foot_m * (0.35 + 0.08 * by_chance());
            const double along_m = 0.06 * track.stride_m * by_chance();
            const glm::dvec2 there = place + side * aside_m * across + along_m * towards;
            const glm::dvec2 pointing = towards + side * (0.12 + 0.1 * by_chance()) * across;
            stamp.stamp = in_loose_sand(TrailStamp::foot(there, pointing, static_cast<float>(track.foot_m),
                                                         static_cast<float>(track.depth_m)));
        }
        stamps.push_back(stamp);
    }
    return stamps;
}

} // namespace terrain
} // namespace estampe
