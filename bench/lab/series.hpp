// SPDX-License-Identifier: MIT
#pragma once

// The measurements of estampe_lab: scenes made for this program, each with growing amounts of one kind of
// work.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "core/spread.hpp"

namespace estampe::lab {

/// A picture that is drawn repeatedly.
struct BenchPicture {
    Scene scene;
    Camera camera;
    Style style;
    uint32_t width = 0;
    uint32_t height = 0;
    bool moves = false; ///< true: frames of a film, a sixtieth of a second apart; false: stills
};

/// A kind of work whose amount grows.
struct Series {
    const char* name;
    const char* about;
    const char* work;            ///< unit of the work, in the plural
    std::vector<double> amounts; ///< ascending; all others are compared with the first
    double most_on_processor;    ///< larger amounts take minutes on a CPU
    BenchPicture (*picture)(double amount, uint32_t width, uint32_t height);
};

/// All series, in the order in which they are measured.
[[nodiscard]] const std::vector<Series>& all_series();

/// A floor with 8 by 8 balls of about `triangles` triangles together. A weak uniform light keeps the program
/// from adding a default light.
[[nodiscard]] Scene field_of_balls(double triangles);

/// A camera that sees the whole field.
[[nodiscard]] Camera view_of_field();

/// Adds lights at random positions over the field, identical at each call. The first `shadowed` lights cast
/// shadows. For any number of lights, the range of each light is set so that three lights reach a point; it
/// is at least 1 m.
void add_lights(Scene& scene, uint32_t count, uint32_t shadowed);

/// Makes the lights that cast shadows circle once per second.
void animate_shadowed(Scene& scene, uint32_t shadowed);

/// GPU time of one technique in a frame.
struct TechniqueCost {
    std::string name; ///< common part of its passes' names, up to the first slash
    double gpu_ms = 0.0;
};

/// The measured cost of one amount of work.
struct BenchPoint {
    double amount = 0.0;
    Spread gpu_ms;      ///< time of a frame whose passes may overlap
    Spread wall_ms;     ///< time until the caller has the frame, including the copy to the host
    double ratio = 1.0; ///< ratio to the cost of the first amount, with alternating frames
    uint64_t memory_bytes = 0;
    std::vector<TechniqueCost> techniques; ///< medians of passes that run alone, most expensive first
};

struct BenchSeries {
    std::string name;
    std::string work;
    std::vector<BenchPoint> points;
};

struct BenchResult {
    std::string device;
    std::string driver;
    bool software = false; ///< the device is a CPU, whose pass times are wrong: wall time is the cost
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t frames = 0;
    std::vector<BenchSeries> series;
};

[[nodiscard]] const Spread& cost_of(const BenchPoint& point, bool software);

/// Exponent of the growth of cost with the amount, from the previous point to this one: 1 if twice the work
/// costs twice as much. 0 for the first point.
[[nodiscard]] double growth(const BenchSeries& series, size_t point, bool software);

struct BenchPlan {
    RendererOptions device;
    uint32_t width = 1280;
    uint32_t height = 720;
    uint32_t frames = 9;
    double most_share = 1.0; ///< leaves out amounts above this share of a series' largest
};

/// Draws each amount alternately with the series' first amount, so that their ratio does not depend on other
/// load on the machine. Calls `on_point` before each measurement. Throws Error as Renderer does.
[[nodiscard]] BenchResult measure(const std::vector<const Series*>& series, const BenchPlan& plan,
                                  const std::function<void(const Series&, double amount)>& on_point);

} // namespace estampe::lab
