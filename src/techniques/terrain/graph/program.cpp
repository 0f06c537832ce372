// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/program.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "techniques/terrain/whole_cells.hpp"

namespace estampe::terrain {
namespace {

/// A coordinate at the origin: how many whole cells, and the rest.
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

/// What an operation does not read is a register of its own, which holds zeros.
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

} // namespace estampe::terrain
