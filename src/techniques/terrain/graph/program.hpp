// SPDX-License-Identifier: MIT
#pragma once

// A height graph as a list of instructions on dual numbers. The processor runs it with the arithmetic of the
// shaders, the GPU interprets it, and it is the source of generated GLSL.

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

using Instruction = shared::HeightInstruction;

/// A coordinate in a leaf's own units: linear in x, z and time.
struct Linear {
    double x = 0.0, z = 0.0, t = 0.0, constant = 0.0;

    bool operator==(const Linear&) const = default;
};

/// The coordinates in which a leaf is evaluated.
struct PlaceSource {
    Linear u, v;
    double period_m = 1.0;       ///< finest period of the leaf on the ground
    glm::dvec2 units_per_m{1.0}; ///< units of the leaf per metre of the frame

    bool operator==(const PlaceSource&) const = default;
};

/// Sand that is simulated on the device between frames; see slabs/.
struct SandSource {
    double cell_m = 1.0;
    double depth_m = 4.0;
    double start_steps = 400.0; ///< steps that have passed at time 0
    double steps_per_s = 0.5;
    uint32_t seed = 1;

    bool operator==(const SandSource&) const = default;
};

/// A texture, a mask or simulated sand: heights, row by row.
struct HeightTexture {
    std::string name; ///< as written in the graph: a file, or the name of a mask
    bool is_mask = false;
    uint32_t columns = 0, rows = 0;
    uint32_t first_texel = 0; ///< index in Program::texels; 0 for sand
    std::optional<SandSource> sand = {};
};

struct Program {
    std::vector<Instruction> instructions; ///< the last one computes the height
    std::vector<double> parameters;
    std::vector<PlaceSource> places;
    std::vector<HeightTexture> textures;
    std::vector<float> texels;

    /// Returns whether the programs only differ in numbers. Programs of the same form share compiled shaders.
    [[nodiscard]] bool has_form_of(const Program& other) const;
};

/// A place as height_math.glsl reads it: sixteen words, two of which are whole numbers.
struct PlaceWords {
    std::array<double, shared::height_words_a_place> numbers{};
    std::array<int32_t, 2> cells{};
};

/// Converts the program's places to be relative to an origin (x, z) in metres and a time in seconds, so that
/// their numbers stay small.
[[nodiscard]] std::vector<PlaceWords> place_words(const Program& program, const glm::dvec2& origin_m,
                                                  double time_s);

/// A program as height_program.glsl reads it.
struct ProgramWords {
    std::vector<uint32_t> words; ///< places, parameters, instructions
    uint32_t first_parameter = 0;
    uint32_t first_instruction = 0;
};

[[nodiscard]] ProgramWords program_words(const Program& program, const glm::dvec2& origin_m, double time_s);

/// Adds slopes to points, for a smooth curve that is monotone wherever the points are (Fritsch and Carlson,
/// "Monotone piecewise cubic interpolation", SIAM J. Numer. Anal. 1980) and level at its ends. Returns x, y,
/// slope of each point. Needs at least two points, in ascending order of x.
[[nodiscard]] std::vector<double> monotone_curve(std::span<const glm::dvec2> points);

/// Assigns registers to instructions whose inputs are numbers of earlier instructions. A register is free
/// again after its last use. Leaves out instructions on which `result`, the number of the last requested
/// instruction, does not depend. Throws Error with `where` when more values are needed at once than there are
/// registers. Cost: linear.
[[nodiscard]] std::vector<Instruction> with_registers(const std::vector<Instruction>& in_order,
                                                      uint32_t result, const std::string& where);

struct TextureRequest {
    std::string name; ///< a file, or the name of a mask
    bool is_mask = false;
    uint32_t texels = 0; ///< side of a mask or of sand, in texels
    std::optional<SandSource> sand = {};
};

struct TextureInProgram {
    size_t index = 0;
    double mean = 0.0;
};

/// Finds a texture in `program`, or adds it. Throws Error for a file that cannot be read, for a mask that is
/// requested in two sizes, and when all textures together have more than 2^24 texels. File names are relative
/// to `folder`.
[[nodiscard]] TextureInProgram texture_in(Program& program, const TextureRequest& request,
                                          const std::filesystem::path& folder);

/// Returns (height, d/dx, d/dz, d/dt) at `local_m` from the origin that `places` were made for. Leaves out
/// forms that are too fine for a grid of `spacing_m`; 0 leaves out none. Cost: about 0.1 microseconds per
/// instruction.
[[nodiscard]] glm::dvec4 evaluate(const Program& program, std::span<const PlaceWords> places,
                                  const glm::dvec2& local_m, double spacing_m = 0.0);

/// Computes evaluate() in the single precision of the GPU.
[[nodiscard]] glm::vec4 evaluate_single(const Program& program, std::span<const PlaceWords> places,
                                        const glm::vec2& local_m, float spacing_m = 0.0F);

/// Evaluates an instruction on constants. Its inputs are numbers of instructions of `program`, not registers.
[[nodiscard]] double evaluate_one(const Program& program, const Instruction& instruction);

/// Converts a whole number of cells to the shaders' 32 bits, with wrap-around.
[[nodiscard]] inline uint32_t wrapped_cells(double whole)
{
    return static_cast<uint32_t>(static_cast<int64_t>(std::fmod(whole, 4294967296.0)));
}

} // namespace estampe::terrain
