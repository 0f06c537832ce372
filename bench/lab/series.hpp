// SPDX-License-Identifier: MIT
#pragma once

// What estampe_lab measures: scenes of its own, each by growing amounts of one kind of work.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "core/spread.hpp"

namespace estampe::lab {

/// A picture to draw again and again.
struct BenchPicture {
    Scene scene;
    Camera camera;
    Style style;
    uint32_t width = 0;
    uint32_t height = 0;
    bool moves = false; ///< frames of a film, a sixtieth of a second apart, not stills
};

/// A kind of work.
struct Series {
    const char* name;
    const char* about;
    const char* work;            ///< what is counted, in the plural
    std::vector<double> amounts; ///< ascending; the first is what the others are compared with
    double most_on_processor;    ///< amounts beyond take a processor minutes
    BenchPicture (*picture)(double amount, uint32_t width, uint32_t height);
};

/// All there are, in the order in which they are measured.
[[nodiscard]] const std::vector<Series>& all_series();

/// A floor with balls on it, 8 by 8, of about so many triangles together, under a weak light from everywhere,
/// so that the program adds none of its own.
[[nodiscard]] Scene field_of_balls(double triangles);

/// From where all of it is seen.
[[nodiscard]] Camera view_of_field();

/// Lights spread over the field at random, the same at each call; the first of them throw shadows. Their
/// reach is such that a point gets light of three of them, however many there are, down to a reach of 1 m.
void add_lights(Scene& scene, uint32_t count, uint32_t shadowed);

/// The lights that throw shadows circle once in a second.
void animate_shadowed(Scene& scene, uint32_t shadowed);

/// What one technique took of a frame.
struct TechniqueCost {
    std::string name; ///< of its passes, up to the first slash
    double gpu_ms = 0.0;
};

/// One amount of work.
struct BenchPoint {
    double amount = 0.0;
    Spread gpu_ms;      ///< a frame, its passes side by side
    Spread wall_ms;     ///< the frame as who asks for it sees it, with the way back to the host
    double ratio = 1.0; ///< cost by that of the first amount, frame by frame in turn
    uint64_t memory_bytes = 0;
    std::vector<TechniqueCost> techniques; ///< medians, one pass after another, dearest first
};

struct BenchSeries {
    std::string name;
    std::string work;
    std::vector<BenchPoint> points;
};

struct BenchResult {
    std::string device;
    std::string driver;
    bool software = false; ///< a processor, whose clock of passes is wrong: wall time is the cost
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t frames = 0;
    std::vector<BenchSeries> series;
};

[[nodiscard]] const Spread& cost_of(const BenchPoint& point, bool software);

/// Power of the amount that the cost grows by from one point to the next: 1 where twice the work costs twice
/// as much. 0 for the first.
[[nodiscard]] double growth(const BenchSeries& series, size_t point, bool software);

struct BenchPlan {
    RendererOptions device;
    uint32_t width = 1280;
    uint32_t height = 720;
    uint32_t frames = 9;
    double most_share = 1.0; ///< amounts above so much of a series' greatest are left out
};

/// Draws each amount in turn with the series' first, so that their ratio does not depend on how busy the
/// machine is. `on_point` is told what is about to be measured. Throws Error as Renderer does.
[[nodiscard]] BenchResult measure(const std::vector<const Series*>& series, const BenchPlan& plan,
                                  const std::function<void(const Series&, double amount)>& on_point);

} // namespace estampe::lab
