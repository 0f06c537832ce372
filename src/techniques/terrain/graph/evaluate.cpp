// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/evaluate.hpp"

#include <cmath>

namespace estampe::terrain {
namespace {

using glm::clamp;
using std::floor;
using std::max;
using std::sqrt;
using uint = uint32_t;

/// What height_math.glsl wants of whoever includes it.
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
