// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/program.hpp"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/child/child.hpp"
#include "core/exr.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"

namespace estampe::terrain {
namespace {

/// A coordinate at the origin, as a whole number of cells and a remainder.
struct Split {
    int32_t cell = 0;
    double rest = 0.0;
};

Split split_at(const Linear& coordinate, const glm::dvec2& origin_m, double time_s)
{
    const double value =
        coordinate.x * origin_m.x + coordinate.z * origin_m.y + coordinate.t * time_s + coordinate.constant;
    const double whole = std::floor(value);
    return {static_cast<int32_t>(wrapped_cells(whole)), value - whole};
}

uint32_t bits(double number)
{
    return std::bit_cast<uint32_t>(static_cast<float>(number));
}

/// Missing inputs of an operation are read from an extra register, which holds zeros.
uint32_t byte_of(uint32_t number)
{
    return number == shared::height_no_register ? shared::height_register_count : number;
}

} // namespace

bool Program::has_form_of(const Program& other) const
{
    const auto same = [](const Instruction& a, const Instruction& b) {
        return std::memcmp(&a, &b, sizeof(Instruction)) == 0;
    };
    return std::ranges::equal(instructions, other.instructions, same) &&
           parameters.size() == other.parameters.size() && places.size() == other.places.size();
}

std::vector<PlaceWords> place_words(const Program& program, const glm::dvec2& origin_m, double time_s)
{
    std::vector<PlaceWords> result;
    result.reserve(program.places.size());
    for (const PlaceSource& place : program.places) {
        const Split u = split_at(place.u, origin_m, time_s);
        const Split v = split_at(place.v, origin_m, time_s);
        PlaceWords words;
        words.numbers = {place.u.x,      place.u.z,           place.v.x,          place.v.z, u.rest,
                         v.rest,         place.u.t,           place.v.t,          0.0,       0.0,
                         place.period_m, place.units_per_m.x, place.units_per_m.y};
        words.cells = {u.cell, v.cell};
        result.push_back(words);
    }
    return result;
}

ProgramWords program_words(const Program& program, const glm::dvec2& origin_m, double time_s)
{
    ProgramWords result;
    for (const PlaceWords& place : place_words(program, origin_m, time_s)) {
        for (size_t i = 0; i < place.numbers.size(); ++i) {
            const bool is_cell = i == 8 || i == 9;
            result.words.push_back(is_cell ? static_cast<uint32_t>(place.cells[i - 8])
                                           : bits(place.numbers[i]));
        }
    }
    result.first_parameter = static_cast<uint32_t>(result.words.size());
    for (const double parameter : program.parameters) {
        result.words.push_back(bits(parameter));
    }
    result.first_instruction = static_cast<uint32_t>(result.words.size());
    for (const Instruction& i : program.instructions) {
        result.words.push_back(i.op | i.target << 8U | i.count << 16U);
        result.words.push_back(byte_of(i.inputs.x) | byte_of(i.inputs.y) << 8U | byte_of(i.inputs.z) << 16U);
        result.words.push_back(byte_of(i.warp.x) | byte_of(i.warp.y) << 8U | i.place << 16U);
        result.words.push_back(i.parameter);
    }
    return result;
}

std::vector<double> monotone_curve(std::span<const glm::dvec2> points)
{
    const auto rise = [&](size_t i) {
        return (points[i + 1].y - points[i].y) / (points[i + 1].x - points[i].x);
    };
    std::vector<double> result;
    for (size_t i = 0; i < points.size(); ++i) {
        double slope = 0.0;
        if (i > 0 && i + 1 < points.size() && rise(i - 1) * rise(i) > 0.0) {
            const double before = points[i].x - points[i - 1].x;
            const double after = points[i + 1].x - points[i].x;
            // The slope is the weighted harmonic mean of the slopes on both sides. The harmonic mean is at
            // most three times the smaller slope, which is sufficient for a monotone curve.
            const double near = 2.0 * after + before;
            const double far = after + 2.0 * before;
            slope = (near + far) / (near / rise(i - 1) + far / rise(i));
        }
        result.insert(result.end(), {points[i].x, points[i].y, slope});
    }
    return result;
}

namespace {

/// Calls `visit` with a reference to each input register of an instruction.
template <typename Visit>
void for_each_input(Instruction& instruction, const Visit& visit)
{
    for (glm::length_t i = 0; i < 3; ++i) {
        if (instruction.inputs[i] != shared::height_no_register) {
            visit(instruction.inputs[i]);
        }
    }
    for (glm::length_t i = 0; i < 2; ++i) {
        if (instruction.warp[i] != shared::height_no_register) {
            visit(instruction.warp[i]);
        }
    }
}

} // namespace

std::vector<Instruction> with_registers(const std::vector<Instruction>& in_order, uint32_t result,
                                        const std::string& where)
{
    constexpr uint32_t never = 0xffffffffU;
    std::vector<uint32_t> last_reader(in_order.size(), never);
    last_reader[result] = result;
    for (uint32_t number = result + 1; number-- > 0;) {
        if (last_reader[number] == never) {
            continue;
        }
        Instruction instruction = in_order[number];
        for_each_input(instruction, [&](uint32_t& input) {
            if (last_reader[input] == never) {
                last_reader[input] = number;
            }
        });
    }
    std::bitset<shared::height_register_count> taken;
    std::vector<uint32_t> register_of(in_order.size(), 0);
    std::vector<Instruction> placed;
    for (uint32_t number = 0; number <= result; ++number) {
        if (last_reader[number] == never) {
            continue;
        }
        Instruction instruction = in_order[number];
        for_each_input(instruction, [&](uint32_t& input) {
            if (last_reader[input] == number) {
                taken.reset(register_of[input]);
            }
            input = register_of[input];
        });
        uint32_t target = 0;
        while (target < taken.size() && taken.test(target)) {
            ++target;
        }
        if (target == taken.size()) {
            throw Error(fmt::format("the graph holds more than {} values at once", taken.size()), where,
                        "make it simpler, or use a node in fewer places");
        }
        taken.set(target);
        register_of[number] = target;
        instruction.target = target;
        placed.push_back(instruction);
    }
    return placed;
}

namespace {

constexpr size_t most_texels = size_t{1} << 24;

void check_room(const Program& program, size_t added)
{
    if (program.texels.size() + added > most_texels) {
        throw Error("textures of more than 16.7 million texels in all", {}, "make them smaller");
    }
}

/// Heights of a picture file, in rows from the top.
struct PictureHeights {
    uint32_t columns = 0;
    uint32_t rows = 0;
    std::vector<float> texels;
};

template <Either<PictureHeights> T>
auto members(T& heights)
{
    auto& [columns, rows, texels] = heights;
    return std::tie(columns, rows, texels);
}

/// Returns the mean of the colour channels of each pixel of a picture (Image or DeepImage), scaled so that
/// white is 1.
template <class Picture>
PictureHeights heights_of(const Picture& image)
{
    using Value = typename decltype(Picture::rgba)::value_type;
    constexpr auto white = static_cast<float>(3 * std::numeric_limits<Value>::max());
    PictureHeights heights{.columns = image.width, .rows = image.height, .texels = {}};
    for (size_t first = 0; first + 3 < image.rgba.size(); first += 4) {
        const Value* const parts = &image.rgba[first];
        heights.texels.push_back(static_cast<float>(parts[0] + parts[1] + parts[2]) / white);
    }
    return heights;
}

PictureHeights heights_of(const LightImage& image)
{
    PictureHeights heights{.columns = image.width, .rows = image.height, .texels = {}};
    for (const glm::vec3& texel : image.texels) {
        heights.texels.push_back(texel.x);
    }
    return heights;
}

PictureHeights decode_heights(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 30;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes, scope);
    const std::string name = path.string();
    if (is_exr(bytes)) {
        return heights_of(decode_exr(bytes, name).image);
    }
    const std::optional<DeepImage> deep = decode_deep_image(bytes, name);
    return deep ? heights_of(*deep) : heights_of(decode_image(bytes, name));
}

HeightTexture append_file(Program& program, const std::filesystem::path& path, const ReadScope& scope)
{
    const PictureHeights heights = run_in_child([&] { return decode_heights(path, scope); },
                                                limits_for_file(path, scope), path.string());
    if (heights.texels.empty() || heights.texels.size() != uint64_t{heights.columns} * heights.rows) {
        throw Error("what was read from it came back damaged", path.string());
    }
    check_room(program, heights.texels.size());
    program.texels.insert(program.texels.end(), heights.texels.begin(), heights.texels.end());
    return {.columns = heights.columns, .rows = heights.rows};
}

} // namespace

