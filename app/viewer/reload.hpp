// SPDX-License-Identifier: MIT
#pragma once

// What is read again when it is saved: files that are watched, shaders that are compiled anew.

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace estampe::viewer {

/// Files that may change. Asked from time to time, it says which did, by their times and sizes; one that is
/// still being written counts once it has stood still for a look.
class FileWatch {
public:
    /// In place of those watched before.
    void watch(const std::vector<std::filesystem::path>& files);

    /// Those that changed since; files that are gone count when they come back. Cost: about 2 us a file.
    [[nodiscard]] std::vector<std::filesystem::path> changed();

private:
    struct State {
        std::filesystem::file_time_type time;
        uintmax_t size_bytes = 0;
        bool operator==(const State&) const = default;
    };

    struct Watched {
        State known; ///< that was told
        State seen;  ///< by the last look
    };

    [[nodiscard]] static State state_of(const std::filesystem::path& file);

    std::map<std::filesystem::path, Watched> files_;
};

/// A scene's file and what lies beside it that scenes are made of: buffers, textures, material files; one
/// folder deep, and no more than some hundreds.
[[nodiscard]] std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene);

/// One shader of the program, and what it is compiled from.
struct ShaderBuild {
    std::filesystem::path file;
    std::string name;                ///< as the program names it: hatch/lines.comp is lines_comp
    std::vector<std::string> macros; ///< that are defined: NAME or NAME=VALUE

    bool operator==(const ShaderBuild&) const = default;
};

/// The shaders that the build compiles from a file with an entry point: one of the file's name, or the
/// variants that CMake declares. `root` is the folder that includes start from.
[[nodiscard]] std::vector<ShaderBuild> builds_of(const std::filesystem::path& file,
                                                 const std::filesystem::path& root);

/// A shader that was compiled again, or why it could not be.
struct ShaderNews {
    std::string name; ///< as in ShaderBuild
    std::vector<uint32_t> spirv;
    std::string problem; ///< empty: it is right
};

/// Compiles one by the program glslc, as the build does but for what that optimises, which takes up to ten
/// times as long as the rest and which drivers do again. The picture is the same. `root` is the folder that
/// includes start from.
[[nodiscard]] ShaderNews compile_shader(const ShaderBuild& build, const std::filesystem::path& root);

/// Watches the shaders of a source tree in a thread of its own, and compiles those that are saved, and all
/// that include what is saved.
class ShaderReload {
public:
    /// `folder` is the source tree or its src/. Throws Error when it holds no shaders.
    ShaderReload(const std::filesystem::path& folder, std::function<void()> wake);
    ~ShaderReload();
    ShaderReload(const ShaderReload&) = delete;
    ShaderReload& operator=(const ShaderReload&) = delete;

    [[nodiscard]] std::vector<ShaderNews> take();

private:
    void work();
    void find_files();
    void compile(const ShaderBuild& build);

    std::filesystem::path root_;
    std::function<void()> wake_;
    std::vector<ShaderBuild> shaders_;
    std::vector<std::filesystem::path> all_; ///< their files and what these include
    FileWatch watch_;
    std::mutex guard_;
    std::vector<ShaderNews> news_;
    std::atomic<bool> is_closing_ = false;
    std::thread thread_;
};

/// All files of the tree that the text of a file includes, and those that these do.
[[nodiscard]] std::set<std::filesystem::path> includes_of(const std::filesystem::path& file,
                                                          const std::filesystem::path& root);

} // namespace estampe::viewer
