// SPDX-License-Identifier: MIT
#pragma once

// A height graph as a list of instructions on dual numbers. The CPU runs the instructions with the arithmetic
// of the shaders, the GPU interprets them, or GLSL is generated from them and compiled.

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

#include <estampe/terrain.hpp>

#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

using Instruction = shared::HeightInstruction;

/// A coordinate in the units of a leaf (such as noise), linear in x, z and time.
struct Linear {
    double x = 0.0, z = 0.0, t = 0.0, constant = 0.0;

    bool operator==(const Linear&) const = default;
};

/// The coordinates in which a leaf of the graph (such as noise or a texture) is evaluated.
struct PlaceSource {
    Linear u, v;
    double period_m = 1.0; ///< shortest length of one unit of the leaf (such as noise) on the ground
    /// Units of the leaf (such as noise) per metre of the leaf's coordinate frame, along the coordinates u
    /// and v.
    glm::dvec2 units_per_m{1.0};

    bool operator==(const PlaceSource&) const = default;
};

/// Sand that is simulated on the device between frames, see the folder slabs.
struct SandSource {
    double cell_m = 1.0;
    double depth_m = 4.0;
    double start_steps = 400.0; ///< number of simulated steps that have passed at time 0
    double steps_per_s = 0.5;
    uint32_t seed = 1;

    bool operator==(const SandSource&) const = default;
};

/// Heights in rows of texels: from a texture file, a mask or simulated sand.
struct HeightTexture {
    std::string name; ///< name in the height graph: a texture file, or the name of a mask
    bool is_mask = false;
    uint32_t columns = 0, rows = 0;
    uint32_t first_texel = 0; ///< index of the first texel in Program::texels; 0 for sand
    std::optional<SandSource> sand = {};
};

struct Program {
    std::vector<Instruction> instructions; ///< the last instruction computes the height
    std::vector<double> parameters;
    std::vector<PlaceSource> places;
    std::vector<HeightTexture> textures;
    std::vector<float> texels;

    /// Returns whether two programs differ at most in numbers. Programs that differ only in numbers share
    /// compiled shaders.
    [[nodiscard]] bool has_form_of(const Program& other) const;
};

/// The coordinates of a leaf (such as noise) in the format of height_math.glsl: sixteen words, two of which
/// are whole numbers.
struct PlaceWords {
    std::array<double, shared::height_words_a_place> numbers{};
    std::array<int32_t, 2> cells{};
};

/// Converts the coordinates of a program's leaves so that they are relative to an origin (x, z) in metres and
/// a time in seconds. Coordinates near the origin keep their numbers small.
[[nodiscard]] std::vector<PlaceWords> place_words(const Program& program, const glm::dvec2& origin_m,
                                                  double time_s);

/// A program in the format that height_program.glsl reads.
struct ProgramWords {
    std::vector<uint32_t> words; ///< places first, then parameters, then instructions
    uint32_t first_parameter = 0;
    uint32_t first_instruction = 0;
};

[[nodiscard]] ProgramWords program_words(const Program& program, const glm::dvec2& origin_m, double time_s);

/// Adds slopes to points for a smooth curve (Fritsch and Carlson, "Monotone piecewise cubic interpolation",
/// SIAM J. Numer. Anal. 1980). The curve is monotone wherever the points are, and level at its ends. Returns
/// x, y and slope of each point. Requires at least two points in ascending order of x.
[[nodiscard]] std::vector<double> monotone_curve(std::span<const glm::dvec2> points);

/// Assigns registers to instructions whose inputs are numbers of earlier instructions. A register is reused
/// after the last use of its value. Leaves out instructions on which the instruction number `result` does not
/// depend. Throws Error with `where` if more values are needed together than there are registers. Cost:
/// linear.
[[nodiscard]] std::vector<Instruction> with_registers(const std::vector<Instruction>& in_order,
                                                      uint32_t result, const std::string& where);

struct TextureRequest {
    std::string name; ///< name in the height graph: a texture file, or the name of a mask
    bool is_mask = false;
    uint32_t texels = 0; ///< side of a mask or of a field of sand, in texels
    std::optional<SandSource> sand = {};
};

struct TextureInProgram {
    size_t index = 0;
    double mean = 0.0;
};

/// Finds a texture in `program`, or adds it. Throws Error for a file that cannot be read, for a mask that is
/// requested in two sizes, and if all textures together have more than 2^24 texels. Files are looked up by
/// texture_path() and lie within `terrain.scope`.
[[nodiscard]] TextureInProgram texture_in(Program& program, const TextureRequest& request,
                                          const TerrainDescription& terrain);

/// Returns the path of a texture's file, which is relative to the folder of the terrain's file. An absolute
/// path comes from another computer: only its file name is looked up in the folder.
[[nodiscard]] std::filesystem::path texture_path(const TerrainDescription& terrain, const std::string& name);

/// Evaluates a program on the CPU: returns (height, d/dx, d/dz, d/dt) at `local_m`, relative to the origin of
/// `places`. Leaves out details that are too fine for a grid of `spacing_m`; a spacing of 0 keeps all
/// details. Cost: about 0.1 microseconds per instruction.
[[nodiscard]] glm::dvec4 evaluate(const Program& program, std::span<const PlaceWords> places,
                                  const glm::dvec2& local_m, double spacing_m = 0.0);

/// Evaluates a program on the CPU like evaluate(), but in single precision, as on the GPU.
[[nodiscard]] glm::vec4 evaluate_single(const Program& program, std::span<const PlaceWords> places,
                                        const glm::vec2& local_m, float spacing_m = 0.0F);

/// Returns whether the value of an instruction depends only on constants of the program.
[[nodiscard]] bool depends_on_constants(const Program& program, const Instruction& instruction);

/// Evaluates one instruction on constants. The inputs of the instruction are numbers of instructions in
/// `program`, not registers.
[[nodiscard]] double evaluate_one(const Program& program, const Instruction& instruction);

/// Converts a whole number of cells to the 32 bits of the shaders, with wrap-around.
[[nodiscard]] inline uint32_t wrapped_cells(double whole)
{
    return static_cast<uint32_t>(static_cast<int64_t>(std::fmod(whole, 4294967296.0)));
}

} // namespace estampe::terrain
