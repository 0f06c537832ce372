// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bake.hpp"
#include "batch.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "help.hpp"
#include "option_values.hpp"
#include "options.hpp"
#include "report.hpp"
#include "viewer/keys.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

/// The options as they are typed, before they are looked at.
struct Typed {
    std::string scene;
    std::string output;
    PageOptions page;
    SceneOptions input;
    WorldOptions world;
    TransparentOption transparent;
    std::string camera;
    std::string view;
    bool ortho = false;
    std::string style;
    std::vector<std::string> assignments;
    bool draft = false;
    std::string from;
    std::string brush;
    std::string preview;
    std::string animation;
    std::string variant;
    std::string device = "auto";
    std::string raster = "auto";
    std::optional<double> time_s;
    uint32_t samples = 1;
    uint32_t repeat = 1;
    uint32_t tile_px = 0;
    bool timings = false;
    bool json = false;
    bool hidden = false;
    bool plotter = false;
    bool style_manual = false;
    bool schema = false;
    bool manual_page = false;
    bool completion = false;
    std::string terrain;
    std::string lightmap;
    std::string motion;
    std::optional<double> since_s;
    std::string sheet;
    std::string shaders;
    bool verbose = false;
    bool warm_up = false;
};

void add_set_option(CLI::App& command, Typed& typed, const char* help)
{
    command.add_option("--set", typed.assignments, help)->type_name("KEY=VALUE")->allow_extra_args(false);
}

/// From where the scene is seen.
void add_camera_options(CLI::App& command, Typed& typed)
{
    command
        .add_option("--camera", typed.camera,
                    "A camera of the file by name or index; auto (frame the whole scene);\n"
                    "\"eye=x,y,z target=x,y,z fov=degrees\"; or a direction to frame the scene\n"
                    "from, \"azimuth=degrees elevation=degrees\": azimuth 0 looks from +z and\n"
                    "sees the front, 90 looks from +x [the file's first camera, else auto]")
        ->type_name("CAMERA");
    command
        .add_option("--view", typed.view,
                    "Frame the whole scene from a side: front, back, left, right, top,\n"
                    "bottom, isometric or three-quarter; front looks from +z, right from +x")
        ->type_name("SIDE");
    command.add_flag("--ortho", typed.ortho,
                     "Parallel projection, as plans and elevations have it; isometric has\nit anyway");
}

