// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace estampe::style {

/// The offset of the first byte that begins no character of Unicode in UTF-8: a stray or missing byte, a
/// form longer than need be, half of a surrogate pair, a character beyond U+10FFFF. The size of `text` when
/// there is none.
[[nodiscard]] size_t first_not_utf8(std::string_view text);

/// The offset of the first character beyond ASCII of a TOML text that stands in neither a string nor a
/// comment, where there must be none; a mark of byte order at the beginning is let pass. The size of `text`
/// when there is none.
[[nodiscard]] size_t first_bare_beyond_ascii(std::string_view text);

} // namespace estampe::style
