// SPDX-License-Identifier: MIT
#pragma once

// `estampe styles --sheet`: draws one scene in every preset, side by side, for choosing a style.

#include <span>
#include <string>

#include <estampe/image.hpp>

#include "options.hpp"

namespace estampe::app {

/// A picture of a contact sheet, and the name that is written under it.
struct SheetEntry {
    Image picture;
    std::string name;
};

/// Makes a contact sheet: arranges pictures of one size side by side on white, in rows from left to right.
/// The number of columns is chosen so that the sheet's shape is close to a screen's shape. The name of each
/// picture is below the picture. Names are drawn in ASCII; other characters are left out. Throws Error when
/// the sheet would be larger than an Image may be.
[[nodiscard]] Image lay_out_sheet(std::span<const SheetEntry> entries);

/// Draws a contact sheet: the scene of `draw` in each of Style::presets(), with the assignments of `draw`
/// applied to each preset. Without a scene, a small still life is drawn. Throws Error as load_scene() and
/// Renderer::render() do.
[[nodiscard]] Image draw_contact_sheet(const DrawOptions& draw);

} // namespace estampe::app