std::filesystem::path texture_path(const TerrainDescription& terrain, const std::string& name)
{
    const std::filesystem::path path(name);
    return terrain.folder / (path.is_absolute() ? path.filename() : path);
}

TextureInProgram texture_in(Program& program, const TextureRequest& request,
                            const TerrainDescription& terrain)
{
    const auto is_same = [&](const HeightTexture& texture) {
        return texture.name == request.name && texture.is_mask == request.is_mask &&
               texture.sand == request.sand;
    };
    auto found = std::ranges::find_if(program.textures, is_same);
    if (found == program.textures.end()) {
        const auto first = static_cast<uint32_t>(program.texels.size());
        HeightTexture texture;
        if (request.texels > 0) {
            check_room(program, size_t{request.texels} * request.texels);
            program.texels.resize(first + size_t{request.texels} * request.texels);
            texture = {.name = request.name,
                       .is_mask = request.is_mask,
                       .columns = request.texels,
                       .rows = request.texels,
                       .sand = request.sand};
        } else {
            texture = append_file(program, texture_path(terrain, request.name), terrain.scope);
            texture.name = request.name;
        }
        texture.first_texel = first;
        program.textures.push_back(texture);
        found = program.textures.end() - 1;
    }
    if (request.is_mask && found->columns != request.texels) {
        throw Error("the mask \"" + request.name + "\" is asked for in two sizes");
    }
    const auto begin = program.texels.begin() + found->first_texel;
    const size_t count = size_t{found->columns} * found->rows;
    const double sum = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(count), 0.0);
    return {.index = static_cast<size_t>(found - program.textures.begin()),
            .mean = request.texels > 0 ? 0.0 : sum / static_cast<double>(count)};
}

