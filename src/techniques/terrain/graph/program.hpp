// SPDX-License-Identifier: MIT
#pragma once

// A height graph as a list of instructions on dual numbers: what the processor runs, what the interpreter on
// the GPU runs, and what GLSL is written from.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
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

/// Sand that is simulated on the device while the ground is drawn; see slabs/.
struct SandSource {
    double cell_m = 1.0;
    double depth_m = 4.0;
    double start_steps = 400.0; ///< that have passed at time 0
    double steps_per_s = 0.5;
    uint32_t seed = 1;

    bool operator==(const SandSource&) const = default;
};

/// A texture, a mask or simulated sand: heights, row by row.
struct HeightTexture {
    std::string name; ///< as it was written: a file, or a mask's name
    bool is_mask = false;
    uint32_t columns = 0, rows = 0;
    uint32_t first_texel = 0; ///< in Program::texels, where sand is 0
    std::optional<SandSource> sand = {};
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
    std::array<double, shared::height_words_a_place> numbers{};
    std::array<int32_t, 2> cells{};
};

/// Places as seen from an origin (x, z) in metres, at a time in seconds: what is left of them there is small.
[[nodiscard]] std::vector<PlaceWords> place_words(const Program& program, const glm::dvec2& origin_m,
                                                  double time_s);

/// A program as height_program.glsl reads it.
struct ProgramWords {
    std::vector<uint32_t> words; ///< places, parameters, instructions
    uint32_t first_parameter = 0;
    uint32_t first_instruction = 0;
};

[[nodiscard]] ProgramWords program_words(const Program& program, const glm::dvec2& origin_m, double time_s);

} // namespace estampe::terrain
