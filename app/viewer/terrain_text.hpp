// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <estampe/terrain.hpp>

namespace estampe::viewer {

/// Whether a TOML file is a terrain's, right or wrong, and no style's.
[[nodiscard]] bool is_terrain(const std::filesystem::path& path);

/// A terrain's file as it is to be written.
struct TerrainText {
    std::string text;
    bool keeps_comments = true; ///< those of the text before, where it had any
};

/// `before`, the text of a terrain's file, changed where it says otherwise than `terrain`: comments, blank
/// lines and the order stay. A text in which values cannot be told apart line by line is written anew.
[[nodiscard]] TerrainText text_with(const std::string& before, const TerrainDescription& terrain);

} // namespace estampe::viewer