/// What draws.
void add_device_options(CLI::App& command, Typed& typed)
{
    command.add_option("--device", typed.device, "auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str();
    add_no_cache_flag(command);
    command
        .add_option("--raster", typed.raster,
                    "How triangles are drawn: hardware, compute, or auto, the quicker\n"
                    "on this device")
        ->type_name("PATH")
        ->capture_default_str();
}

/// What a picture is of and how it is drawn, wherever it goes.
void add_look_options(CLI::App& command, Typed& typed)
{
    typed.page.add_to(command, command.get_name() == "render");
    typed.input.add_to(command);
    add_camera_options(command, typed);
    command.add_option("--time", typed.time_s, "Moment of the animation, in seconds [0]")->type_name("S");
    command
        .add_option("--animation", typed.animation,
                    "Animation by name or index, or all, which plays all of them together\n[the first]")
        ->type_name("NAME");
    command
        .add_option("--variant", typed.variant,
                    "Material variant of a glTF file by name or index [its default\nmaterials]")
        ->type_name("NAME");
    command.add_option("--style", typed.style, "Preset, or TOML file (see estampe styles)")
        ->type_name("STYLE");
    add_set_option(
        command, typed,
        "One parameter of the style, such as hatch.width_mm=0.5;\nmay be repeated (see --help-style)");
    typed.transparent.add_to(command);
    command.add_flag("--draft", typed.draft,
                     "Quicker and coarser: one layer of strokes, wide cells of ink and\nsmoke, small shadow "
                     "maps, fewer kinds of lines");
    typed.world.add_to(command);
    command
        .add_option("--terrain", typed.terrain,
                    "Ground without an end that the scene is put on, as a terrain's\nTOML describes it")
        ->type_name("TOML");
    command
        .add_option("--lightmap", typed.lightmap,
                    "Light worked out ahead, as estampe bake writes it for this\n"
                    "scene, in place of what the file itself names")
        ->type_name("EXR");
    add_device_options(command, typed);
}

CLI::Option& add_scene(CLI::App& command, Typed& typed)
{
    return *command
                .add_option("SCENE", typed.scene,
                            "Scene: .gltf .glb .obj .ply .stl .fbx .dae, a terrain's .toml, or the\n"
                            "name of a world, which code makes (estampe info lists them); - reads\n"
                            "standard input")
                ->type_name("FILE");
}

void add_draw_options(CLI::App& command, Typed& typed)
{
    add_scene(command, typed).required();
    command.add_option("-o,--output", typed.output, "File to write")->required()->type_name("FILE");
    add_look_options(command, typed);
}

void add_view(CLI::App& app, Typed& typed)
{
    CLI::App& command = *app.add_subcommand("view", "Open a window on a scene and its style");
    command.footer(viewer::keys_text() + "\n" + view_examples);
    add_scene(command, typed);
    add_look_options(command, typed);
    command
        .add_option("--samples", typed.samples, "Jittered frames to accumulate once the view stands still")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option(
            "--shaders", typed.shaders,
            "Folder of Estampe's sources: shaders saved there are drawn with\nat once, for developers")
        ->type_name("DIR");
    command.add_flag("--verbose", typed.verbose, "Tell on stderr what happens, with times");
    command.add_flag("--warm-up", typed.warm_up,
                     "Open no window: compile the shaders of SCENE and its style,\nfor a window to come");
}

void add_render(CLI::App& app, Typed& typed, PictureOptions& picture, FilmOptions& film)
{
    CLI::App& command =
        *app.add_subcommand("render", "Draw a scene and write it as a picture, or as SVG strokes");
    command.footer(examples + world_examples() + exit_status);
    add_draw_options(command, typed);
    picture.add_to(command);
    command.add_option("--samples", typed.samples, "Jittered frames to accumulate, for smooth edges")
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--repeat", typed.repeat, "Draw N times and time the median of all after the first")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--tile", typed.tile_px, "Draw in parts of at most N pixels a side [what the device can]")
        ->type_name("N");
    command.add_flag("--hidden", typed.hidden, "SVG: lines behind something too, dashed");
    command.add_flag(
        "--plotter", typed.plotter,
        "SVG: for pens that draw; one line a stroke, none twice, in an\norder with little travel");
    command
        .add_option("--motion", typed.motion,
                    "Also write how far what is seen moved, as R and G in pixels to\nthe right and down")
        ->type_name("EXR");
    command.add_option("--since", typed.since_s, "Moment that --motion looks back to [--time less 1/30]")
        ->type_name("S");
    film.add_to(command);
    command.add_flag("--timings", typed.timings, "Print the time of every pass, or of the whole film");
    command.add_flag("--json", typed.json, "Print the timings as JSON");
}

void add_styles(CLI::App& app, Typed& typed)
{
    CLI::App& command = *app.add_subcommand(
        "styles", "List the presets, draw a scene in all of them, or print a style in full as TOML");
    command
        .add_option("STYLE", typed.style,
                    "Preset or TOML file to print; with --sheet the scene to draw, as\n"
                    "estampe render takes it [a small still life]")
        ->type_name("STYLE|SCENE");
    CLI::Option* sheet = command
                             .add_option("--sheet", typed.sheet,
                                         "Draw the scene in every preset, side by side with their names, to\n"
                                         "choose one by")
                             ->type_name("PNG");
    command.add_flag("--schema", typed.schema, "Print a JSON schema of style files, for editors")
        ->excludes(sheet);
    typed.page.add_to(command, false);
    typed.input.add_to(command);
    typed.world.add_to(command);
    add_camera_options(command, typed);
    add_set_option(command, typed,
                   "One parameter that every picture has, such as\nhatch.spacing_mm=1; may be repeated");
    add_device_options(command, typed);
}

void add_tam(CLI::App& app, Typed& typed)
{
    CLI::App& command =
        *app.add_subcommand("tam", "Draw a tonal art map, the strokes of a style by tone and distance");
    command.footer(tam_examples);
    command
        .add_option("STYLE", typed.style,
                    "Preset, or TOML file, for its [tam] and the colours of its\n[paper]")
        ->type_name("STYLE");
    command.add_option("-o,--output", typed.output, "NAME.tam; or NAME.dds, or FOLDER/ for PNG files")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--from", typed.from,
                    "Convert a map instead of drawing one: a folder of PNG or DDS\nfiles, a .dds or a .tam")
        ->type_name("PATH");
    command
        .add_option("--brush", typed.brush,
                    "Picture of one stroke from left to right, in its alpha or in\nblack on white [tam.tool]")
        ->type_name("PNG");
    command.add_option("--preview", typed.preview, "Also write a sheet of all tones and levels")
        ->type_name("PNG");
    add_set_option(command, typed,
                   "One parameter of the style, such as tam.width_px=3; may be\nrepeated (see --help-style)");
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

