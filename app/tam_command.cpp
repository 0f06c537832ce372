// SPDX-License-Identifier: MIT
#include <filesystem>
#include <vector>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/tonal_art_map.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "warnings.hpp"

namespace estampe::app {
namespace {

TonalArtMap draw_map(const TamCommand& command)
{
    if (command.brush.empty()) {
        return draw_tonal_art_map(command.style);
    }
    const Image picture = load_image(command.brush);
    try {
        return draw_tonal_art_map(command.style, &picture);
    } catch (const Error& problem) {
        throw Error(problem.what(), command.brush);
    }
}

TonalArtMap convert_map(const std::string& from)
{
    PaintedMap painted = load_tonal_art_map(from);
    print_warnings(painted.warnings);
    return std::move(painted.map);
}

} // namespace

void run(const TamCommand& command)
{
    const std::vector<std::filesystem::path> inputs{command.from, command.brush};
    if (!is_map_folder(command.output)) {
        check_output(command.output, inputs);
    }
    if (!command.preview.empty()) {
        check_output(command.preview, inputs);
    }
    const TonalArtMap map = command.from.empty() ? draw_map(command) : convert_map(command.from);
    if (command.preview.empty()) {
        save_tonal_art_map(map, command.output);
        return;
    }
    AtomicFile preview = AtomicFile::file(command.preview, encode_png(map_sheet(map, command.style)));
    save_tonal_art_map(map, command.output);
    preview.publish(); // both files, or none
}

} // namespace estampe::app
