// SPDX-License-Identifier: MIT
#include "gpu/shader_bindings.hpp"

#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include "gpu/graph/graph_test_support.hpp"

namespace estampe::gpu {
namespace {

using Words = std::vector<uint32_t>;

/// Builds a SPIR-V module that has only the requested declarations, in the order of the calls. Types and
/// variables get consecutive ids.
class Assembler {
public:
    /// Declares a buffer of one word, with the storage class of storage buffers (12) or uniform buffers (2).
    Assembler& buffer(uint32_t number, uint32_t storage_class)
    {
        const uint32_t block = type(30, {natural_});
        return variable(number, storage_class, block);
    }

    /// `dim` is 1 for two dimensions or 5 for a buffer; `sampled` is 1, or 2 for storage.
    Assembler& image(uint32_t number, bool is_whole, uint32_t dim, uint32_t sampled, uint32_t format,
                     uint32_t count = 1)
    {
        uint32_t held = type(25, {is_whole ? natural_ : real_, dim, 0, 0, 0, sampled, format});
        if (sampled == 1) {
            held = type(27, {held});
        }
        if (count != 1) {
            const uint32_t length = next_++;
            put(43, {natural_, length, count});
            held = type(28, {held, length});
        }
        return variable(number, 0, held);
    }

    [[nodiscard]] Shader shader() const { return {"made.comp", words_}; }

    void put(uint32_t op, const Words& operands)
    {
        words_.push_back((static_cast<uint32_t>(operands.size()) + 1) << 16U | op);
        words_.insert(words_.end(), operands.begin(), operands.end());
    }

private:
    uint32_t type(uint32_t op, Words operands)
    {
        operands.insert(operands.begin(), next_);
        put(op, operands);
        return next_++;
    }

    Assembler& variable(uint32_t number, uint32_t storage_class, uint32_t held)
    {
        const uint32_t pointer = type(32, {storage_class, held});
        const uint32_t made = next_++;
        put(71, {made, 34, 0});
        put(71, {made, 33, number});
        put(59, {pointer, made, storage_class});
        return *this;
    }

    Words words_{0x07230203U, 0x00010600U, 0, 1000, 0};
    uint32_t next_ = 1;
    uint32_t natural_ = type(21, {32, 0});
    uint32_t real_ = type(22, {32});
};

/// Builds a shader with a uniform buffer, a texel buffer, an image, a storage image and a storage buffer, in
/// that order.
Assembler shader_of_five()
{
    Assembler made;
    made.buffer(0, 2)
        .image(1, true, 5, 1, 0)
        .image(2, false, 1, 1, 0)
        .image(3, false, 1, 2, 9) // r16f
        .buffer(4, 12);
    return made;
}

PassRecord pass_of_five(Graph& graph, const Shader& shader, Format stored = Format::r16f)
{
    auto buffer = [&](const char* name) { return graph.buffer(name, {.size_bytes = 64}); };
    auto pass = graph.compute("five", shader);
    pass.uniform(buffer("globals")).sample(buffer("records")).sample(graph.image("light", small_image));
    std::ignore = pass.write(graph.image("ink", {.width = 32, .height = 16, .format = stored}));
    std::ignore = pass.write(buffer("list"));
    return graph.passes().back();
}

std::string complaint(const Graph& graph, const PassRecord& pass)
{
    try {
        BindingCheck().check(graph, pass);
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

TEST(CheckBindings, AreRightWhereBothSidesAgree)
{
    const Assembler made = shader_of_five();
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)), "");
}

TEST(CheckBindings, NameAResourceOfTheWrongKind)
{
    Assembler made;
    made.buffer(0, 12);
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)),
              "pass 'five' binds 'globals' at binding 0 as a uniform buffer: shader 'made.comp' declares a "
              "storage buffer");
}

TEST(CheckBindings, NameTexelsOfTheWrongKind)
{
    Assembler made;
    made.image(1, false, 5, 1, 0);
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)),
              "pass 'five' binds 'records' at binding 1 as a texel buffer of unsigned numbers: shader "
              "'made.comp' declares a texel buffer of real numbers");
}

TEST(CheckBindings, NameAnImageOfAnotherFormat)
{
    const Assembler made = shader_of_five();
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(
        complaint(graph, pass_of_five(graph, shader, Format::r32ui)),
        "pass 'five' binds 'ink' at binding 3 as a storage image of r32ui: shader 'made.comp' declares a "
        "storage image of r16f");
}

TEST(CheckBindings, NameAnArrayThatNoPassBinds)
{
    Assembler made;
    made.image(2, false, 1, 1, 0, 3);
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)),
              "pass 'five' binds 'light' at binding 2 as a sampled image of real numbers: shader 'made.comp' "
              "declares a sampled image of real numbers, 3 of them");
}

TEST(CheckBindings, NameWhatAPassForgets)
{
    Assembler made = shader_of_five();
    made.buffer(5, 12);
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)),
              "pass 'five' binds 5 resources: shader 'made.comp' declares a storage buffer at binding 5");
}

TEST(CheckBindings, AreRightWhereTheCompilerLeftSomeOut)
{
    const Assembler made = Assembler().buffer(0, 2).buffer(4, 12);
    const Shader shader = made.shader();
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)), "");
}

TEST(CheckBindings, AreRightWhereOneShaderOfTwoDeclaresThem)
{
    const Assembler vertex = Assembler().buffer(0, 12);
    const Assembler fragment = Assembler().buffer(1, 12);
    const Shader of_corners = vertex.shader();
    const Shader of_pixels = fragment.shader();
    Graph graph;
    auto pass = graph.raster("draw", of_corners, of_pixels);
    pass.read(graph.buffer("vertices", {.size_bytes = 64})).read(graph.buffer("draws", {.size_bytes = 64}));
    EXPECT_EQ(complaint(graph, graph.passes().back()), "");
}

TEST(CheckBindings, LookAtBothShadersOfARasterPass)
{
    const Assembler vertex = Assembler().buffer(0, 12);
    const Assembler fragment = Assembler().buffer(0, 2);
    const Shader right = vertex.shader();
    const Shader wrong = fragment.shader();
    Graph graph;
    auto pass = graph.raster("draw", right, wrong);
    pass.read(graph.buffer("vertices", {.size_bytes = 64}));
    EXPECT_EQ(complaint(graph, graph.passes().back()),
              "pass 'draw' binds 'vertices' at binding 0 as a storage buffer: shader 'made.comp' declares a "
              "uniform buffer");
}

TEST(CheckBindings, RefuseWordsThatAreNoShader)
{
    Graph graph;
    EXPECT_EQ(complaint(graph, pass_of_five(graph, fake_shader)), "shader 'fake.comp' is no SPIR-V");
    Assembler cut;
    cut.put(71, {});
    Words words(cut.shader().spirv.begin(), cut.shader().spirv.end());
    words.back() = 9U << 16U | 71U; // The instruction claims nine words; eight are missing
    const Shader shader{"cut.comp", words};
    EXPECT_EQ(complaint(graph, pass_of_five(graph, shader)), "shader 'cut.comp' ends within an instruction");
}

} // namespace
} // namespace estampe::gpu