namespace {

using glm::clamp;
using std::floor;
using std::max;
using std::sqrt;
using uint = uint32_t;

/// The types and functions that height_math.glsl requires from the file that includes it.
template <typename Real>
struct HeightMath {
    using Real2 = glm::vec<2, Real>;
    using Real4 = glm::vec<4, Real>;

    const Program& program;
    std::span<const PlaceWords> places;

    [[nodiscard]] Real height_number(uint index) const
    {
        return static_cast<Real>(program.parameters[index]);
    }

    [[nodiscard]] Real height_place(uint index) const
    {
        return static_cast<Real>(places[index / 16].numbers[index % 16]);
    }

    [[nodiscard]] int height_cell(uint index) const { return places[index / 16].cells[index % 16 - 8]; }

    [[nodiscard]] Real height_texel(uint index) const { return static_cast<Real>(program.texels[index]); }

#include "techniques/terrain/graph/height_math.glsl"

    Place place_of(const Instruction& i, const Real2& local_m, const Real4* registers)
    {
        if (i.warp.x == shared::height_no_register) {
            return place_at(i.place, local_m.x, local_m.y);
        }
        return place_warped(i.place, local_m.x, local_m.y, registers[i.warp.x], registers[i.warp.y]);
    }

    Real4 leaf(const Instruction& i, const Place& place, Real spacing_m)
    {
        switch (i.op) {
        case shared::height_coordinate_u:
            return coordinate_u(place);
        case shared::height_coordinate_v:
            return coordinate_v(place);
        case shared::height_wave:
            return leaf_sine(place, spacing_m);
        case shared::height_noise:
            return leaf_noise(place, i.parameter, spacing_m);
        case shared::height_fbm:
            return leaf_fbm(place, i.parameter, spacing_m);
        case shared::height_ridged:
            return leaf_ridged(place, i.parameter, spacing_m);
        case shared::height_cellular:
            return leaf_cellular(place, i.parameter, spacing_m);
        case shared::height_texture:
            return leaf_texture(place, i.parameter, spacing_m);
        default:
            return leaf_dunes(place, i.parameter, spacing_m);
        }
    }