/// Options of single commands.
struct OwnOptions {
    BakeOptions bake;
    BatchOptions batch;
    PictureOptions picture;
    FilmOptions film;
};

void add_commands(CLI::App& app, Typed& typed, OwnOptions& own)
{
    add_render(app, typed, own.picture, own.film);
    add_view(app, typed);
    add_tam(app, typed);
    own.bake.add_to(app);
    own.batch.add_to(app);
    CLI::App& info = *app.add_subcommand("info", "Tell what a scene holds, or list the worlds");
    info.footer("Worlds, scenes that code makes:\n" + report_worlds(false) + exit_status);
    info.add_option("SCENE", typed.scene,
                    "Scene file, or the name of a world; - reads standard input\n[list all worlds]")
        ->type_name("FILE");
    typed.input.add_to(info);
    typed.world.add_to(info);
    info.add_flag("--json", typed.json, "Print JSON");
    CLI::App& devices = *app.add_subcommand("devices", "List the devices that can draw");
    devices.add_flag("--json", typed.json, "Print JSON");
    CLI::App& graph = *app.add_subcommand("graph", "Write the frame graph of a scene as Graphviz text");
    add_draw_options(graph, typed);
    add_styles(app, typed);
    app.add_flag("--help-style", typed.style_manual, "Print the manual of all style parameters and exit");
    app.add_flag("--man", typed.manual_page, "Print the manual page, for man -l -, and exit");
    app.add_flag("--completion", typed.completion, "Print what makes bash complete commands, and exit");
}

/// A page has one height.
void check_page_is_free(const std::vector<std::string>& assignments)
{
    for (const std::string& assignment : assignments) {
        if (assignment.starts_with("paper.height_mm")) {
            throw UsageError("says itself how high the page is", "--page", "leave out --set " + assignment);
        }
    }
}

DrawOptions read_draw_options(const Typed& typed)
{
    DrawOptions draw;
    draw.scene = typed.scene;
    draw.input_format = typed.input.format();
    draw.load.up = typed.input.up();
    if (draw.load.up && (world_of(typed.scene) != nullptr || lower_extension(typed.scene) == ".toml")) {
        throw UsageError("is for files of scenes; terrains and worlds have y up", "--up", "leave it out");
    }
    draw.output = typed.output;
    draw.world = typed.world.read(typed.scene);
    draw.terrain = typed.terrain;
    draw.lightmap = typed.lightmap;
    draw.page = typed.page.read();
    draw.time_s = typed.time_s.value_or(0.0);
    draw.has_time = typed.time_s.has_value();
    if (!std::isfinite(draw.time_s)) {
        throw UsageError("is not a finite number", "--time");
    }
    draw.animation = typed.animation;
    draw.load.variant = typed.variant;
    constexpr uint32_t most_samples = 4096;
    check_count("--samples", typed.samples, most_samples);
    draw.samples = typed.samples;
    check_device(typed.device);
    draw.device.device = typed.device;
    draw.device.raster = parse_raster_path(typed.raster);
    draw.is_draft = typed.draft;
    if (typed.draft) { // what is set says more
        draw.assignments.assign(draft_assignments.begin(), draft_assignments.end());
    }
    typed.transparent.assign(draw.assignments);
    draw.assignments.insert(draw.assignments.end(), typed.assignments.begin(), typed.assignments.end());
    draw.style = read_style(typed.style, draw.assignments);
    if (draw.page.height_mm) {
        check_page_is_free(typed.assignments);
        draw.style.set(fmt::format("paper.height_mm={}", *draw.page.height_mm));
    }
    constexpr uint32_t least_tile_px = 64;
    if (typed.tile_px > 0 && typed.tile_px < least_tile_px) {
        throw UsageError(fmt::format("{} is out of range", typed.tile_px), "--tile",
                         fmt::format("allowed: {} or more", least_tile_px));
    }
    draw.tile_px = typed.tile_px;
    return draw;
}

CameraChoice read_camera(const Typed& typed, bool has_camera)
{
    if (has_camera && !typed.view.empty()) {
        throw UsageError("takes the place of --camera", "--view", "give one of the two");
    }
    CameraChoice choice = has_camera            ? parse_camera(typed.camera)
                          : !typed.view.empty() ? parse_view(typed.view)
                                                : CameraChoice{};
    choice.parallel = typed.ortho;
    return choice;
}

