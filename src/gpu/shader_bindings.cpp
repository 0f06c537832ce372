// SPDX-License-Identifier: MIT
// Source: Khronos, "SPIR-V Specification", version 1.6: 2.3 Physical Layout, 3 Binary Form.
#include "gpu/shader_bindings.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::gpu {
namespace {

constexpr uint32_t magic_number = 0x07230203U;
constexpr size_t header_words = 5;

enum Op : uint32_t {
    op_type_int = 21,
    op_type_float = 22,
    op_type_image = 25,
    op_type_sampled_image = 27,
    op_type_array = 28,
    op_type_runtime_array = 29,
    op_type_struct = 30,
    op_type_pointer = 32,
    op_constant = 43,
    op_variable = 59,
    op_decorate = 71,
};

enum Decoration : uint32_t { decoration_binding = 33, decoration_set = 34 };

enum StorageClass : uint32_t { class_uniform_constant = 0, class_uniform = 2, class_storage_buffer = 12 };

constexpr uint32_t dim_buffer = 5;
constexpr uint32_t image_is_sampled = 1;

/// All words of a SPIR-V instruction except the first.
using Operands = std::span<const uint32_t>;

struct Type {
    Op op = op_type_struct;
    Operands operands; ///< Operands of the instruction, beginning with the result id
};

/// The parts of a SPIR-V module that describe its bindings.
struct Module {
    std::unordered_map<uint32_t, Type> types;
    std::unordered_map<uint32_t, uint32_t> constants;
    std::unordered_map<uint32_t, uint32_t> binding_of_variable;
    std::unordered_map<uint32_t, uint32_t> set_of_variable;
    /// The id of each variable, and the id of its pointer type.
    std::vector<std::pair<uint32_t, uint32_t>> variables;
};

void take_in(Module& module, uint32_t op, Operands operands)
{
    switch (op) {
    case op_type_int:
    case op_type_float:
    case op_type_image:
    case op_type_sampled_image:
    case op_type_array:
    case op_type_runtime_array:
    case op_type_struct:
    case op_type_pointer:
        module.types[operands[0]] = {static_cast<Op>(op), operands};
        break;
    case op_constant:
        module.constants[operands[1]] = operands[2];
        break;
    case op_variable:
        module.variables.emplace_back(operands[1], operands[0]);
        break;
    case op_decorate:
        if (operands[1] == decoration_binding) {
            module.binding_of_variable[operands[0]] = operands[2];
        } else if (operands[1] == decoration_set) {
            module.set_of_variable[operands[0]] = operands[2];
        }
        break;
    default:
        break;
    }
}

Module read_module(const Shader& shader)
{
    const std::span<const uint32_t> words = shader.spirv;
    if (words.size() < header_words || words[0] != magic_number) {
        throw std::logic_error(fmt::format("shader '{}' is no SPIR-V", shader.name));
    }
    Module module;
    for (size_t at = header_words; at < words.size();) {
        const size_t count = words[at] >> 16U;
        if (count == 0 || count > words.size() - at) {
            throw std::logic_error(fmt::format("shader '{}' ends within an instruction", shader.name));
        }
        take_in(module, words[at] & 0xffffU, words.subspan(at + 1, count - 1));
        at += count;
    }
    return module;
}

TexelKind texel_kind(const Module& module, uint32_t type)
{
    const Type& component = module.types.at(type);
    if (component.op == op_type_float) {
        return TexelKind::real;
    }
    return component.operands[2] != 0 ? TexelKind::signed_whole : TexelKind::unsigned_whole;
}

/// Converts an OpTypeImage to a binding. The operands of OpTypeImage are: result, component, dimensions,
/// depth, arrayed, multisampled, sampled, format.
Binding image_binding(const Module& module, Operands image)
{
    const bool is_sampled_image = image[6] == image_is_sampled;
    if (image[2] == dim_buffer) {
        return is_sampled_image
                   ? Binding{.kind = BindingKind::texel_buffer, .texel = texel_kind(module, image[1])}
                   : Binding();
    }
    return is_sampled_image
               ? Binding{.kind = BindingKind::sampled_image, .texel = texel_kind(module, image[1])}
               : Binding{.kind = BindingKind::storage_image, .image_format = image[7]};
}

Binding declared_binding(const Module& module, uint32_t pointer)
{
    const Operands pointer_operands = module.types.at(pointer).operands;
    const uint32_t storage_class = pointer_operands[1];
    const Type* type = &module.types.at(pointer_operands[2]);
    uint32_t count = 1;
    if (type->op == op_type_array || type->op == op_type_runtime_array) {
        count = type->op == op_type_array ? module.constants.at(type->operands[2]) : 0;
        type = &module.types.at(type->operands[1]);
    }
    Binding binding;
    if (storage_class == class_storage_buffer) {
        binding.kind = BindingKind::storage_buffer;
    } else if (storage_class == class_uniform) {
        binding.kind = BindingKind::uniform_buffer;
    } else if (storage_class == class_uniform_constant && type->op == op_type_sampled_image) {
        binding = image_binding(module, module.types.at(type->operands[1]).operands);
    } else if (storage_class == class_uniform_constant && type->op == op_type_image) {
        binding = image_binding(module, type->operands);
    }
    binding.count = count;
    return binding;
}

bool is_whole(Format format)
{
    return format == Format::r32ui || format == Format::rg32ui || format == Format::rgba32ui;
}

TexelKind texel_kind(Format format)
{
    return is_whole(format) ? TexelKind::unsigned_whole : TexelKind::real;
}

struct NamedFormat {
    Format format;
    uint32_t number;
    const char* name;
};

/// Formats of storage images, each with SPIR-V's number and name.
constexpr std::array named_formats{NamedFormat{Format::r32ui, 33, "r32ui"},
                                   NamedFormat{Format::rg32ui, 35, "rg32ui"},
                                   NamedFormat{Format::rgba32ui, 30, "rgba32ui"},
                                   NamedFormat{Format::rgba8, 4, "rgba8"},
                                   NamedFormat{Format::r8, 15, "r8"},
                                   NamedFormat{Format::r16f, 9, "r16f"},
                                   NamedFormat{Format::rg16f, 7, "rg16f"},
                                   NamedFormat{Format::rgba16f, 2, "rgba16f"},
                                   NamedFormat{Format::r32f, 3, "r32f"},
                                   NamedFormat{Format::rgba32f, 1, "rgba32f"}};

uint32_t image_format(Format format)
{
    for (const NamedFormat& named : named_formats) {
        if (named.format == format) {
            return named.number;
        }
    }
    return 0;
}

std::string name_of_format(uint32_t number)
{
    for (const NamedFormat& named : named_formats) {
        if (named.number == number) {
            return named.name;
        }
    }
    return fmt::format("format {}", number);
}

const char* name_of(TexelKind kind)
{
    switch (kind) {
    case TexelKind::real:
        return "real numbers";
    case TexelKind::signed_whole:
        return "signed numbers";
    case TexelKind::unsigned_whole:
        return "unsigned numbers";
    case TexelKind::none:
        break;
    }
    return "nothing";
}

std::string element_in_words(const Binding& binding)
{
    switch (binding.kind) {
    case BindingKind::storage_buffer:
        return "storage buffer";
    case BindingKind::uniform_buffer:
        return "uniform buffer";
    case BindingKind::texel_buffer:
        return fmt::format("texel buffer of {}", name_of(binding.texel));
    case BindingKind::sampled_image:
        return fmt::format("sampled image of {}", name_of(binding.texel));
    case BindingKind::storage_image:
        return fmt::format("storage image of {}", name_of_format(binding.image_format));
    case BindingKind::other:
        break;
    }
    return "something that no pass can bind";
}

/// Returns the bindings that the shader declares, by binding number. Unused declarations are missing if the
/// compiler removed them. Throws std::logic_error if the shader's words are not SPIR-V.
///
/// Cost    linear in words, about 50 us for a large shader
/// Source  Khronos, "SPIR-V Specification", version 1.6
std::map<uint32_t, Binding> bindings_of(const Shader& shader)
{
    const Module module = read_module(shader);
    std::map<uint32_t, Binding> bindings;
    for (const auto& [variable, pointer] : module.variables) {
        const auto number = module.binding_of_variable.find(variable);
        if (number == module.binding_of_variable.end()) {
            continue;
        }
        Binding binding = declared_binding(module, pointer);
        const auto set = module.set_of_variable.find(variable);
        binding.set = set != module.set_of_variable.end() ? set->second : 0;
        bindings[number->second] = binding;
    }
    return bindings;
}

/// Returns the binding that a pass sets when it uses `resource` in this way.
Binding binding_of(const Use& use, const ResourceRecord& resource)
{
    if (resource.is_image) {
        const Format format = resource.image.format;
        return is_sampled(use.access)
                   ? Binding{.kind = BindingKind::sampled_image, .texel = texel_kind(format)}
                   : Binding{.kind = BindingKind::storage_image, .image_format = image_format(format)};
    }
    if (is_sampled(use.access)) {
        return {.kind = BindingKind::texel_buffer, .texel = texel_kind(use.texel)};
    }
    return {.kind = is_uniform(use.access) ? BindingKind::uniform_buffer : BindingKind::storage_buffer};
}

/// Describes a binding, such as "storage image of r16f" or "texel buffer of unsigned numbers".
std::string in_words(const Binding& binding)
{
    std::string words = element_in_words(binding);
    if (binding.count != 1) {
        words += binding.count > 0 ? fmt::format(", {} of them", binding.count) : ", any number of them";
    }
    if (binding.set != 0) {
        words += fmt::format(", in set {}", binding.set);
    }
    return words;
}

/// Returns the resource use with this binding number; null if the pass has fewer bindings.
const Use* bound_at(const PassRecord& pass, uint32_t number)
{
    for (const Use& use : pass.uses) {
        if (use.bound && number-- == 0) {
            return &use;
        }
    }
    return nullptr;
}

} // namespace