    Real4 value(const Instruction& i, const Real4& a, const Real4& b, const Real4& c)
    {
        switch (i.op) {
        case shared::height_constant:
            return dual(height_number(i.parameter));
        case shared::height_add:
            return a + b;
        case shared::height_subtract:
            return a - b;
        case shared::height_multiply:
            return dual_mul(a, b);
        case shared::height_divide:
            return dual_div(a, b);
        case shared::height_minimum:
            return dual_min(a, b);
        case shared::height_maximum:
            return dual_max(a, b);
        case shared::height_lerp:
            return dual_lerp(a, b, c);
        case shared::height_smoothstep:
            return dual_smoothstep(a, b, c);
        case shared::height_power:
            return dual_pow(a, height_number(i.parameter));
        case shared::height_curve:
            return dual_curve(a, i.parameter, i.count);
        case shared::height_sine:
            return dual_sin(a);
        case shared::height_cosine:
            return dual_cos(a);
        case shared::height_absolute:
            return dual_abs(a);
        case shared::height_root:
            return dual_sqrt(a);
        case shared::height_radius:
            return dual_radius(a, b);
        default:
            return dual_angle(a, b);
        }
    }

    Real4 run(const Real2& local_m, Real spacing_m)
    {
        Real4 registers[shared::height_register_count] = {};
        const auto input = [&](uint number) {
            return number == shared::height_no_register ? Real4(0) : registers[number];
        };
        for (const Instruction& i : program.instructions) {
            registers[i.target] = i.op >= shared::height_coordinate_u
                                      ? leaf(i, place_of(i, local_m, registers), spacing_m)
                                      : value(i, input(i.inputs.x), input(i.inputs.y), input(i.inputs.z));
        }
        return registers[program.instructions.back().target];
    }
};

} // namespace

glm::dvec4 evaluate(const Program& program, std::span<const PlaceWords> places, const glm::dvec2& local_m,
                    double spacing_m)
{
    return HeightMath<double>{program, places}.run(local_m, spacing_m);
}

glm::vec4 evaluate_single(const Program& program, std::span<const PlaceWords> places,
                          const glm::vec2& local_m, float spacing_m)
{
    return HeightMath<float>{program, places}.run(local_m, spacing_m);
}

bool depends_on_constants(const Program& program, const Instruction& instruction)
{
    if (instruction.op >= shared::height_coordinate_u) {
        return false;
    }
    for (glm::length_t i = 0; i < 3; ++i) {
        const uint32_t input = instruction.inputs[i];
        if (input != shared::height_no_register &&
            program.instructions[input].op != shared::height_constant) {
            return false;
        }
    }
    return true;
}

double evaluate_one(const Program& program, const Instruction& instruction)
{
    HeightMath<double> math{program, {}};
    const auto input = [&](uint number) {
        return number == shared::height_no_register
                   ? glm::dvec4(0.0)
                   : math.dual(program.parameters[program.instructions[number].parameter]);
    };
    return math
        .value(instruction, input(instruction.inputs.x), input(instruction.inputs.y),
               input(instruction.inputs.z))
        .x;
}

} // namespace estampe::terrain
