// SPDX-License-Identifier: MIT
#pragma once

// `estampe styles --sheet`: draws one scene in every preset, side by side, for choosing a style.

#include <span>
#include <string>

#include <estampe/image.hpp>

#include "options.hpp"

namespace estampe::app {

/// A picture and the name that is written under it.
struct SheetEntry {
    Image picture;
    std::string name;
};

/// Arranges pictures of one size side by side on white, in rows from left to right. The sheet's shape is as
/// close to a screen's shape as whole rows allow. The name of each picture is beneath the picture. Names are
/// drawn in ASCII; other characters are left out. Throws Error when the sheet would be larger than an Image
/// may be.
[[nodiscard]] Image lay_out_sheet(std::span<const SheetEntry> entries);

/// Draws the scene of `draw` in each of style_presets(), with the assignments of `draw` applied to each
/// preset, and arranges the pictures on one sheet. Without a scene it draws a small still life. Throws Error
/// as load_scene() and Renderer::render() do.
[[nodiscard]] Image draw_contact_sheet(const DrawOptions& draw);

} // namespace estampe::app
