// SPDX-License-Identifier: MIT
// Runs the short commands: devices, info, styles, graph, tam, view.
#include "commands.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/tonal_art_map.hpp>

#include "contact_sheet.hpp"
#include "core/child/sandbox.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "drawing.hpp"
#include "messages.hpp"
#include "option_values.hpp"
#include "piped_scene.hpp"
#include "report.hpp"
#include "viewer/viewer.hpp"
#include "worlds.hpp"

namespace estampe::app {

void run(const DevicesCommand& command)
{
    const std::vector<DeviceInfo> devices = list_devices();
    if (devices.empty() && !command.json) {
        throw Error("no Vulkan driver is installed", {},
                    "install one; mesa-vulkan-drivers draws on the processor");
    }
    fmt::print("{}", report_devices(devices, command.json));
    if (!command.json) {
        fmt::print("{}", report_protections(missing_protections()));
    }
}

void run(const InfoCommand& command)
{
    if (command.scene.empty()) {
        fmt::print("{}", report_worlds(command.json));
        return;
    }
    DrawOptions draw;
    draw.scene = command.scene;
    draw.input_format = command.input_format;
    draw.load.up = command.up;
    draw.world = command.world;
    draw.confine = command.confine;
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    fmt::print("{}", report_scene(scene, command.scene, command.json, world_of(command.scene)));
}

void run(const StylesCommand& command)
{
    if (command.schema) {
        fmt::print("{}", Style::json_schema());
        return;
    }
    if (command.sheet) {
        check_output(command.sheet->output, {command.sheet->scene});
        write_file_atomically(command.sheet->output, encode_png(draw_contact_sheet(*command.sheet)));
        return;
    }
    if (!command.style.empty()) {
        const ReadScope scope = style_scope(command.style, command.confine);
        fmt::print("{}", Style::load(command.style, scope).to_toml());
        return;
    }
    const auto list = [](const std::vector<std::string>& names) {
        for (const std::string& name : names) {
            fmt::print("{:<13} {}\n", name, Style::about(name));
        }
    };
    list(Style::presets());
    fmt::print("\nAdditions, to put behind a preset with +, such as comic+no-color:\n");
    list(Style::additions());
}

void run(const StyleManualCommand& command)
{
    if (command.section == "all") {
        fmt::print("{}", Style::help());
        return;
    }
    if (!command.section.empty()) {
        try {
            fmt::print("{}", Style::help(command.section));
        } catch (const Error& problem) {
            throw UsageError(problem.what(), "--help-style");
        }
        return;
    }
    fmt::print("{}", Style::help("drawing"));
    fmt::print("\nestampe --help-style hatch prints one section, estampe --help-style all every section.\n");
}

void run(const GraphCommand& command)
{
    const DrawOptions& draw = command.draw;
    check_output(draw.output, {draw.scene, draw.lightmap});
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    check_output(draw.output, input_files(draw, scene));
    const Index animation = choose_animation(draw, scene);
    const Camera camera = choose_camera(draw, scene, animation);
    Renderer renderer(draw.device);
    set_scene(renderer, scene, draw);
    static_cast<void>(renderer.render(camera, draw.style, settings_of(draw, animation)));
    const std::string dot = renderer.graph_dot();
    write_file_atomically(draw.output, std::as_bytes(std::span(dot)));
}

namespace {

TonalArtMap draw_map(const TamCommand& command)
{
    if (command.brush.empty()) {
        return draw_tonal_art_map(command.style);
    }
    const Image picture = load_image(command.brush, command.confine.of(command.brush));
    try {
        return draw_tonal_art_map(command.style, &picture);
    } catch (const Error& problem) {
        throw Error(problem.what(), command.brush);
    }
}

TonalArtMap convert_map(const std::string& from, const Confinement& confine)
{
    PaintedMap painted = load_tonal_art_map(from, confine.of(from));
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
    const TonalArtMap map =
        command.from.empty() ? draw_map(command) : convert_map(command.from, command.confine);
    if (command.preview.empty()) {
        save_tonal_art_map(map, command.output);
        return;
    }
    AtomicFile preview = AtomicFile::file(command.preview, encode_png(map_sheet(map, command.style)));
    save_tonal_art_map(map, command.output);
    preview.publish(); // Either both output files appear under their final names, or none
}

void run(const ViewCommand& command)
{
    if (command.warm_up) {
        viewer::warm_up(command);
        return;
    }
    viewer::Viewer viewer(command);
    viewer.run();
    if (viewer.is_reading()) {
        // The program ends without waiting for a thread that still reads a large scene file that is not
        // needed.
        std::fflush(nullptr);
        remove_piped_scenes();
        std::_Exit(0);
    }
}

} // namespace estampe::app
