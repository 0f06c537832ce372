// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::gltf {

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes of "data:...;base64,..."; nothing when it is not base64 or damaged.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// The file name in a relative URI, percent-decoded; nothing for an absolute path, another scheme, or a zero
/// byte.
[[nodiscard]] std::optional<std::string> decode_relative_uri(std::string_view uri);

} // namespace estampe::gltf
