// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/glsl.hpp"

#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/file.hpp"
#include "output/child.hpp"

namespace estampe::terrain {
namespace {

std::string place_of(const Instruction& i)
{
    if (i.warp.x == shared::height_no_register) {
        return fmt::format("place_at({}u, local_m.x, local_m.y)", i.place);
    }
    return fmt::format("place_warped({}u, local_m.x, local_m.y, r{}, r{})", i.place, i.warp.x, i.warp.y);
}

std::string leaf_of(const Instruction& i)
{
    const char* name = nullptr;
    switch (i.op) {
    case shared::height_coordinate_u:
        return fmt::format("coordinate_u({})", place_of(i));
    case shared::height_coordinate_v:
        return fmt::format("coordinate_v({})", place_of(i));
    case shared::height_wave:
        return fmt::format("leaf_sine({}, spacing_m)", place_of(i));
    case shared::height_noise:
        name = "noise";
        break;
    case shared::height_fbm:
        name = "fbm";
        break;
    case shared::height_ridged:
        name = "ridged";
        break;
    case shared::height_cellular:
        name = "cellular";
        break;
    case shared::height_texture:
        name = "texture";
        break;
    default:
        name = "dunes";
    }
    return fmt::format("leaf_{}({}, {}u, spacing_m)", name, place_of(i), i.parameter);
}

std::string value_of(const Instruction& i)
{
    const uint32_t a = i.inputs.x;
    const uint32_t b = i.inputs.y;
    const uint32_t c = i.inputs.z;
    const auto call = [&](const char* name) { return fmt::format("{}(r{})", name, a); };
    const auto call_two = [&](const char* name) { return fmt::format("{}(r{}, r{})", name, a, b); };
    const auto call_three = [&](const char* name) { return fmt::format("{}(r{}, r{}, r{})", name, a, b, c); };
    switch (i.op) {
    case shared::height_constant:
        return fmt::format("dual(height_number({}u))", i.parameter);
    case shared::height_add:
        return fmt::format("r{} + r{}", a, b);
    case shared::height_subtract:
        return fmt::format("r{} - r{}", a, b);
    case shared::height_multiply:
        return call_two("dual_mul");
    case shared::height_divide:
        return call_two("dual_div");
    case shared::height_minimum:
        return call_two("dual_min");
    case shared::height_maximum:
        return call_two("dual_max");
    case shared::height_lerp:
        return call_three("dual_lerp");
    case shared::height_smoothstep:
        return call_three("dual_smoothstep");
    case shared::height_power:
        return fmt::format("dual_pow(r{}, height_number({}u))", a, i.parameter);
    case shared::height_curve:
        return fmt::format("dual_curve(r{}, {}u, {}u)", a, i.parameter, i.count);
    case shared::height_sine:
        return call("dual_sin");
    case shared::height_cosine:
        return call("dual_cos");
    case shared::height_absolute:
        return call("dual_abs");
    case shared::height_root:
        return call("dual_sqrt");
    case shared::height_radius:
        return call_two("dual_radius");
    default:
        return call_two("dual_angle");
    }
}

/// Words and their name, at a place in memory that stays.
struct Compiled {
    std::string name;
    std::vector<uint32_t> words;
    gpu::Shader shader{};
};

std::vector<uint32_t> spirv_of(const std::string& text, const std::string& name)
{
    const AtomicFile words = AtomicFile::file(std::filesystem::temp_directory_path() / (name + ".spv"));
    output::Child compiler(
        {"glslc", "--target-env=vulkan1.3", "-O", "-fshader-stage=compute", "-o", words.path().string(), "-"},
        "install glslc");
    const bool is_read = compiler.write(std::as_bytes(std::span(text)));
    if (!compiler.finish() || !is_read) {
        throw Error(fmt::format("glslc refuses the height graph: {}", compiler.complaint()));
    }
    const std::vector<std::byte> bytes = read_file(words.path());
    std::vector<uint32_t> result(bytes.size() / sizeof(uint32_t));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(uint32_t));
    return result;
}

} // namespace

std::string height_glsl(const Program& program)
{
    std::string text = fmt::format("uint first_parameter()\n{{\n    return {}u;\n}}\n\n",
                                   shared::height_words_a_place * program.places.size());
    text += "vec4 height_at(vec2 local_m, float spacing_m)\n{\n    vec4 r0";
    for (uint32_t i = 1; i < shared::height_register_count; ++i) {
        text += fmt::format(", r{}", i);
    }
    text += ";\n";
    for (const Instruction& i : program.instructions) {
        text += fmt::format("    r{} = {};\n", i.target,
                            i.op >= shared::height_coordinate_u ? leaf_of(i) : value_of(i));
    }
    return text + fmt::format("    return r{};\n}}\n", program.instructions.back().target);
}

const gpu::Shader& compiled_with(const Program& program, const std::string& shader_name,
                                 const std::string& shader_text)
{
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<Compiled>> known;
    const std::string marker = "HEIGHT_PROGRAM";
    std::string text = shader_text;
    text.replace(text.find(marker), marker.size(), height_glsl(program));
    {
        const std::lock_guard lock(mutex);
        if (const auto found = known.find(text); found != known.end()) {
            return found->second->shader;
        }
    }
    auto made = std::make_unique<Compiled>();
    made->name = shader_name;
    made->words = spirv_of(text, shader_name);
    made->shader = {made->name.c_str(), made->words};
    const std::lock_guard lock(mutex);
    return known.try_emplace(std::move(text), std::move(made)).first->second->shader;
}

} // namespace estampe::terrain
