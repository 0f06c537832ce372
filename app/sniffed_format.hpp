// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace estampe::app {

/// How much of a scene is enough to tell its format: comments at the beginning of text may be long.
inline constexpr size_t sniffed_bytes = size_t{1} << 16U;

/// The scene format whose beginning this is, as --input-format names it; empty if none is recognised.
/// `size_bytes` is the length of the whole, by which a binary STL is known. Text may be all that the readers
/// of OBJ and STL take: UTF-8 or UTF-16, with blank lines and comments before the first statement.
[[nodiscard]] std::string_view sniffed_format(std::string_view beginning, uint64_t size_bytes);

} // namespace estampe::app
