// SPDX-License-Identifier: MIT
#pragma once

// What estampe_lab measures: scenes of its own, each by growing amounts of one kind of work.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

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

/// Without a parent.
void add_root(Scene& scene, Node node);

/// The side of its floor.
inline constexpr double field_m = 40.0;

/// From where all of it is seen.
[[nodiscard]] Camera view_of_field();

/// Lights spread over the field at random, the same at each call; the first of them throw shadows. Their
/// reach is such that a point gets light of three of them, however many there are, down to a reach of 1 m.
void add_lights(Scene& scene, uint32_t count, uint32_t shadowed);

/// The lights that throw shadows circle once in a second.
void animate_shadowed(Scene& scene, uint32_t shadowed);

} // namespace estampe::lab
