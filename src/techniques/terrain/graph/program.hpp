// SPDX-License-Identifier: MIT
#pragma once

// A height graph as a list of instructions on dual numbers: what the processor runs, what the interpreter on
// the GPU runs, and what GLSL is written from.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/terrain/graph/program.glsl.h"

namespace estampe::terrain {

using Instruction = shared::HeightInstruction;

/// A coordinate: linear in x, z and time, in the leaf's own units.
struct Linear {
    double x = 0.0, z = 0.0, t = 0.0, constant = 0.0;

    bool operator==(const Linear&) const = default;
};

/// Where a leaf looks itself up.
struct PlaceSource {
    Linear u, v;
    double period_m = 1.0;       ///< of the finest that the leaf shows, on the ground
    glm::dvec2 units_per_m{1.0}; ///< from metres of the frame

    bool operator==(const PlaceSource&) const = default;
};

/// A texture or a mask: heights, row by row.
struct HeightTexture {
    std::string name; ///< as it was written: a file, or a mask's name
    bool is_mask = false;
    uint32_t columns = 0, rows = 0;
    uint32_t first_texel = 0; ///< in Program::texels
};

struct Program {
    std::vector<Instruction> instructions; ///< the last one makes the height
    std::vector<double> parameters;
    std::vector<PlaceSource> places;
    std::vector<HeightTexture> textures;
    std::vector<float> texels;

    /// Programs of the same form differ in numbers alone, and share what was compiled of them.
    [[nodiscard]] bool has_form_of(const Program& other) const;
};

/// A place as height_math.glsl reads it, sixteen words, of which two are whole numbers.
struct PlaceWords {
    std::array<double, 16> numbers{};
    std::array<int32_t, 2> cells{};
};

/// Places as seen from an origin (x, z) in metres, at a time in seconds: what is left of them there is small.
[[nodiscard]] std::vector<PlaceWords> place_words(const Program& program, const glm::dvec2& origin_m,
                                                  double time_s);

} // namespace estampe::terrain
