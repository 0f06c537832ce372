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

/// From where the scene is seen.
void add_camera_options(CLI::App& command, TypedOptions& typed)
{
    command
        .add_option("--camera", typed.camera,
                    "Camera of the file, by name or index; auto, which frames the whole\n"
                    "scene; \"eye=x,y,z target=x,y,z fov=degrees\"; or a direction to frame\n"
                    "the scene from, \"azimuth=degrees elevation=degrees\", where azimuth 0\n"
                    "looks from +z (the front) and 90 from +x [the file's first camera,\n"
                    "else auto]")
        ->type_name("CAMERA");
    command
        .add_option("--view", typed.view,
                    "Side to frame the whole scene from: front, back, left, right, top,\n"
                    "bottom, isometric or three-quarter. Front looks from +z, right from\n"
                    "+x.")
        ->type_name("SIDE");
    command.add_flag("--ortho", typed.ortho,
                     "Draw in parallel projection, as plans and elevations are drawn. The\n"
                     "isometric view always has parallel projection.");
}

/// What draws.
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
                    "How triangles are rasterised: hardware, compute, or auto, which\n"
                    "takes the faster one on this device")
        ->type_name("PATH")
        ->capture_default_str();
}

/// What a picture is of and how it is drawn, wherever it goes.
void add_look_options(CLI::App& command, TypedOptions& typed)
{
    typed.page.add_to(command, command.get_name() == "render");
    typed.input.add_to(command);
    add_camera_options(command, typed);
    command.add_option("--time", typed.time_s, "Moment of the animation to draw, in seconds [0]")
        ->type_name("S");
    command
        .add_option("--animation", typed.animation,
                    "Animation to play, by name or index; all plays all of them together\n"
                    "[the first]")
        ->type_name("NAME");
    command
        .add_option("--variant", typed.variant,
                    "Material variant of a glTF file, by name or index [the file's\n"
                    "default materials]")
        ->type_name("NAME");
    command
        .add_option("--style", typed.style,
                    "Preset or TOML file that sets the style; estampe styles lists the\n"
                    "presets [built-in values]")
        ->type_name("STYLE");
    add_set_option(command, typed,
                   "One parameter of the style, such as hatch.width_mm=0.5. May be\n"
                   "repeated (see --help-style).");
    typed.transparent.add_to(command);
    command.add_flag("--draft", typed.draft,
                     "Draw faster and coarser, for a first look: one layer of strokes,\n"
                     "coarse ink and smoke, small shadow maps, fewer kinds of lines");
    typed.world.add_to(command);
    command
        .add_option("--terrain", typed.terrain,
                    "Terrain file (TOML) of an endless ground that the scene stands on")
        ->type_name("TOML");
    command
        .add_option("--lightmap", typed.lightmap,
                    "Baked light of this scene, as estampe bake writes it, instead of the\n"
                    "lightmap that the scene's file names")
        ->type_name("EXR");
    add_device_options(command, typed);
}

CLI::Option& add_scene(CLI::App& command, TypedOptions& typed)
{
    return *command
                .add_option("SCENE", typed.scene,
                            "Scene to draw: .gltf .glb .obj .ply .stl .fbx .dae or .toml (a\n"
                            "terrain), or the name of a built-in world (see estampe info). The\n"
                            "name - reads standard input.")
                ->type_name("FILE");
}

void add_draw_options(CLI::App& command, TypedOptions& typed, const char* output_help)
{
    add_scene(command, typed).required();
    command.add_option("-o,--output", typed.output, output_help)->required()->type_name("FILE");
    add_look_options(command, typed);
}

void add_view(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command = *app.add_subcommand("view", "Open a window to look at a scene and to edit its style");
    command.footer(viewer::keys_text() + "\n" + view_examples);
    add_scene(command, typed);
    add_look_options(command, typed);
    command
        .add_option("--samples", typed.samples,
                    "Number of jittered frames to average once the view is still, for\n"
                    "smooth edges")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--shaders", typed.shaders,
                    "Folder of Estampe's sources, for developers: a shader that is saved\n"
                    "there is used at once")
        ->type_name("DIR");
    command.add_flag("--verbose", typed.verbose, "Report on stderr what happens, with times");
    command.add_flag("--warm-up", typed.warm_up,
                     "Open no window; compile the shaders of SCENE and its style for a\n"
                     "later window");
}

