// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/program_words.hpp"

#include <bit>

namespace estampe::terrain {
namespace {

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
