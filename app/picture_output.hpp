// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "core/png_file.hpp"
#include "options.hpp"

namespace estampe::app {

/// A picture in what forms its format asks for.
struct DrawnPicture {
    Image bytes;
    std::unique_ptr<PngFile> file; ///< in place of bytes, where these are many
    std::optional<LinearImage> floats;
    std::optional<LayeredImage> layers;
};

/// Throws Error when the command's files cannot be written where they are to be. Nothing there is touched.
void check_outputs(const RenderCommand& command);

/// Draws what the command's format needs, in a style that may be another than the command's.
[[nodiscard]] DrawnPicture draw_picture(Renderer& renderer, const Camera& camera,
                                        const RenderCommand& command, const Style& style,
                                        const RenderSettings& settings);

/// Writes all files of a command, or none, and at last standard output. Throws Error naming what cannot be
/// written.
void write_pictures(DrawnPicture& picture, const Renderer& renderer, const RenderCommand& command);

/// Writes to a file, or to standard output where `output` says so.
void write_output(const std::string& output, std::span<const std::byte> bytes);

} // namespace estampe::app
