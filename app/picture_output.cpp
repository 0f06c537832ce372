// SPDX-License-Identifier: MIT
#include "picture_output.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/file.hpp"
#include "core/free_memory.hpp"
#include "core/image_codec.hpp"
#include "film_frames.hpp"
#include "output/layer_files.hpp"
#include "output/one_layer.hpp"
#include "output/pictures.hpp"
#include "progress.hpp"

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

/// 0 for a picture that is no page.
uint32_t dots_per_m(const PageSize& page)
{
    constexpr double inches_a_m = 1000.0 / 25.4;
    return static_cast<uint32_t>(std::lround(page.dots_per_inch.value_or(0.0) * inches_a_m));
}

uint64_t pixels_of(const RenderSettings& settings)
{
    return uint64_t{settings.width} * settings.height;
}

/// Whether the picture goes to its file as it is drawn, since it is large, and that is all that is wanted.
bool is_written_as_drawn(const RenderCommand& command, const RenderSettings& settings)
{
    constexpr uint64_t most_in_memory = uint64_t{1} << 24U;
    const PictureChoice& choice = command.picture;
    return choice.format == PictureFormat::png && choice.depth == 8 && choice.layers.empty() &&
           choice.layer.empty() && command.motion.empty() && command.repeat == 1 &&
           command.draw.output != standard_output && pixels_of(settings) > most_in_memory;
}

/// Draws, and where it takes long says how far it is.
void draw_bands(Renderer& renderer, const Camera& camera, const Style& style, const RenderSettings& settings,
                const std::function<void(const Image&)>& take)
{
    Progress progress("picture", 0.0);
    renderer.render_bands(camera, style, settings,
                          {.take = take, .progress = [&](double share) { progress.show(share); }});
    progress.clear();
}

Image draw_in_memory(Renderer& renderer, const Camera& camera, const Style& style,
                     const RenderSettings& settings)
{
    require_memory(4 * pixels_of(settings),
                   fmt::format("a picture of {} x {} pixels", settings.width, settings.height), "--size",
                   "write a PNG file, which is written as it is drawn, or draw a smaller picture");
    Image image{.width = settings.width, .height = settings.height};
    draw_bands(renderer, camera, style, settings, [&](const Image& rows) {
        image.rgba.reserve(4 * pixels_of(settings));
        image.rgba.insert(image.rgba.end(), rows.rgba.begin(), rows.rgba.end());
    });
    return image;
}

std::vector<std::byte> encode(const DrawnPicture& picture, const PictureChoice& choice, uint32_t dots_per_m)
{
    switch (choice.format) {
    case PictureFormat::jpeg:
        return output::encode_jpeg(picture.bytes, choice.quality.value_or(usual_quality), dots_per_m);
    case PictureFormat::webp:
        return output::encode_webp(picture.bytes, choice.quality);
    case PictureFormat::openraster:
        return output::encode_openraster(picture.layers.value());
    case PictureFormat::exr:
        return output::encode_picture_exr(picture.floats.value(), exr_numbers(choice));
    default:
        return picture.floats ? output::encode_deep_png(*picture.floats, dots_per_m)
                              : encode_png(picture.bytes, dots_per_m);
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
        return encode(picture, command.picture, dots_per_m(command.draw.page));
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
                          const Style& style, const RenderSettings& settings)
{
    const PictureChoice& choice = command.picture;
    const bool is_deep =
        choice.format == PictureFormat::exr || (choice.format == PictureFormat::png && choice.depth > 8);
    DrawnPicture picture;
    if (choice.format == PictureFormat::openraster || !choice.layers.empty() || !choice.layer.empty()) {
        picture.layers = renderer.render_layers(camera, style, settings);
        picture.bytes = picture.layers->picture;
        if (is_deep) {
            picture.floats = flattened(*picture.layers);
        }
        if (!choice.layer.empty()) {
            picture.floats = output::one_layer(*picture.layers, choice.layer);
            picture.bytes = output::encoded_bytes(*picture.floats);
            if (!is_deep) {
                picture.floats.reset();
            }
        }
    } else if (is_deep) {
        picture.floats = renderer.render_linear(camera, style, settings);
    } else if (is_written_as_drawn(command, settings)) {
        picture.file = std::make_unique<PngFile>(command.draw.output, settings.width, settings.height,
                                                 dots_per_m(command.draw.page));
        draw_bands(renderer, camera, style, settings,
                   [&](const Image& rows) { picture.file->add_rows(rows.rgba); });
    } else {
        picture.bytes = draw_in_memory(renderer, camera, style, settings);
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

void write_pictures(DrawnPicture& picture, const Renderer& renderer, const RenderCommand& command)
{
    if (picture.file) {
        picture.file->publish();
        return;
    }
    const std::vector<std::byte> bytes = encode_named(picture, command);
    const PictureChoice& choice = command.picture;
    std::vector<AtomicFile> files;
    if (command.draw.output != standard_output) {
        files.push_back(AtomicFile::file(command.draw.output, bytes));
    }
    if (is_layers_exr(choice)) {
        files.push_back(AtomicFile::file(
            choice.layers, output::encode_layers_exr(picture.layers.value(), exr_numbers(choice))));
    } else if (!choice.layers.empty()) {
        const int bits = choice.format == PictureFormat::png ? choice.depth : 8;
        files.push_back(output::pending_layers(picture.layers.value(), choice.layers, bits));
    }
    if (!command.motion.empty()) {
        save_motion(renderer.motion(), command.motion);
    }
    std::ranges::for_each(files, [](AtomicFile& file) { file.publish(); });
    if (command.draw.output == standard_output) {
        write_to_standard_output(bytes);
    }
}

} // namespace estampe::app
