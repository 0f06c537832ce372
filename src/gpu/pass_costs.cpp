// SPDX-License-Identifier: MIT
#include "gpu/pass_costs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/spread.hpp"
#include "gpu/graph/compile.hpp"
#include "gpu/graph/execute.hpp"

namespace estampe::gpu {

void PassHistory::add(const std::vector<PassTiming>& passes)
{
    if (passes.size() != times_.size()) {
        times_.assign(passes.size(), {});
    }
    for (size_t i = 0; i < passes.size(); ++i) {
        times_[i].push_back(passes[i].gpu_ms);
    }
    last_ = passes;
}

std::vector<PassTiming> PassHistory::medians() const
{
    std::vector<PassTiming> result = last_;
    for (size_t i = 0; i < result.size(); ++i) {
        result[i].gpu_ms = median_of(times_[i]);
    }
    return result;
}

// Source: Khronos, "SPIR-V Specification", version 1.6: 2.3 Physical Layout, 3 Binary Form.

namespace {

/// Numbers of SPIR-V opcodes, from the specification.
namespace code {
constexpr uint32_t undefined = 1;
constexpr uint32_t ext_inst = 12;
constexpr uint32_t entry_point = 15;
constexpr uint32_t execution_mode = 16;
constexpr uint32_t type_vector = 23;
constexpr uint32_t type_matrix = 24;
constexpr uint32_t constant_true = 41;
constexpr uint32_t constant_false = 42;
constexpr uint32_t constant = 43;
constexpr uint32_t spec_constant_true = 48;
constexpr uint32_t spec_constant_false = 49;
constexpr uint32_t spec_constant = 50;
constexpr uint32_t spec_constant_op = 52;
constexpr uint32_t function = 54;
constexpr uint32_t function_call = 57;
constexpr uint32_t decorate = 71;
constexpr uint32_t first_composite = 77;
constexpr uint32_t first_conversion = 109;
constexpr uint32_t last_conversion = 118;
constexpr uint32_t integer_add = 128;
constexpr uint32_t integer_subtract = 130;
constexpr uint32_t integer_multiply = 132;
constexpr uint32_t float_mod = 141;
constexpr uint32_t matrix_times_scalar = 143;
constexpr uint32_t vector_times_matrix = 144;
constexpr uint32_t matrix_times_vector = 145;
constexpr uint32_t matrix_times_matrix = 146;
constexpr uint32_t dot = 148;
constexpr uint32_t logical_equal = 164;
constexpr uint32_t logical_not_equal = 165;
constexpr uint32_t logical_or = 166;
constexpr uint32_t logical_and = 167;
constexpr uint32_t logical_not = 168;
constexpr uint32_t select = 169;
constexpr uint32_t equal = 170;
constexpr uint32_t not_equal = 171;
constexpr uint32_t greater = 172;
constexpr uint32_t greater_or_equal = 174;
constexpr uint32_t less = 176;
constexpr uint32_t less_or_equal = 178;
constexpr uint32_t last_comparison = 191;
constexpr uint32_t shift_right = 194;
constexpr uint32_t shift_left = 196;
constexpr uint32_t bitwise_or = 197;
constexpr uint32_t bitwise_xor = 198;
constexpr uint32_t bitwise_and = 199;
constexpr uint32_t bit_count = 205;
constexpr uint32_t label = 248;
constexpr uint32_t branch = 249;
constexpr uint32_t branch_conditional = 250;
constexpr uint32_t switch_to = 251;
} // namespace code

constexpr uint32_t decoration_spec_id = 1;
constexpr uint32_t mode_local_size = 17;
constexpr uint32_t ext_fma = 50;
constexpr uint32_t ext_mix = 46;

struct Instruction {
    uint32_t op = 0;
    std::span<const uint32_t> operands; ///< All words of the instruction except the first

