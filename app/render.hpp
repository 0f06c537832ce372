// SPDX-License-Identifier: MIT
#pragma once

// `estampe render` of a single picture: draws it and writes its files.

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/image_codec.hpp"
#include "options.hpp"

namespace estampe::app {

/// A picture in the forms that its file format needs.
struct DrawnPicture {
    Image bytes;
    std::unique_ptr<PngFile> file; ///< File that replaces `bytes` for large pictures
    std::optional<LinearImage> floats;
    std::optional<LayeredImage> layers;
};

/// Checks that the command's files can be written at their paths, and that none of them is one of `inputs`.
/// Throws Error otherwise. Does not change any file.
void check_outputs(const RenderCommand& command, const std::vector<std::filesystem::path>& inputs);

/// Draws a picture in the forms that the command's file format needs. `style` replaces the command's own
/// style.
[[nodiscard]] DrawnPicture draw_picture(Renderer& renderer, const Camera& camera,
                                        const RenderCommand& command, const Style& style,
                                        const RenderSettings& settings);

/// Draws the picture that `command` asks for, with a renderer that already has the scene, and writes its
/// files. `command` must not be a film. Throws Error on failure.
void draw_and_write(Renderer& renderer, const Scene& scene, const RenderCommand& command);

} // namespace estampe::app
