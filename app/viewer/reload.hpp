// SPDX-License-Identifier: MIT
#pragma once

// Reloads files that were saved: watches files, and compiles shaders again.

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

/// Watches files for changes of their time or size. changed() must be called regularly; a file that is still
/// being written is reported once it has not changed between two calls.
class FileWatch {
public:
    /// Replaces the list of watched files.
    void watch(const std::vector<std::filesystem::path>& files);

    /// Returns the watched files that changed since the last call; deleted files count when they exist again.
    /// Cost: about 2 us per file.
    [[nodiscard]] std::vector<std::filesystem::path> changed();

private:
    struct State {
        std::filesystem::file_time_type time;
        uintmax_t size_bytes = 0;
        bool operator==(const State&) const = default;
    };

    struct Watched {
        State known; ///< State of the file when it was last reported
        State seen;  ///< State of the file at the last call of changed()
    };

    [[nodiscard]] static State state_of(const std::filesystem::path& file);

    std::map<std::filesystem::path, Watched> files_;
};

/// Returns a scene's file and the files beside it that scenes consist of: buffers, textures, material files.
/// Searches one folder level deep, and at most some hundreds of files.
[[nodiscard]] std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene);

/// One compilation of a shader in the build: its name, its source and its macros.
struct ShaderBuild {
    std::filesystem::path file;
    std::string name;                ///< Name of the shader in the program: hatch/lines.comp is lines_comp
    std::vector<std::string> macros; ///< Macros defined for the compiler, as NAME or NAME=VALUE

    bool operator==(const ShaderBuild&) const = default;
};

/// Returns the shaders that the build compiles from a file with an entry point: one shader named after the
/// file, or the variants that CMake declares. `root` is the folder for include paths.
[[nodiscard]] std::vector<ShaderBuild> builds_of(const std::filesystem::path& file,
                                                 const std::filesystem::path& root);

/// A shader that was compiled again, or the reason why it could not be.
struct ShaderNews {
    std::string name; ///< Name of the shader, as in ShaderBuild
    std::vector<uint32_t> spirv;
    std::string problem; ///< Reason why the shader could not be compiled; empty on success
};

/// Compiles a shader with the program glslc, as the build does but without optimisation. With optimisation,
/// glslc takes up to ten times as long, and drivers optimise the shader anyway. The picture is the same.
/// `root` is the folder for include paths.
[[nodiscard]] ShaderNews compile_shader(const ShaderBuild& build, const std::filesystem::path& root);

/// Watches the shaders of a source tree in a separate thread. If a file is saved, compiles all shaders again
/// that are made from the file or include it.
class ShaderReload {
public:
    /// Starts to watch the shaders. `folder` is the source tree or its src/. Throws Error when it contains no
    /// shaders.
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
    std::vector<std::filesystem::path> all_; ///< Files of all shaders and all files that the shaders include
    FileWatch watch_;
    std::mutex guard_;
    std::vector<ShaderNews> news_;
    std::atomic<bool> is_closing_ = false;
    std::thread thread_;
};

/// Returns all files that a shader's file includes, directly or indirectly.
[[nodiscard]] std::set<std::filesystem::path> includes_of(const std::filesystem::path& file,
                                                          const std::filesystem::path& root);

} // namespace estampe::viewer
