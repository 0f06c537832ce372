// SPDX-License-Identifier: MIT
#include "typed_options.hpp"

#include <CLI/CLI.hpp>

#include "help.hpp"
#include "report.hpp"
#include "viewer/keys.hpp"

namespace estampe::app {
namespace {

void add_set_option(CLI::App& command, TypedOptions& typed, const char* help)
{
    command.add_option("--set", typed.assignments, help)->type_name("KEY=VALUE")->allow_extra_args(false);
}

/// Adds the options for the camera to a command.
void add_camera_options(CLI::App& command, TypedOptions& typed)
{
    command
        .add_option("--camera", typed.camera,
                    "Camera of the file by name or index, auto, a place or a direction. The\n"
                    "word auto frames the whole scene. A place is \"eye=x,y,z target=x,y,z\n"
                    "fov=degrees\". A direction, \"azimuth=degrees elevation=degrees\", frames\n"
                    "the whole scene: azimuth 0 looks from +z (the front), 90 from +x. [the\n"
                    "file's first camera, else auto]")
        ->type_name("CAMERA");
    command
        .add_option("--view", typed.view,
                    "Side to frame the whole scene from, such as front, top or isometric.\n"
                    "Sides are front, back, left, right, top, bottom, isometric and\n"
                    "three-quarter. Front looks from +z, right from +x.")
        ->type_name("SIDE");
    command.add_flag("--ortho", typed.ortho,
                     "Draw in parallel projection, as plans and elevations are drawn. The\n"
                     "isometric view always has parallel projection.");
}

/// Adds the options for the device and the raster path to a command.
void add_device_options(CLI::App& command, TypedOptions& typed)
{
    command
        .add_option("--device", typed.device,
                    "Device to draw on: auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str();
    add_no_cache_flag(command);
    command
        .add_option("--raster", typed.raster,
                    "Way to turn triangles into pixels: hardware, compute or auto. The word\n"
                    "auto takes the faster way on this device.")
        ->type_name("PATH")
        ->capture_default_str();
}

/// Adds the options for the content and the style of a picture to a command, for any output.
void add_style_options(CLI::App& command, TypedOptions& typed)
{
    typed.page.add_to(command, command.get_name() == "render");
    typed.input.add_to(command);
    add_camera_options(command, typed);
    command.add_option("--time", typed.time_s, "Moment of the animation to draw, in seconds [0]")
        ->type_name("S");
    command
        .add_option("--animation", typed.animation,
                    "Animation to play, by name or index. The word all plays all of them\n"
                    "together. [the first]")
        ->type_name("NAME");
    command
        .add_option("--variant", typed.variant,
                    "Material variant of a glTF file, by name or index [the default\n"
                    "materials]")
        ->type_name("NAME");
    command
        .add_option("--style", typed.style,
                    "Style to draw in: a preset, a TOML file, or several joined by +. In\n"
                    "comic+no-color, no-color overrides what comic sets. The command estampe\n"
                    "styles lists presets and additions. [built-in values]")
        ->type_name("STYLE");
    add_set_option(command, typed,
                   "Set one parameter of the style: hatch.width_mm=0.5; may be repeated.\n"
                   "See --help-style for the parameters.");
    typed.transparent.add_to(command);
    command.add_flag("--draft", typed.draft,
                     "Draw faster and coarser, for a first look. A draft has one layer of\n"
                     "strokes, coarse ink and smoke, small shadow maps and fewer kinds of\n"
                     "lines.");
    typed.world.add_to(command);
    command
        .add_option("--terrain", typed.terrain,
                    "Terrain file (TOML) of an endless ground that the scene stands on")
        ->type_name("TOML");
    command
        .add_option("--lightmap", typed.lightmap,
                    "Baked light of this scene, as estampe bake writes it. This file replaces\n"
                    "the lightmap that the scene's file names.")
        ->type_name("EXR");
    add_device_options(command, typed);
}

CLI::Option& add_scene(CLI::App& command, TypedOptions& typed)
{
    return *command
                .add_option("SCENE", typed.scene,
                            "Scene file to draw, name of a built-in world, or - for standard input.\n"
                            "Files are .gltf .glb .obj .ply .stl .fbx .dae or .toml (a terrain);\n"
                            "estampe info lists the worlds.")
                ->type_name("FILE");
}

void add_draw_options(CLI::App& command, TypedOptions& typed, const char* output_help)
{
    add_scene(command, typed).required();
    command.add_option("-o,--output", typed.output, output_help)->required()->type_name("FILE");
    add_style_options(command, typed);
}

void add_view(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command = *app.add_subcommand("view", "Open a window to look at a scene and to edit its style");
    command.footer(viewer::keys_text() + "\n" + view_examples);
    add_scene(command, typed);
    add_style_options(command, typed);
    command
        .add_option("--samples", typed.samples,
                    "Number of drawings that a still view averages: more smooths edges")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--shaders", typed.shaders,
                    "Folder of Estampe's sources, for developers. A shader that is saved\n"
                    "there is used immediately.")
        ->type_name("DIR");
    command.add_flag("--verbose", typed.verbose, "Report on stderr what happens, with times");
    command.add_flag("--warm-up", typed.warm_up,
                     "Only compile the shaders of SCENE and its style, for a later window");
}

void add_render(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command =
        *app.add_subcommand("render", "Draw a scene as a picture, as SVG strokes or as a film");
    command.footer(examples + world_examples() + exit_status);
    add_draw_options(command, typed,
                     "Output file, such as page.png, whose ending chooses the format. Endings\n"
                     "of pictures are png, jpg, webp, exr, ora, svg; of films mp4, webm, gif.\n"
                     "Films may also be PNG frames, as in frames/%04d.png. The name - is\n"
                     "standard output.");
    typed.picture.add_to(command);
    command
        .add_option("--samples", typed.samples,
                    "Number of drawings to average, each shifted a little: more smooths edges")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--repeat", typed.repeat,
                    "Draw N times and print the median times, without the first drawing")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--tile", typed.tile_px,
                    "Draw in tiles of at most N pixels per side [the largest that the\n"
                    "device can draw]")
        ->type_name("N");
    command.add_flag("--hidden", typed.hidden, "In an SVG, also draw hidden lines, with dashes");
    command.add_flag("--plotter", typed.plotter,
                     "Write SVG for pen plotters, with one line per stroke. No line is drawn\n"
                     "twice, and the order of lines keeps pen travel short.");
    command
        .add_option("--motion", typed.motion,
                    "Also write an OpenEXR file of how far each pixel has moved. R is pixels\n"
                    "to the right, G is pixels down.")
        ->type_name("EXR");
    command
        .add_option("--since", typed.since_s,
                    "Earlier moment from which --motion measures, in seconds [--time less 1/30]")
        ->type_name("S");
    typed.film.add_to(command);
    typed.limits.add_to(command);
    command.add_flag("--timings", typed.timings, "Print the time of every pass, or of the whole film");
    command.add_flag("--json", typed.json, "Print the timings as JSON instead of text");
}

