// SPDX-License-Identifier: MIT
#include <filesystem>
#include <vector>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "commands.hpp"
#include "core/image_codec.hpp"
#include "core/pending.hpp"
#include "frame/style_tables.hpp"
#include "techniques/tam/folder.hpp"
#include "techniques/tam/maker.hpp"
#include "techniques/tam/preview.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

tam::TonalArtMap draw_map(const TamCommand& command)
{
    const tam::TamStyle& style = command.style.tables().tam;
    if (command.brush.empty()) {
        return tam::make_map(style);
    }
    const Image picture = load_image(command.brush);
    try {
        return tam::make_map(style, &picture);
    } catch (const Error& problem) {
        throw Error(problem.what(), command.brush);
    }
}

tam::TonalArtMap convert_map(const std::string& from)
{
    tam::PaintedMap painted = tam::read_map(from);
    print_warnings(painted.warnings);
    return std::move(painted.map);
}

} // namespace

void run(const TamCommand& command)
{
    const std::vector<std::filesystem::path> inputs{command.from, command.brush};
    if (!tam::is_folder_name(command.output)) {
        check_output(command.output, inputs);
    }
    if (!command.preview.empty()) {
        check_output(command.preview, inputs);
    }
    const tam::TonalArtMap map = command.from.empty() ? draw_map(command) : convert_map(command.from);
    const paper::PaperStyle& page = command.style.tables().paper;
    if (command.preview.empty()) {
        tam::write_map(map, command.output);
        return;
    }
    Pending preview =
        Pending::file(command.preview, encode_png(tam::preview_sheet(map, page.color, page.ink)));
    tam::write_map(map, command.output);
    preview.publish(); // both files, or none
}

} // namespace estampe::app