/// Some options go with strokes alone, some with pictures alone.
void check_strokes(const Typed& typed, const PictureChoice& picture)
{
    const bool is_strokes = picture.format == PictureFormat::svg;
    if (!is_strokes && (typed.hidden || typed.plotter)) {
        throw UsageError("goes with strokes alone", typed.hidden ? "--hidden" : "--plotter",
                         "the name of the output must end in .svg");
    }
    const std::array<std::pair<const char*, bool>, 7> of_pictures{{{"--samples", typed.samples > 1},
                                                                   {"--tile", typed.tile_px > 0},
                                                                   {"--repeat", typed.repeat > 1},
                                                                   {"--timings", typed.timings},
                                                                   {"--motion", !typed.motion.empty()},
                                                                   {"--layers", !picture.layers.empty()},
                                                                   {"--json", typed.json}}};
    for (const auto& [option, is_given] : of_pictures) {
        if (is_strokes && is_given) {
            throw UsageError("goes with pictures alone", option, "leave it out, or write a .png");
        }
    }
}

/// Reads --motion and --since.
void read_motion(const Typed& typed, RenderCommand& render)
{
    constexpr double step_s = 1.0 / 30.0;
    if (typed.motion.empty() && typed.since_s) {
        throw UsageError("goes with --motion alone", "--since");
    }
    if (!typed.motion.empty() && lower_extension(typed.motion) != ".exr") {
        throw UsageError("motion is written as OpenEXR", "--motion " + typed.motion,
                         "the name must end in .exr");
    }
    render.motion = typed.motion;
    render.since_s = typed.since_s.value_or(render.draw.time_s - step_s);
    if (!std::isfinite(render.since_s)) {
        throw UsageError("is not a finite number", "--since");
    }
}

/// Some options go with single pictures alone.
void check_film(const Typed& typed, const RenderCommand& command)
{
    if (command.film && command.film->flies) {
        check_has_film(typed.scene);
    }
    if (command.film && (typed.repeat > 1 || typed.json || typed.tile_px > 0 || !typed.motion.empty())) {
        throw UsageError("does not go with films",
                         typed.repeat > 1    ? "--repeat"
                         : typed.json        ? "--json"
                         : typed.tile_px > 0 ? "--tile"
                                             : "--motion",
                         "leave it out, or write a .png");
    }
}

TamCommand read_tam(const Typed& typed)
{
    if (!typed.from.empty() && (!typed.brush.empty() || !typed.assignments.empty())) {
        throw UsageError("a map that is converted is not drawn", "--from", "leave out --brush and --set");
    }
    const std::string extension = lower_extension(typed.output);
    if (!extension.empty() && !typed.output.ends_with('/') && extension != ".tam" && extension != ".dds") {
        throw UsageError(fmt::format("cannot write a map as {}", in_quotes(extension)), "-o " + typed.output,
                         "the name must end in .tam, .dds, or / for a folder");
    }
    if (!typed.preview.empty() && lower_extension(typed.preview) != ".png") {
        throw UsageError("the sheet is a PNG picture", "--preview " + typed.preview,
                         "the name must end in .png");
    }
    return {.style = read_style(typed.style, typed.assignments),
            .from = typed.from,
            .brush = typed.brush,
            .output = typed.output,
            .preview = typed.preview};
}

StylesCommand read_styles(const CLI::App& app, const Typed& typed)
{
    StylesCommand styles{.style = typed.style, .schema = typed.schema};
    const CLI::App& command = *app.get_subcommands().front();
    if (typed.sheet.empty()) {
        for (const char* option : {"--size", "--up", "--input-format", "--world", "--seed", "--camera",
                                   "--view", "--ortho", "--set", "--device", "--raster"}) {
            if (command.count(option) > 0) {
                throw UsageError("only works with --sheet", option, "leave it out, or add --sheet FILE.png");
            }
        }
        return styles;
    }
    if (lower_extension(typed.sheet) != ".png") {
        throw UsageError("a sheet is a PNG picture", "--sheet " + typed.sheet, "the name must end in .png");
    }
    Typed drawn = typed;
    drawn.scene = typed.style;
    drawn.style.clear();
    drawn.output = typed.sheet;
    styles.style.clear();
    styles.sheet = read_draw_options(drawn);
    if (command.count("--size") == 0) {
        constexpr PageSize of_one{.width = 400, .height = 300};
        styles.sheet->page = of_one;
    }
    styles.sheet->camera = read_camera(typed, command.count("--camera") > 0);
    return styles;
}

