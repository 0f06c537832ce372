// SPDX-License-Identifier: MIT
#include "gpu/shader_replacements.hpp"

#include <atomic>
#include <deque>
#include <map>
#include <mutex>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "gpu/shader_bindings.hpp"

namespace estampe::gpu {
namespace {

struct Replacement {
    Shader shader;
    bool is_checked = false; ///< against the one it replaces
};

struct Replacements {
    std::atomic<bool> any = false;
    std::mutex guard;
    std::deque<std::vector<uint32_t>> words; ///< of all there ever were: pipelines are known by their place
    std::map<std::string, Replacement> by_name;
};

Replacements& replacements()
{
    static Replacements all;
    return all;
}

/// Throws Error unless what is bound for `shader` does for `other`.
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
