// SPDX-License-Identifier: MIT
#include "viewer/reload.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "output/child.hpp"
#include "shaders/variant_table.hpp"

namespace estampe::viewer {

FileWatch::State FileWatch::state_of(const std::filesystem::path& file)
{
    std::error_code problem;
    State state;
    state.time = std::filesystem::last_write_time(file, problem);
    state.size_bytes = problem ? 0 : std::filesystem::file_size(file, problem);
    return problem ? State{} : state;
}

void FileWatch::watch(const std::vector<std::filesystem::path>& files)
{
    std::map<std::filesystem::path, Watched> next;
    for (const std::filesystem::path& file : files) {
        const auto known = files_.find(file);
        const State now = state_of(file);
        next.emplace(file, known != files_.end() ? known->second : Watched{now, now});
    }
    files_ = std::move(next);
}

std::vector<std::filesystem::path> FileWatch::changed()
{
    std::vector<std::filesystem::path> changed;
    for (auto& [file, watched] : files_) {
        const State now = state_of(file);
        const bool is_still = now == watched.seen;
        watched.seen = now;
        if (is_still && now != watched.known && now != State{}) {
            watched.known = now;
            changed.push_back(file);
        }
    }
    return changed;
}

std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene)
{
    constexpr size_t most_files = 400;
    static constexpr std::array<std::string_view, 9> kinds{".bin", ".png",  ".jpg", ".jpeg", ".webp",
                                                           ".mtl", ".ktx2", ".tga", ".exr"};
    std::vector<std::filesystem::path> files{scene};
    std::error_code problem;
    const std::filesystem::path folder = scene.has_parent_path() ? scene.parent_path() : ".";
    auto entry = std::filesystem::recursive_directory_iterator(
        folder, std::filesystem::directory_options::skip_permission_denied, problem);
    for (; !problem && entry != std::filesystem::recursive_directory_iterator() && files.size() < most_files;
         entry.increment(problem)) {
        std::error_code entry_problem;
        if (entry.depth() >= 1) {
            entry.disable_recursion_pending();
        }
        if (entry->is_regular_file(entry_problem) &&
            std::ranges::find(kinds, lower_extension(entry->path())) != kinds.end()) {
            files.push_back(entry->path());
        }
    }
    return files;
}

namespace {

namespace fs = std::filesystem;

std::string source_of(const fs::path& file)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 22U;
    const std::vector<std::byte> bytes = read_file(file, largest_bytes);
    std::string text(bytes.size(), '\0');
    std::memcpy(text.data(), bytes.data(), bytes.size());
    return text;
}

/// Finds an include file in the same way as glslc does: beside the including file, then from the root.
std::optional<fs::path> found_include(const std::string& name, const fs::path& from, const fs::path& root)
{
    for (const fs::path& folder : {from.parent_path(), root}) {
        std::error_code problem;
        const fs::path path = (folder / name).lexically_normal();
        if (fs::is_regular_file(path, problem)) {
            return path;
        }
    }
    return std::nullopt;
}

std::string name_of(const fs::path& file)
{
    std::string name = file.filename().string();
    std::ranges::replace(name, '.', '_');
    return name;
}

bool has_entry_point(const fs::path& file)
{
    static constexpr std::array<std::string_view, 3> stages{".comp", ".vert", ".frag"};
    return std::ranges::find(stages, file.extension().string()) != stages.end();
}

bool is_shader_text(const fs::path& file)
{
    return has_entry_point(file) || file.extension() == ".glsl" || file.string().ends_with(".glsl.h");
}

/// Returns the first error line of the compiler: "hatch/lines.comp:12: error: ...".
std::string first_problem(const std::string& messages, const fs::path& root)
{
    std::string line = messages.substr(0, messages.find('\n'));
    const std::string prefix = root.string() + "/";
    if (line.starts_with(prefix)) {
        line.erase(0, prefix.size());
    }
    return line;
}

} // namespace

std::vector<ShaderBuild> builds_of(const fs::path& file, const fs::path& root)
{
    std::vector<ShaderBuild> builds;
    const std::string source = file.lexically_relative(root).generic_string();
    for (const shaders::Variant& variant : shaders::variants) {
        if (source == variant.source) {
            builds.push_back({.file = file, .name = variant.name, .macros = {}});
            std::istringstream macros(variant.macros);
            for (std::string macro; std::getline(macros, macro, ';');) {
                builds.back().macros.push_back(macro);
            }
        }
    }
    if (builds.empty()) {
        builds.push_back({.file = file, .name = name_of(file), .macros = {}});
    }
    return builds;
}