const std::map<uint32_t, Binding>& BindingCheck::declared_by(const Shader& shader)
{
    const auto known = declared_.find(shader.spirv.data());
    return known != declared_.end()
               ? known->second
               : declared_.emplace(shader.spirv.data(), bindings_of(shader)).first->second;
}

void BindingCheck::check(const Graph& graph, const PassRecord& pass)
{
    for (const Shader* shader : {pass.shader, pass.draw.vertex, pass.draw.fragment}) {
        if (shader == nullptr) {
            continue;
        }
        for (const auto& [number, declared] : declared_by(*shader)) {
            const Use* const bound = bound_at(pass, number);
            if (bound == nullptr) {
                throw std::logic_error(
                    fmt::format("pass '{}' binds {} resources: shader '{}' declares a {} at binding {}",
                                pass.name, std::ranges::count(pass.uses, true, &Use::bound), shader->name,
                                in_words(declared), number));
            }
            const ResourceRecord& resource = graph.resources()[bound->resource];
            const Binding given = binding_of(*bound, resource);
            if (given != declared) {
                throw std::logic_error(fmt::format(
                    "pass '{}' binds '{}' at binding {} as a {}: shader '{}' declares a {}", pass.name,
                    resource.name, number, in_words(given), shader->name, in_words(declared)));
            }
        }
    }
}