    [[nodiscard]] uint32_t at(size_t i) const
    {
        if (i >= operands.size()) {
            throw std::logic_error("an instruction is too short");
        }
        return operands[i];
    }
};

/// Computes an integer operation on the known operands `a` and `b`; empty if `op` is not supported.
std::optional<uint32_t> value_of(uint32_t op, uint32_t a, uint32_t b)
{
    switch (op) {
    case code::integer_add:
        return a + b;
    case code::integer_subtract:
        return a - b;
    case code::integer_multiply:
        return a * b;
    case code::equal:
    case code::logical_equal:
        return a == b ? 1 : 0;
    case code::not_equal:
    case code::logical_not_equal:
        return a != b ? 1 : 0;
    case code::greater:
        return a > b ? 1 : 0;
    case code::greater_or_equal:
        return a >= b ? 1 : 0;
    case code::less:
        return a < b ? 1 : 0;
    case code::less_or_equal:
        return a <= b ? 1 : 0;
    case code::shift_right:
        return b < 32 ? a >> b : 0;
    case code::shift_left:
        return b < 32 ? a << b : 0;
    case code::bitwise_or:
    case code::logical_or:
        return a | b;
    case code::bitwise_xor:
        return a ^ b;
    case code::bitwise_and:
    case code::logical_and:
        return a & b;
    default:
        return std::nullopt;
    }
}

class Counted {
public:
    Counted(std::span<const uint32_t> words, uint32_t variant) : variant_(variant)
    {
        constexpr uint32_t magic = 0x07230203U;
        constexpr size_t header = 5;
        if (words.size() < header || words[0] != magic) {
            throw std::logic_error("a shader is no SPIR-V");
        }
        for (size_t at = header; at < words.size();) {
            const size_t count = words[at] >> 16U;
            if (count == 0 || count > words.size() - at) {
                throw std::logic_error("a shader ends within an instruction");
            }
            take_in({words[at] & 0xffffU, words.subspan(at + 1, count - 1)});
            at += count;
        }
    }

    [[nodiscard]] ShaderOps ops() { return {.operations = operations_of(entry_), .group = group_}; }

private:
    struct Function {
        /// Basic blocks of the function. The function's first block is its entry; each block includes the
        /// block's label.
        std::vector<std::vector<Instruction>> blocks;
        std::optional<uint64_t> operations;
    };

    void take_in(const Instruction& instruction)
    {
        const auto& [op, operands] = instruction;
        if (op == code::label) {
            block_of_label_[instruction.at(0)] = functions_[here_].blocks.size();
            functions_[here_].blocks.emplace_back();
        } else if (op == code::function) {
            here_ = instruction.at(1);
        } else if (here_ != 0 && !functions_[here_].blocks.empty()) {
            functions_[here_].blocks.back().push_back(instruction);
        } else {
            take_in_global(instruction);
        }
        if (has_result(op)) {
            type_of_[instruction.at(1)] = instruction.at(0);
        }
    }

    void take_in_global(const Instruction& instruction)
    {
        switch (instruction.op) {
        case code::entry_point:
            entry_ = instruction.at(1);
            break;
        case code::execution_mode:
            if (instruction.at(1) == mode_local_size) {
                group_ = {instruction.at(2), instruction.at(3), instruction.at(4)};
            }
            break;
        case code::type_vector:
        case code::type_matrix:
            parts_of_type_[instruction.at(0)] = {instruction.at(1), instruction.at(2)};
            break;
        case code::decorate:
            if (instruction.at(1) == decoration_spec_id && instruction.at(2) == 0) {
                variant_id_ = instruction.at(0);
            }
            break;
        case code::constant_true:
        case code::spec_constant_true:
            known_[instruction.at(1)] = 1;
            break;
        case code::constant_false:
        case code::spec_constant_false:
            known_[instruction.at(1)] = 0;
            break;
        case code::constant:
            known_[instruction.at(1)] = instruction.at(2);
            break;
        case code::spec_constant:
            known_[instruction.at(1)] = instruction.at(1) == variant_id_ ? variant_ : instruction.at(2);
            break;
        case code::spec_constant_op:
            work_out(instruction.at(2), instruction.at(1), instruction.operands.subspan(3));
            break;
        default:
            break;
        }
    }

    /// Whether the operands of instruction `op` begin with a result type and a result id.
    static bool has_result(uint32_t op)
    {
        constexpr std::array without{56U, 62U, 63U, 64U, 99U}; // OpFunctionEnd, stores, copies, image writes
        if (std::ranges::find(without, op) != without.end()) {
            return false;
        }
        return op == code::undefined || (op >= code::constant_true && op <= code::spec_constant_op) ||
               op == code::ext_inst || (op > code::function && op < code::decorate) ||
               (op >= code::first_composite && op <= code::bit_count);
    }

