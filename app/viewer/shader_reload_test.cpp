// SPDX-License-Identifier: MIT
#include "viewer/reload.hpp"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/shader_bindings.hpp"
#include "support/folder.hpp"

namespace estampe::viewer {
namespace {

constexpr const char* shader_text = R"(#version 460
#include "shaders/two.glsl"
layout(local_size_x = 64) in;
layout(binding = 0) buffer Numbers { uint numbers[]; };
void main() { numbers[gl_GlobalInvocationID.x] = two(); }
)";

void write(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

TEST(ShaderReload, CompilesWithItsIncludesAndSaysWhatIsWrong)
{
    const test::Folder folder;
    const std::filesystem::path shader = folder.path() / "techniques/a/fill.comp";
    write(shader, shader_text);
    write(folder.path() / "shaders/two.glsl", "uint two() { return 2; }\n");
    const std::vector<ShaderBuild> builds = builds_of(shader, folder.path());
    ASSERT_EQ(builds.size(), 1U);
    const ShaderNews right = compile_shader(builds.front(), folder.path());
    EXPECT_EQ(right.name, "fill_comp");
    EXPECT_EQ(right.problem, "");
    ASSERT_FALSE(right.spirv.empty());
    EXPECT_EQ(right.spirv.front(), 0x07230203U);
    EXPECT_EQ(includes_of(shader, folder.path()),
              std::set<std::filesystem::path>{folder.path() / "shaders/two.glsl"});

    write(folder.path() / "shaders/two.glsl", "uint two() { return tow; }\n");
    const ShaderNews wrong = compile_shader(builds.front(), folder.path());
    EXPECT_TRUE(wrong.spirv.empty());
    EXPECT_NE(wrong.problem.find("shaders/two.glsl:1"), std::string::npos) << wrong.problem;
    std::filesystem::remove(folder.path() / "shaders/two.glsl");
    EXPECT_NE(compile_shader(builds.front(), folder.path()).problem, "");
}

TEST(ShaderReload, AFileOfVariantsIsCompiledToEachWithItsMacros)
{
    const std::filesystem::path root = "/sources/src";
    const std::filesystem::path corner = root / "techniques/raster/hardware/corner.vert";
    const std::vector<ShaderBuild> builds = builds_of(corner, root);
    EXPECT_EQ(builds,
              (std::vector<ShaderBuild>{
                  {.file = corner, .name = "corner_vert", .macros = {}},
                  {.file = corner, .name = "corner_listed_vert", .macros = {"LISTED_BINDING=2"}},
                  {.file = corner, .name = "corner_listed_behind_vert", .macros = {"LISTED_BINDING=11"}}}));

    const test::Folder folder;
    const std::filesystem::path fill = folder.path() / "fill.comp";
    write(fill, "#version 460\nlayout(local_size_x = ACROSS) in;\n#ifndef FILLS\n#error no "
                "fill\n#endif\nvoid main() {}\n");
    EXPECT_EQ(
        compile_shader({.file = fill, .name = "fill_16", .macros = {"FILLS", "ACROSS=16"}}, folder.path())
            .problem,
        "");
    EXPECT_NE(
        compile_shader({.file = fill, .name = "fill_16", .macros = {"ACROSS=16"}}, folder.path()).problem,
        "");
}

TEST(ShaderReload, AReplacementStandsForItsShaderIfItBindsTheSame)
{
    const test::Folder folder;
    write(folder.path() / "fill.comp", shader_text);
    write(folder.path() / "shaders/two.glsl", "uint two() { return 2; }\n");
    const std::vector<uint32_t> words =
        compile_shader({.file = folder.path() / "fill.comp", .name = "fill_comp", .macros = {}},
                       folder.path())
            .spirv;
    const gpu::Shader own{"fill_comp", words};
    EXPECT_EQ(gpu::current_build(own).spirv.data(), words.data());
    gpu::replace_shader("fill_comp", words);
    const gpu::Shader other = gpu::current_build(own);
    EXPECT_NE(other.spirv.data(), words.data());
    EXPECT_TRUE(std::ranges::equal(other.spirv, words));

    std::string elsewhere = shader_text;
    elsewhere.at(elsewhere.find("binding = 0") + 10) = '1';
    write(folder.path() / "fill.comp", elsewhere);
    gpu::replace_shader(
        "fill_comp", compile_shader({.file = folder.path() / "fill.comp", .name = "fill_comp", .macros = {}},
                                    folder.path())
                         .spirv);
    EXPECT_THROW(static_cast<void>(gpu::current_build(own)), Error) << "a binding that no pass fills";
    EXPECT_EQ(gpu::current_build(own).spirv.data(), words.data());
    gpu::replace_shader("fill_comp", words);
    gpu::replace_shader("fill_comp", {});
    EXPECT_EQ(gpu::current_build(own).spirv.data(), words.data());
}

} // namespace
} // namespace estampe::viewer