Command to_command(const CLI::App& app, const Typed& typed, const OwnOptions& own)
{
    if (typed.style_manual) {
        return StyleManualCommand{};
    }
    if (app.got_subcommand("info")) {
        return InfoCommand{.scene = typed.scene,
                           .input_format = typed.input.format(),
                           .up = typed.input.up(),
                           .world = typed.world.read(typed.scene),
                           .json = typed.json};
    }
    if (app.got_subcommand("devices")) {
        return DevicesCommand{typed.json};
    }
    if (app.got_subcommand("styles")) {
        return read_styles(app, typed);
    }
    if (app.got_subcommand("tam")) {
        return read_tam(typed);
    }
    if (app.got_subcommand("batch")) {
        return own.batch.read();
    }
    if (app.got_subcommand("bake")) {
        return own.bake.read();
    }
    const bool render = app.got_subcommand("render");
    const bool view = app.got_subcommand("view");
    if (!render && !view && !app.got_subcommand("graph")) {
        throw UsageError("a command is missing", {}, "estampe --help lists them");
    }
    DrawOptions draw = read_draw_options(typed);
    draw.camera = read_camera(typed, app.get_subcommands().front()->count("--camera") > 0);
    if (view) {
        if (typed.warm_up && typed.scene.empty()) {
            throw UsageError("needs a scene", "--warm-up", "name the one to compile shaders for");
        }
        return ViewCommand{.draw = std::move(draw),
                           .style_name = typed.style,
                           .shaders = typed.shaders,
                           .verbose = typed.verbose,
                           .warm_up = typed.warm_up};
    }
    if (render) {
        constexpr uint32_t most_frames = 100000;
        check_count("--repeat", typed.repeat, most_frames);
        const std::optional<FilmChoice> film = own.film.read(draw.output);
        const PictureChoice picture =
            film ? own.picture.of_film() : own.picture.read(draw.output, draw.page.width, draw.page.height);
        check_strokes(typed, picture);
        check_has_alpha(draw, picture, film.has_value());
        RenderCommand command{.draw = std::move(draw),
                              .picture = picture,
                              .hidden = typed.hidden,
                              .plotter = typed.plotter,
                              .film = film,
                              .repeat = typed.repeat,
                              .timings = typed.timings,
                              .json = typed.json};
        read_motion(typed, command);
        check_film(typed, command);
        if (!command.motion.empty() &&
            (command.motion == command.draw.output || command.motion == command.picture.layers)) {
            throw UsageError("needs a file of its own", "--motion", "give another name");
        }
        return command;
    }
    return GraphCommand{std::move(draw)};
}

/// What to do about a command line that cannot be parsed.
std::string remedy_of(const CLI::ParseError& problem, const CLI::App& app, std::span<const char* const> words)
{
    if (app.get_subcommands().empty()) {
        return "see estampe --help";
    }
    const CLI::App& command = *app.get_subcommands().front();
    const bool is_unknown_word = problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    const bool takes_worlds = command.get_option_no_throw("--world") != nullptr;
    const std::vector<std::string> unknown = app.remaining(true);
    for (size_t i = 0; i < words.size() && is_unknown_word && takes_worlds; ++i) {
        const std::string word = words[i];
        if (!word.starts_with("--") || std::ranges::find(unknown, word) == unknown.end()) {
            continue;
        }
        const size_t sign = std::min(word.find('='), word.size());
        const bool is_value_next = i + 1 < words.size() && *words[i + 1] != '-';
        const std::string value = sign < word.size() ? word.substr(sign + 1)
                                  : is_value_next    ? words[i + 1]
                                                     : "";
        const std::string written = world_option_as_typed(word.substr(2, sign - 2), value);
        if (!written.empty()) {
            return "write " + written;
        }
    }
    return fmt::format("see estampe {} --help", command.get_name());
}

} // namespace

std::optional<Command> read_command_line(int argc, const char* const* argv)
{
    Typed typed;
    OwnOptions own;
    CLI::App app("Draws 3D scenes as a hand would: pen, ink and paper.", "estampe");
    app.set_version_flag("--version", "estampe " ESTAMPE_VERSION);
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(34);
    app.footer(examples + world_examples() + exit_status);
    add_commands(app, typed, own);
    refuse_empty_values(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        if (problem.get_exit_code() == 0) {
            app.exit(problem);
            return std::nullopt;
        }
        throw UsageError(one_line(problem.what()), {},
                         remedy_of(problem, app, {argv, static_cast<size_t>(argc)}));
    }
    if (typed.manual_page || typed.completion) {
        fmt::print("{}", typed.manual_page ? manual_page(app) : bash_completion(app));
        return std::nullopt;
    }
    return to_command(app, typed, own);
}

} // namespace estampe::app
