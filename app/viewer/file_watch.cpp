// SPDX-License-Identifier: MIT
#include "viewer/file_watch.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/file.hpp"

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

} // namespace estampe::viewer
