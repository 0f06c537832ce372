// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "viewer/file_watch.hpp"

namespace estampe::viewer {

/// A shader that was compiled anew, or why it could not be.
struct ShaderNews {
    std::string name; ///< as the program names it: hatch/lines.comp is lines_comp
    std::vector<uint32_t> spirv;
    std::string problem; ///< empty: it is right
};

/// Compiles one by the program glslc, as the build does but for what that optimises, which takes up to ten
/// times as long as the rest and which drivers do again. The picture is the same. `root` is the folder that
/// includes start from.
[[nodiscard]] ShaderNews compile_shader(const std::filesystem::path& file, const std::filesystem::path& root);

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
    void compile(const std::filesystem::path& file);

    std::filesystem::path root_;
    std::function<void()> wake_;
    std::vector<std::filesystem::path> shaders_; ///< with an entry point
    std::vector<std::filesystem::path> all_;     ///< and what they include
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
