// SPDX-License-Identifier: MIT
#pragma once

// Scenes that come through a pipe: `-`, /dev/stdin, a named pipe, a process substitution of the shell. Their
// format is told by their first bytes.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::app {

/// The scene format whose beginning this is, as --input-format names it; empty if none is recognised.
/// `size_bytes` is the length of the whole, by which a binary STL is known. Text may be all that the readers
/// of OBJ and STL take: UTF-8 or UTF-16, with blank lines and comments before the first statement.
[[nodiscard]] std::string_view sniffed_format(std::string_view beginning, uint64_t size_bytes);

/// In place of a scene's file name.
inline constexpr const char* standard_input = "-";

/// The names that --input-format takes.
[[nodiscard]] std::span<const std::string_view> input_formats();

/// Whether the scene of this name is read from a pipe or a terminal instead of a file.
[[nodiscard]] bool is_piped(const std::string& scene);

/// Where the scene lies as a file. A piped scene is read to its end, once in a run of the program, into a
/// temporary folder, in which links stand for all that lies in the current folder, so that textures and
/// buffers are found there. `format` is one of input_formats(), or empty to recognise the format by its
/// content. Throws Error when the format is unknown, when nothing or more than `most_bytes` comes, or when a
/// regular file is given a format.
[[nodiscard]] std::filesystem::path scene_file(const std::string& scene, const std::string& format,
                                               uint64_t most_bytes = uint64_t{4} << 30U);

/// `text` with the temporary path of a piped scene replaced by the name that the user knows, and files of its
/// temporary folder named as the scene names them.
[[nodiscard]] std::string with_typed_name(std::string text, const std::string& scene,
                                          const std::filesystem::path& file);

/// A warning that says where the files were looked for that a piped scene names; at least one.
[[nodiscard]] std::string missing_beside_pipe(const std::vector<std::string>& files,
                                              const std::string& scene);

/// Removes the temporary folders, for an end of the program without its destructors; else they go by
/// themselves. No scene of a pipe can be read afterwards.
void remove_piped_scenes();

} // namespace estampe::app
