// SPDX-License-Identifier: MIT
#include "picture_output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/pending.hpp"
#include "film_frames.hpp"
#include "output/layer_files.hpp"
#include "output/pictures.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

constexpr int usual_quality = 92;

ExrNumbers exr_numbers(const PictureChoice& choice)
{
    return choice.depth == 32 ? ExrNumbers::single : ExrNumbers::half;
}

bool is_layers_exr(const PictureChoice& choice)
{
    return lower_extension(choice.layers) == ".exr";
}

std::vector<std::byte> encode(const DrawnPicture& picture, const PictureChoice& choice)
{
    switch (choice.format) {
    case PictureFormat::jpeg:
        return output::encode_jpeg(picture.bytes, choice.quality.value_or(usual_quality));
    case PictureFormat::webp:
        return output::encode_webp(picture.bytes, choice.quality);
    case PictureFormat::openraster:
        return output::encode_openraster(picture.layers.value());
    case PictureFormat::exr:
        return output::encode_picture_exr(picture.floats.value(), exr_numbers(choice));
    default:
        return picture.floats ? output::encode_deep_png(*picture.floats) : encode_png(picture.bytes);
    }
}

/// Throws Error unless a folder of this name can be made.
void check_new_folder(std::filesystem::path folder)
{
    if (!folder.has_filename()) {
        folder = folder.parent_path();
    }
    std::error_code problem;
    if (std::filesystem::is_directory(folder, problem) && std::filesystem::is_empty(folder, problem)) {
        return;
    }
    if (std::filesystem::exists(folder, problem)) {
        throw Error("exists and is no empty folder", folder.string(),
                    "remove it, or give --layers the name of a new folder");
    }
    check_output(folder, {});
}

std::vector<std::byte> encode_named(const DrawnPicture& picture, const RenderCommand& command)
{
    try {
        return encode(picture, command.picture);
    } catch (const Error& error) {
        throw Error(error.what(), command.draw.output);
    }
}

void write_to_standard_output(std::span<const std::byte> bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
        throw Error(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
    }
}

} // namespace

DrawnPicture draw_picture(Renderer& renderer, const Camera& camera, const RenderCommand& command,
                          const RenderSettings& settings)
{
    const PictureChoice& choice = command.picture;
    const Style& style = command.draw.style;
    const bool is_deep =
        choice.format == PictureFormat::exr || (choice.format == PictureFormat::png && choice.depth > 8);
    DrawnPicture picture;
    if (choice.format == PictureFormat::openraster || !choice.layers.empty()) {
        picture.layers = renderer.render_layers(camera, style, settings);
        picture.bytes = picture.layers->picture;
        if (is_deep) {
            picture.floats = flattened(*picture.layers);
        }
    } else if (is_deep) {
        picture.floats = renderer.render_linear(camera, style, settings);
    } else {
        picture.bytes = renderer.render(camera, style, settings);
    }
    return picture;
}

void check_outputs(const RenderCommand& command)
{
    const DrawOptions& draw = command.draw;
    const PictureChoice& choice = command.picture;
    const std::vector<std::filesystem::path> inputs{draw.scene, draw.lightmap};
    if (draw.output != standard_output) {
        // Of numbered frames the folder may be made.
        const std::filesystem::path folder = std::filesystem::path(draw.output).parent_path();
        const bool makes_folder =
            is_numbered(draw.output) && !folder.empty() && !std::filesystem::exists(folder);
        check_output(makes_folder ? folder : std::filesystem::path(draw.output), inputs);
    }
    if (!command.motion.empty()) {
        check_output(command.motion, inputs);
    }
    if (is_layers_exr(choice)) {
        check_output(choice.layers, inputs);
    } else if (!choice.layers.empty()) {
        check_new_folder(choice.layers);
    }
}

void write_output(const std::string& output, std::span<const std::byte> bytes)
{
    if (output == standard_output) {
        write_to_standard_output(bytes);
    } else {
        write_file_atomically(output, bytes);
    }
}

void write_pictures(const DrawnPicture& picture, const Renderer& renderer, const RenderCommand& command)
{
    const std::vector<std::byte> bytes = encode_named(picture, command);
    const PictureChoice& choice = command.picture;
    std::vector<Pending> files;
    if (command.draw.output != standard_output) {
        files.push_back(Pending::file(command.draw.output, bytes));
    }
    if (is_layers_exr(choice)) {
        files.push_back(Pending::file(
            choice.layers, output::encode_layers_exr(picture.layers.value(), exr_numbers(choice))));
    } else if (!choice.layers.empty()) {
        const int bits = choice.format == PictureFormat::png ? choice.depth : 8;
        files.push_back(output::pending_layers(picture.layers.value(), choice.layers, bits));
    }
    if (!command.motion.empty()) {
        save_motion(renderer.motion(), command.motion);
    }
    std::ranges::for_each(files, [](Pending& file) { file.publish(); });
    if (command.draw.output == standard_output) {
        write_to_standard_output(bytes);
    }
}

} // namespace estampe::app
