// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/registers.hpp"

#include <bitset>

#include <estampe/error.hpp>
#include <fmt/format.h>

namespace estampe::terrain {
namespace {

/// Calls `visit` with a reference to each register that is read.
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

} // namespace estampe::terrain
