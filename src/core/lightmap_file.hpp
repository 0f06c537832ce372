// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include <estampe/lightmap.hpp>

#include "core/exr.hpp"

namespace estampe {

/// Whether the header is that of a map which `estampe bake` made.
[[nodiscard]] bool is_baked(const ExrFile& file);

/// The map in such a picture. Throws Error with `path` as its place when it is none or damaged.
[[nodiscard]] Lightmap baked_lightmap(ExrFile file, const std::filesystem::path& path);

} // namespace estampe