ShaderNews compile_shader(const ShaderBuild& build, const fs::path& root)
{
    ShaderNews news{.name = build.name};
    try {
        const AtomicFile words =
            AtomicFile::file(fs::temp_directory_path() / ("estampe-" + news.name + ".spv"));
        std::vector<std::string> command{"glslc",      "--target-env=vulkan1.3", "-O0", "-Werror", "-I",
                                         root.string()};
        for (const std::string& macro : build.macros) {
            command.push_back("-D" + macro);
        }
        command.insert(command.end(), {"-o", words.path().string(), build.file.string()});
        output::Child compiler(command, "install glslc");
        if (compiler.finish()) {
            const std::vector<std::byte> bytes = read_file(words.path());
            news.spirv.resize(bytes.size() / sizeof(uint32_t));
            std::memcpy(news.spirv.data(), bytes.data(), news.spirv.size() * sizeof(uint32_t));
        } else {
            news.problem = first_problem(compiler.complaint(), root);
        }
    } catch (const Error& problem) {
        news.problem = problem.what();
    }
    return news;
}

std::set<fs::path> includes_of(const fs::path& file, const fs::path& root)
{
    std::set<fs::path> found;
    std::vector<fs::path> open{file};
    while (!open.empty()) {
        const fs::path from = open.back();
        open.pop_back();
        std::istringstream lines(source_of(from));
        for (std::string line; std::getline(lines, line);) {
            const size_t first = line.find('"');
            const size_t last = line.rfind('"');
            if (line.find("#include") == std::string::npos || first == std::string::npos || last == first) {
                continue;
            }
            const auto path = found_include(line.substr(first + 1, last - first - 1), from, root);
            if (path && found.insert(*path).second) {
                open.push_back(*path);
            }
        }
    }
    return found;
}

ShaderReload::ShaderReload(const fs::path& folder, std::function<void()> wake) : wake_(std::move(wake))
{
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(folder, problem);
    root_ = fs::is_directory(whole / "src", problem) ? whole / "src" : whole;
    find_files();
    if (shaders_.empty()) {
        throw Error("holds no shaders", folder.string(), "give --shaders the folder of Estampe's sources");
    }
    watch_.watch(all_);
    thread_ = std::thread([this] { work(); });
}

ShaderReload::~ShaderReload()
{
    is_closing_ = true;
    thread_.join();
}

void ShaderReload::find_files()
{
    std::error_code problem;
    auto entry =
        fs::recursive_directory_iterator(root_, fs::directory_options::skip_permission_denied, problem);
    for (; !problem && entry != fs::recursive_directory_iterator(); entry.increment(problem)) {
        if (is_shader_text(entry->path())) {
            all_.push_back(entry->path());
            if (has_entry_point(entry->path())) {
                std::ranges::move(builds_of(entry->path(), root_), std::back_inserter(shaders_));
            }
        }
    }
}

void ShaderReload::compile(const ShaderBuild& build)
{
    ShaderNews news = compile_shader(build, root_);
    {
        const std::lock_guard lock(guard_);
        news_.push_back(std::move(news));
    }
    wake_();
}

void ShaderReload::work()
{
    constexpr std::chrono::milliseconds between_looks(60);
    while (!is_closing_) {
        std::this_thread::sleep_for(between_looks);
        const std::vector<fs::path> changed = watch_.changed();
        if (changed.empty()) {
            continue;
        }
        for (const ShaderBuild& shader : shaders_) {
            std::set<fs::path> parts;
            try {
                parts = includes_of(shader.file, root_);
            } catch (const Error&) {
                continue; // The file is just being replaced; another event follows when the new file is saved
            }
            parts.insert(shader.file);
            const bool is_touched =
                std::ranges::any_of(changed, [&](const fs::path& file) { return parts.contains(file); });
            if (is_touched && !is_closing_) {
                compile(shader);
            }
        }
    }
}

std::vector<ShaderNews> ShaderReload::take()
{
    const std::lock_guard lock(guard_);
    return std::exchange(news_, {});
}

} // namespace estampe::viewer
