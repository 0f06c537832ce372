// SPDX-License-Identifier: MIT
#pragma once

// Scenes that come through a pipe: `-`, /dev/stdin, a named pipe, a process substitution of the shell. A
// piped scene's format is detected from its first bytes.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::app {

/// Returns the scene format that begins with the given bytes, as --input-format names formats; empty if no
/// format is recognised. `size_bytes` is the length of the whole scene, which identifies a binary STL. Text
/// may have any form that the readers of OBJ and STL accept: UTF-8 or UTF-16, with blank lines and comments
/// before the first statement.
[[nodiscard]] std::string_view sniffed_format(std::string_view beginning, uint64_t size_bytes);

/// Name that the user types instead of a scene's file name to read the scene from standard input.
inline constexpr const char* standard_input = "-";

/// Returns the names of formats that --input-format accepts.
[[nodiscard]] std::span<const std::string_view> input_formats();

/// Returns whether this scene is read from a pipe or a terminal instead of a file.
[[nodiscard]] bool is_piped(const std::string& scene);

/// Files that a piped scene may name: those of the current folder, or none, as --confine has it.
enum class BesidePipe : uint8_t { current_folder, nothing };

/// Returns the path of the scene as a file. A piped scene is read to its end into a temporary folder, once
/// per run of the program. The folder has links to all files of the current folder, so that textures and
/// buffers are found, unless `beside` says otherwise. `format` is one of input_formats(), or empty to detect
/// the format from the content. Throws Error when the format is unknown, when the pipe gives nothing or more
/// than `most_bytes`, or when `format` is set for a regular file.
[[nodiscard]] std::filesystem::path scene_file(const std::string& scene, const std::string& format,
                                               uint64_t most_bytes = uint64_t{4} << 30U,
                                               BesidePipe beside = BesidePipe::current_folder);

/// Returns the message `text` with the temporary path of a piped scene replaced by the name that the user
/// typed, and paths of files in the temporary folder replaced by their names in the scene.
[[nodiscard]] std::string with_typed_name(std::string text, const std::string& scene,
                                          const std::filesystem::path& file);

/// Returns a warning that says where the missing `files` of a piped scene were searched; requires at least
/// one file.
[[nodiscard]] std::string missing_beside_pipe(const std::vector<std::string>& files,
                                              const std::string& scene);

/// Removes the temporary folders of piped scenes. Only needed when the program ends without running its
/// destructors, because the destructors remove the temporary folders too. Afterwards no piped scene can be
/// read.
void remove_piped_scenes();

} // namespace estampe::app