    void work_out(uint32_t op, uint32_t result, std::span<const uint32_t> arguments)
    {
        std::vector<uint32_t> values;
        for (const uint32_t argument : arguments) {
            const auto found = known_.find(argument);
            if (found == known_.end()) {
                return;
            }
            values.push_back(found->second);
        }
        if (op == code::select && values.size() == 3) {
            known_[result] = values[0] != 0 ? values[1] : values[2];
        } else if (op == code::logical_not && values.size() == 1) {
            known_[result] = values[0] == 0 ? 1 : 0;
        } else if (values.size() == 2) {
            if (const auto value = value_of(op, values[0], values[1])) {
                known_[result] = *value;
            }
        }
    }

    [[nodiscard]] uint64_t components(uint32_t type) const
    {
        const auto found = parts_of_type_.find(type);
        return found == parts_of_type_.end() ? 1 : components(found->second.first) * found->second.second;
    }

    [[nodiscard]] uint64_t components_of(uint32_t id) const
    {
        const auto found = type_of_.find(id);
        return found == type_of_.end() ? 1 : components(found->second);
    }

    [[nodiscard]] uint64_t cost(const Instruction& instruction)
    {
        const uint32_t op = instruction.op;
        if (op == code::function_call) {
            return operations_of(instruction.at(2));
        }
        if (op == code::ext_inst) {
            const uint64_t each = instruction.at(3) == ext_fma || instruction.at(3) == ext_mix ? 2 : 1;
            return each * components(instruction.at(0));
        }
        if (op == code::dot) {
            return 2 * components_of(instruction.at(2)) - 1;
        }
        if (op == code::vector_times_matrix) {
            return 2 * components_of(instruction.at(3));
        }
        if (op == code::matrix_times_vector) {
            return 2 * components_of(instruction.at(2));
        }
        if (op == code::matrix_times_matrix) {
            return 2 * components_of(instruction.at(2)) * 4;
        }
        const auto within = [op](uint32_t first, uint32_t last) { return op >= first && op <= last; };
        const bool counts =
            within(code::first_conversion, code::last_conversion) ||
            within(code::integer_add, code::float_mod + 1) || op == code::matrix_times_scalar ||
            within(code::logical_equal, code::last_comparison) || within(code::shift_right, code::bit_count);
        return counts ? components(instruction.at(0)) : 0;
    }

    /// Returns the labels that a block can branch to; if the branch condition is known, returns only the
    /// label that is taken.
    [[nodiscard]] std::vector<uint32_t> targets(const Instruction& end) const
    {
        if (end.op == code::branch) {
            return {end.at(0)};
        }
        if (end.op == code::branch_conditional) {
            const auto found = known_.find(end.at(0));
            if (found != known_.end()) {
                return {found->second != 0 ? end.at(1) : end.at(2)};
            }
            return {end.at(1), end.at(2)};
        }
        if (end.op == code::switch_to) {
            const auto found = known_.find(end.at(0));
            std::vector<uint32_t> all{end.at(1)};
            for (size_t i = 2; i + 1 < end.operands.size(); i += 2) {
                if (found != known_.end() && found->second == end.at(i)) {
                    return {end.at(i + 1)};
                }
                all.push_back(end.at(i + 1));
            }
            return found != known_.end() ? std::vector<uint32_t>{end.at(1)} : all;
        }
        return {};
    }

    uint64_t operations_of(uint32_t id)
    {
        Function& function = functions_[id];
        if (function.operations || function.blocks.empty()) {
            return function.operations.value_or(0);
        }
        uint64_t sum = 0;
        std::set<size_t> seen{0};
        std::vector<size_t> open{0};
        while (!open.empty()) {
            const std::vector<Instruction>& block = function.blocks[open.back()];
            open.pop_back();
            for (const Instruction& instruction : block) {
                sum += cost(instruction);
                if (instruction.op >= code::integer_add && instruction.op <= code::bit_count) {
                    work_out(instruction.op, instruction.at(1), instruction.operands.subspan(2));
                }
            }
            for (const uint32_t label : block.empty() ? std::vector<uint32_t>() : targets(block.back())) {
                const size_t next = block_of_label_.at(label);
                if (seen.insert(next).second) {
                    open.push_back(next);
                }
            }
        }
        function.operations = sum;
        return sum;
    }