void add_render(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command =
        *app.add_subcommand("render", "Draw a scene as a picture, as SVG strokes or as a film");
    command.footer(examples + world_examples() + exit_status);
    add_draw_options(command, typed,
                     "Output file, whose ending chooses the format: png, jpg, webp, exr,\n"
                     "ora, svg; for films mp4, webm, gif, or PNG frames as in\n"
                     "frames/%04d.png. The name - is standard output.");
    typed.picture.add_to(command);
    command.add_option("--samples", typed.samples, "Number of jittered frames to average, for smooth edges")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--repeat", typed.repeat, "Draw N times and report the median times of all but the first")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--tile", typed.tile_px,
                    "Draw in tiles of at most N pixels per side [the largest that the\n"
                    "device can draw]")
        ->type_name("N");
    command.add_flag("--hidden", typed.hidden, "Also draw hidden lines, with dashes. Only valid for SVG.");
    command.add_flag("--plotter", typed.plotter,
                     "Write SVG for pen plotters: one line per stroke, none drawn twice,\n"
                     "in an order with little pen travel");
    command
        .add_option("--motion", typed.motion,
                    "Also write an OpenEXR file of how far each pixel has moved: R is\n"
                    "pixels to the right, G is pixels down")
        ->type_name("EXR");
    command
        .add_option("--since", typed.since_s,
                    "Moment that --motion looks back to, in seconds [--time less 1/30]")
        ->type_name("S");
    typed.film.add_to(command);
    command.add_flag("--timings", typed.timings, "Print the time of every pass, or of the whole film");
    command.add_flag("--json", typed.json, "Print the timings as JSON instead of text");
}

void add_styles(CLI::App& app, TypedOptions& typed)
{
    CLI::App& command = *app.add_subcommand(
        "styles", "List the presets, draw a scene in all of them, or print a whole style as TOML");
    command
        .add_option("STYLE", typed.style,
                    "Preset or TOML file to print in full. With --sheet: the scene to\n"
                    "draw, as estampe render takes it. [list the presets; a still life]")
        ->type_name("STYLE|SCENE");
    CLI::Option* sheet =
        command
            .add_option("--sheet", typed.sheet,
                        "Draw the scene in every preset but those named tam-, side by side on\n"
                        "one picture, each with its name")
            ->type_name("PNG");
    command.add_flag("--schema", typed.schema, "Print a JSON schema of style files, for editors")
        ->excludes(sheet);
    typed.page.add_to(command, false);
    typed.input.add_to(command);
    typed.world.add_to(command);
    add_camera_options(command, typed);
    add_set_option(command, typed,
                   "One parameter of the style that all pictures of the sheet share,\n"
                   "such as hatch.width_mm=0.5. May be repeated.");
    add_device_options(command, typed);
    for (CLI::Option* option : command.get_options()) {
        if (option != sheet && !option->get_positional() && !option->check_lname("schema") &&
            !option->check_lname("help")) {
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
                    "Preset or TOML file whose [tam] draws the map and whose [paper]\n"
                    "colours the preview")
        ->type_name("STYLE");
    command
        .add_option("-o,--output", typed.output,
                    "Output file, NAME.tam or NAME.dds, or FOLDER/ for PNG files")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--from", typed.from,
                    "Map to convert instead of drawing one: a folder of PNG or DDS files,\n"
                    "a .dds or a .tam")
        ->type_name("PATH");
    command
        .add_option("--brush", typed.brush,
                    "Picture of one stroke from left to right, in its alpha channel or\n"
                    "black on white [the tool that tam.tool names]")
        ->type_name("PNG");
    command.add_option("--preview", typed.preview, "Also write a picture of all tones and levels")
        ->type_name("PNG");
    add_set_option(command, typed,
                   "One parameter of the style, such as tam.width_px=3. May be\n"
                   "repeated (see --help-style).");
}

/// An empty word is the trace of a variable that was not set, and no number, name or file.
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
    app.add_flag("--help-style", typed.style_manual, "Print the manual of all style parameters and exit");
    app.add_flag("--man", typed.manual_page, "Print the manual page for man -l - and exit");
    app.add_flag("--completion", typed.completion, "Print the completion script for bash and exit");
    refuse_empty_values(app);
}

} // namespace estampe::app
