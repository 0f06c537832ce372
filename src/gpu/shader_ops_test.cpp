// SPDX-License-Identifier: MIT
#include "gpu/pass_costs.hpp"

#include <initializer_list>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace estampe::gpu {
namespace {

/// Builds SPIR-V one instruction at a time.
class Assembly {
public:
    Assembly& add(uint32_t op, std::initializer_list<uint32_t> operands)
    {
        words_.push_back(static_cast<uint32_t>(operands.size() + 1) << 16U | op);
        words_.insert(words_.end(), operands);
        return *this;
    }

    [[nodiscard]] const std::vector<uint32_t>& all() const { return words_; }

private:
    std::vector<uint32_t> words_{0x07230203U, 0x00010600U, 0U, 100U, 0U};
};

// Arbitrary SPIR-V result ids.
constexpr uint32_t void_type = 1;
constexpr uint32_t function_type = 2;
constexpr uint32_t float_type = 3;
constexpr uint32_t vec4_type = 4;
constexpr uint32_t uint_type = 5;
constexpr uint32_t bool_type = 6;
constexpr uint32_t variant = 7;
constexpr uint32_t one = 8;
constexpr uint32_t bit = 9;
constexpr uint32_t is_set = 10;
constexpr uint32_t zero = 11;
constexpr uint32_t vector = 20;
constexpr uint32_t entry = 30;

/// Returns the beginning of a shader, up to its first block. `is_set` is the lowest bit of the shader's
/// specialization constant.
Assembly begun()
{
    Assembly words;
    words.add(15, {5, entry, 0x6e69616dU, 0}); // OpEntryPoint "main"
    words.add(16, {entry, 17, 8, 4, 2});       // LocalSize
    words.add(71, {variant, 1, 0});            // SpecId 0
    words.add(19, {void_type}).add(33, {function_type, void_type});
    words.add(22, {float_type, 32}).add(23, {vec4_type, float_type, 4});
    words.add(21, {uint_type, 32, 0}).add(20, {bool_type});
    words.add(50, {uint_type, variant, 0}).add(43, {uint_type, one, 1}).add(43, {uint_type, zero, 0});
    words.add(52, {uint_type, bit, 199, variant, one}); // variant & 1
    words.add(52, {bool_type, is_set, 171, bit, zero}); // != 0
    words.add(1, {vec4_type, vector});                  // OpUndef
    words.add(54, {void_type, entry, 0, function_type}).add(248, {40});
    return words;
}

uint64_t counted(const Assembly& words, uint32_t of_variant = 0)
{
    return ops_of(words.all(), of_variant).operations;
}

TEST(ShaderOps, CountsComponentsOfArithmetic)
{
    Assembly words = begun();
    words.add(129, {vec4_type, 50, vector, vector});                // FAdd: 4
    words.add(148, {float_type, 51, vector, vector});               // Dot: 7
    words.add(12, {vec4_type, 52, 99, 50, vector, vector, vector}); // Fma: 8
    words.add(12, {float_type, 53, 99, 31, 51});                    // Sqrt: 1
    words.add(61, {vec4_type, 54, 98});                             // A load is not counted
    words.add(253, {}).add(56, {});
    const ShaderOps ops = ops_of(words.all(), 0);
    EXPECT_EQ(ops.operations, 4U + 7U + 8U + 1U);
    EXPECT_EQ(ops.group, glm::uvec3(8, 4, 2));
}

TEST(ShaderOps, CountsOfASwitchThatTheVariantDecidesOneSide)
{
    Assembly words = begun();
    words.add(250, {is_set, 41, 42});
    words.add(248, {41}).add(129, {vec4_type, 50, vector, vector}).add(249, {43});
    words.add(248, {42}).add(129, {float_type, 51, 98, 98}).add(249, {43});
    words.add(248, {43}).add(253, {}).add(56, {});
    EXPECT_EQ(counted(words, 1), 4U);
    EXPECT_EQ(counted(words, 2), 1U);
    EXPECT_EQ(counted(words, 3), 4U);
}

TEST(ShaderOps, CountsOfABranchThatDataDecidesBothSides)
{
    Assembly words = begun();
    words.add(180, {bool_type, 60, 98, 98}); // FOrdEqual: 1, with an unknown result
    words.add(250, {60, 41, 42});
    words.add(248, {41}).add(129, {vec4_type, 50, vector, vector}).add(249, {43});
    words.add(248, {42}).add(129, {float_type, 51, 98, 98}).add(249, {43});
    words.add(248, {43}).add(253, {}).add(56, {});
    EXPECT_EQ(counted(words), 6U);
}

TEST(ShaderOps, CountsALoopOnce)
{
    Assembly words = begun();
    words.add(249, {41});
    words.add(248, {41}).add(180, {bool_type, 60, 98, 98}).add(250, {60, 42, 43});
    words.add(248, {42}).add(129, {vec4_type, 50, vector, vector}).add(249, {41});
    words.add(248, {43}).add(253, {}).add(56, {});
    EXPECT_EQ(counted(words), 5U);
}

TEST(ShaderOps, RefusesWhatIsNoShader)
{
    EXPECT_THROW(static_cast<void>(ops_of({}, 0)), std::logic_error);
    Assembly words = begun();
    std::vector<uint32_t> cut = words.all();
    cut.pop_back();
    EXPECT_THROW(static_cast<void>(ops_of(cut, 0)), std::logic_error);
}

} // namespace
} // namespace estampe::gpu
