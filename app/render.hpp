// SPDX-License-Identifier: MIT
#pragma once

// `estampe render` of a picture: what it draws, and how that is written.

#include <memory>
#include <optional>

#include "core/image_codec.hpp"
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

/// Draws what `command` asks for, which is no film, of a scene that the renderer has, and writes its files.
/// Throws Error when it cannot.
void draw_and_write(Renderer& renderer, const Scene& scene, const RenderCommand& command);

} // namespace estampe::app