    uint32_t variant_;
    uint32_t variant_id_ = 0;
    uint32_t entry_ = 0;
    uint32_t here_ = 0; ///< Id of the function that is being read
    glm::uvec3 group_{1U};
    std::unordered_map<uint32_t, Function> functions_;
    std::unordered_map<uint32_t, size_t> block_of_label_;
    std::unordered_map<uint32_t, uint32_t> known_;   ///< Values of constants, by id
    std::unordered_map<uint32_t, uint32_t> type_of_; ///< Types of results, by id
    /// Component type and number of components of each composite type, by type id.
    std::unordered_map<uint32_t, std::pair<uint32_t, uint32_t>> parts_of_type_;
};

} // namespace

ShaderOps ops_of(std::span<const uint32_t> spirv, uint32_t variant)
{
    return Counted(spirv, variant).ops();
}

namespace {

RunWatch& watching()
{
    static RunWatch watch;
    return watch;
}

double ms_since(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

void watch_runs(RunWatch watch)
{
    watching() = std::move(watch);
}

bool are_runs_watched()
{
    return static_cast<bool>(watching());
}

namespace {

/// Reports the costs of a run to the function that watch_runs() has set.
void tell_run(std::span<const PassWork> passes)
{
    watching()(passes);
}

} // namespace

uint64_t bytes_of(const Graph& graph, const PassRecord& pass)
{
    uint64_t bytes = 0;
    for (const Use& use : pass.uses) {
        if (!use.bound && use.access != Access::transfer_read && use.access != Access::transfer_write &&
            !is_write(use.access)) {
            continue;
        }
        const ResourceRecord& resource = graph.resources()[use.resource];
        const uint64_t once = resource.is_image ? size_bytes(resource.image) : resource.buffer.size_bytes;
        bytes += is_write(use.access) && is_read(use.access) ? 2 * once : once;
    }
    return bytes;
}

std::optional<uint64_t> operations_of(const Graph& graph, const PassRecord& pass)
{
    if (pass.shader != nullptr && pass.dispatch.indirect_resource == UINT32_MAX) {
        const ShaderOps ops = ops_of(pass.shader->spirv, pass.variant);
        const uint64_t groups =
            uint64_t{pass.dispatch.groups_x} * pass.dispatch.groups_y * pass.dispatch.groups_z;
        return ops.operations * groups * ops.group.x * ops.group.y * ops.group.z;
    }
    if (pass.is_raster() && pass.draw.indirect_resource == UINT32_MAX) {
        uint64_t pixels = 0;
        for (const Use& use : pass.uses) {
            const ImageDesc& image = graph.resources()[use.resource].image;
            pixels = is_write(use.access) ? uint64_t{image.width} * image.height : pixels;
        }
        const uint64_t corners = ops_of(pass.draw.vertex->spirv, pass.variant).operations;
        const uint64_t fragments =
            pass.draw.fragment != nullptr ? ops_of(pass.draw.fragment->spirv, pass.variant).operations : 0;
        return corners * pass.draw.vertex_count + fragments * pixels;
    }
    return std::nullopt;
}

void Executor::run_by_passes()
{
    const auto time_ms = [&](const CompiledPass* compiled) {
        begin_commands();
        vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 0);
        if (compiled != nullptr) {
            record_pass(commands_, *compiled);
        }
        vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 1);
        const auto begin = std::chrono::steady_clock::now();
        end_and_run_commands();
        const double wall_ms = ms_since(begin);
        if (device_.info().software) {
            return wall_ms;
        }
        std::array<uint64_t, 2> ticks{};
        vk_check(vkGetQueryPoolResults(device_.handle(), queries_, 0, 2, sizeof(ticks), ticks.data(),
                                       sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                 "vkGetQueryPoolResults");
        return static_cast<double>(ticks[1] - ticks[0]) * device_.timestamp_period_ns() * 1e-6;
    };
    const double empty_ms = device_.info().software ? std::min(time_ms(nullptr), time_ms(nullptr)) : 0.0;
    std::vector<PassWork> works;
    for (const CompiledPass& compiled : compiled_.passes) {
        const PassRecord& pass = graph_->passes()[compiled.pass];
        const double ms = std::max(time_ms(&compiled) - empty_ms, 0.0);
        note_timing(pass.name, ms);
        gpu_ms_ += ms;
        works.push_back({.name = pass.name,
                         .ms = ms,
                         .bytes = bytes_of(*graph_, pass),
                         .operations = operations_of(*graph_, pass)});
    }
    end_timings();
    tell_run(works);
}

} // namespace estampe::gpu