namespace {

struct Replacement {
    Shader shader;
    bool is_checked = false; ///< The bindings of the replacement were checked against the original shader
};

struct Replacements {
    std::atomic<bool> any = false;
    std::mutex guard;
    /// SPIR-V of all replacements ever made. No entry is ever removed, because pipelines are identified by
    /// the address of their SPIR-V.
    std::deque<std::vector<uint32_t>> words;
    std::map<std::string, Replacement> by_name;
};

Replacements& replacements()
{
    static Replacements all;
    return all;
}

/// Throws Error unless the bindings for `shader` are also valid for `other`.
void check_bindings_alike(const Shader& shader, const Shader& other)
{
    const std::map<uint32_t, Binding> own = bindings_of(shader);
    for (const auto& [number, declared] : bindings_of(other)) {
        const auto found = own.find(number);
        if (found == own.end() || found->second != declared) {
            throw Error(fmt::format("{} now declares a {} at binding {}, where the program has none for it",
                                    shader.name, in_words(declared), number),
                        {}, "build the program anew");
        }
    }
}

} // namespace

void replace_shader(const std::string& name, std::vector<uint32_t> spirv)
{
    Replacements& all = replacements();
    const std::lock_guard lock(all.guard);
    all.by_name.erase(name);
    if (!spirv.empty()) {
        all.words.push_back(std::move(spirv));
        all.by_name[name] = {.shader = {nullptr, all.words.back()}};
        all.any = true;
    }
}

Shader current_build(const Shader& shader)
{
    Replacements& all = replacements();
    if (!all.any) {
        return shader;
    }
    const std::lock_guard lock(all.guard);
    const auto found = all.by_name.find(shader.name);
    if (found == all.by_name.end()) {
        return shader;
    }
    const Shader other{shader.name, found->second.shader.spirv};
    if (!found->second.is_checked) {
        found->second.is_checked = true;
        try {
            check_bindings_alike(shader, other);
        } catch (...) {
            all.by_name.erase(found);
            throw;
        }
    }
    return other;
}

} // namespace estampe::gpu