void add_styles(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command = *app.add_subcommand(
        "styles", "List the presets, draw a scene in all of them, or print a style as TOML");
    command
        .add_option("STYLE", typed.style,
                    "Style to print in full, as --style of estampe render takes it. With\n"
                    "--sheet: the scene to draw. [list the presets; a still life]")
        ->type_name("STYLE|SCENE");
    CLI::Option* sheet =
        command
            .add_option("--sheet", typed.sheet,
                        "Draw the scene in every preset, side by side on one picture. Each has\n"
                        "its name below.")
            ->type_name("PNG");
    command.add_flag("--schema", typed.schema, "Print a JSON schema of style files, for editors")
        ->excludes(sheet);
    typed.page.add_to(command, false);
    typed.input.add_to(command);
    typed.world.add_to(command);
    add_camera_options(command, typed);
    add_set_option(command, typed,
                   "Set one parameter of the style for all pictures; may be repeated. An\n"
                   "example is hatch.width_mm=0.5.");
    add_device_options(command, typed);
    for (CLI::Option* option : command.get_options()) {
        if (option != sheet && !option->get_positional() && !option->check_lname("schema") &&
            !option->check_lname("confine") && !option->check_lname("help") &&
            !option->check_lname("help-all")) {
            option->needs(sheet);
        }
    }
}

