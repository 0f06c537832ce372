// SPDX-License-Identifier: MIT
#pragma once

// `estampe styles --sheet`: one scene in every preset, side by side, to choose a style by.

#include <span>
#include <string>

#include <estampe/image.hpp>

#include "options.hpp"

namespace estampe::app {

/// A picture and the name that stands under it.
struct SheetEntry {
    Image picture;
    std::string name;
};

/// Lays pictures of one size side by side on white, in rows from left to right, as close to the shape of a
/// screen as whole rows allow, each with its name beneath it. Names are drawn in ASCII; other characters are
/// left out. Throws Error when the sheet would be larger than an Image may be.
[[nodiscard]] Image lay_out_sheet(std::span<const SheetEntry> entries);

/// Draws the scene of `draw` in each of style_presets(), with the assignments that `draw` has over each, and
/// lays the pictures out. Without a scene it draws a small still life. Throws Error as load_scene() and
/// Renderer::render() do.
[[nodiscard]] Image draw_contact_sheet(const DrawOptions& draw);

} // namespace estampe::app
