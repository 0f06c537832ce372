// SPDX-License-Identifier: MIT
#pragma once

// A height graph as a list of instructions on dual numbers: what the processor runs, by the very arithmetic
// of the shaders, what the interpreter on the GPU runs, and what GLSL is written from.

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

/// Points with the slopes of a smooth curve through them that rises and falls where they do and nowhere else
/// (Fritsch and Carlson, "Monotone piecewise cubic interpolation", SIAM J. Numer. Anal. 1980), level at its
/// ends: x, y, slope one after the other. At least two points, from left to right.
[[nodiscard]] std::vector<double> monotone_curve(std::span<const glm::dvec2> points);

/// Instructions whose inputs are numbers of instructions before them, given registers, of which there are
/// few: each is free again after its last reader. Leaves out what `result`, the number of the last one that
/// is wanted, does not hang on. Throws Error with `where` when more values are alive at once than there are
/// registers. Cost: linear.
[[nodiscard]] std::vector<Instruction> with_registers(const std::vector<Instruction>& in_order,
                                                      uint32_t result, const std::string& where);

struct TextureRequest {
    std::string name; ///< a file, or a mask's name
    bool is_mask = false;
    uint32_t texels = 0; ///< of a mask or of sand, each way
    std::optional<SandSource> sand = {};
};

struct TextureInProgram {
    size_t index = 0;
    double mean = 0.0;
};

/// The texture in `program`, put there if it is not yet. Throws Error for a file that cannot be read, for a
/// mask that is asked for in two sizes, and where all of them hold more than 2^24 texels. `folder` is what
/// files are looked up in.
[[nodiscard]] TextureInProgram texture_in(Program& program, const TextureRequest& request,
                                          const std::filesystem::path& folder);

/// (height, d/dx, d/dz, d/dt) at `local_m` from the origin that `places` were made for. `spacing_m`: what is
/// finer than a grid of it is left out; 0 for all. Cost: about 0.1 microseconds an instruction.
[[nodiscard]] glm::dvec4 evaluate(const Program& program, std::span<const PlaceWords> places,
                                  const glm::dvec2& local_m, double spacing_m = 0.0);

/// What evaluate() computes, in the single precision of the GPU.
[[nodiscard]] glm::vec4 evaluate_single(const Program& program, std::span<const PlaceWords> places,
                                        const glm::vec2& local_m, float spacing_m = 0.0F);

/// What an instruction makes of constants: its inputs are numbers of instructions of `program`, not
/// registers.
[[nodiscard]] double evaluate_one(const Program& program, const Instruction& instruction);

/// A whole number of cells as shaders count them: beyond what 32 bits hold they go round.
[[nodiscard]] inline uint32_t wrapped_cells(double whole)
{
    return static_cast<uint32_t>(static_cast<int64_t>(std::fmod(whole, 4294967296.0)));
}

} // namespace estampe::terrain