void add_tam(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command =
        *app.add_subcommand("tam", "Draw a tonal art map: the strokes of a style by tone and distance");
    command.footer(tam_examples);
    command
        .add_option("STYLE", typed.style,
                    "Style for the strokes (section tam) and the preview's paper and ink")
        ->type_name("STYLE");
    command
        .add_option("-o,--output", typed.output,
                    "Output file, NAME.tam or NAME.dds, or FOLDER/ for PNG files")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--from", typed.from,
                    "Tonal art map to convert, instead of drawing one. Maps are .tam or .dds\n"
                    "files, or folders of PNG or DDS files.")
        ->type_name("PATH");
    command
        .add_option("--brush", typed.brush,
                    "Picture of one stroke from left to right. The stroke is the alpha\n"
                    "channel, or black on white. [the tool that tam.tool names]")
        ->type_name("PNG");
    command
        .add_option("--preview", typed.preview,
                    "Also write a picture that shows the map in all tones and sizes")
        ->type_name("PNG");
    add_set_option(command, typed,
                   "Set one parameter of the style: tam.width_px=3; may be repeated. See\n"
                   "--help-style for the parameters.");
    add_confine_flag(command, typed.is_confined);
}

void add_style_manual(CLI::App& command, TypedOptions& typed)
{
    command
        .add_option("--help-style", typed.style_manual,
                    "Print the parameters of a style and exit. NAME is a section, such as\n"
                    "hatch, or all. [a first page]")
        ->expected(0, 1)
        ->type_name("[NAME]");
}

/// Makes all options refuse an empty word. An empty word usually comes from an unset shell variable.
void refuse_empty_values(CLI::App& app)
{
    const auto check = [](const std::string& word) { return std::string(word.empty() ? "is empty" : ""); };
    for (CLI::App* command : app.get_subcommands({})) {
        for (CLI::Option* option : command->get_options()) {
            option->check(check);
        }
        refuse_empty_values(*command);
    }
}

} // namespace

void add_commands(CLI::App& app, TypedOptions& typed)
{
    add_render(app, typed);
    add_view(app, typed);
    add_tam(app, typed);
    typed.normal_map.add_to(app);
    typed.bake.add_to(app);
    typed.batch.add_to(app);
    CLI::App& info = *app.add_subcommand("info", "Print what a scene contains, or list the built-in worlds");
    info.footer("Built-in worlds, scenes that the program generates:\n" + report_worlds(false) + exit_status);
    info.add_option("SCENE", typed.scene,
                    "Scene file, or name of a built-in world. The name - reads standard\n"
                    "input. [list all worlds]")
        ->type_name("FILE");
    typed.input.add_to(info);
    typed.world.add_to(info);
    info.add_flag("--json", typed.json, "Print JSON instead of text");
    CLI::App& devices =
        *app.add_subcommand("devices", "List the graphics cards and processors that can draw");
    devices.add_flag("--json", typed.json, "Print JSON instead of text");
    CLI::App& graph = *app.add_subcommand("graph", "Write the frame graph of a scene as Graphviz text");
    add_draw_options(graph, typed, "Output file of the Graphviz text");
    add_styles(app, typed);
    add_style_manual(app, typed);
    for (CLI::App* command : app.get_subcommands({})) {
        if (find_option(*command, "set") != nullptr) {
            add_style_manual(*command, typed);
        }
    }
    app.add_flag("--man", typed.manual_page, "Print the manual page for man -l - and exit");
    app.add_flag("--completion", typed.completion, "Print the completion script for bash and exit");
    refuse_empty_values(app);
}

} // namespace estampe::app
