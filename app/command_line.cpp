// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bake.hpp"
#include "batch.hpp"
#include "confine.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "help.hpp"
#include "help_page.hpp"
#include "option_values.hpp"
#include "options.hpp"
#include "report.hpp"
#include "typed_options.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

/// Checks that no --set assignment sets the page's height when an option such as --page already sets it.
void check_page_is_free(const std::vector<std::string>& assignments)
{
    for (const std::string& assignment : assignments) {
        if (assignment.starts_with("paper.height_mm")) {
            throw UsageError("says itself how high the page is", "--page", "leave out --set " + assignment);
        }
    }
}

DrawOptions read_draw_options(const TypedOptions& typed)
{
    DrawOptions draw;
    draw.scene = typed.scene;
    draw.input_format = typed.input.format();
    draw.load.up = typed.input.up();
    draw.confine = typed.of_job ? *typed.of_job : typed.input.confinement();
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
    check_range("--samples", typed.samples, 1, most_samples);
    draw.samples = typed.samples;
    check_device(typed.device);
    draw.device.device = typed.device;
    draw.device.raster = parse_raster_path(typed.raster);
    draw.is_draft = typed.draft;
    if (typed.draft) { // Options that the user typed override those of --draft
        draw.assignments.assign(draft_assignments.begin(), draft_assignments.end());
    }
    typed.transparent.assign(draw.assignments);
    draw.assignments.insert(draw.assignments.end(), typed.assignments.begin(), typed.assignments.end());
    draw.is_of_job = typed.of_job != nullptr;
    const auto read = [&] { return read_style(typed.style, draw.assignments, draw.confine); };
    draw.style = draw.is_of_job ? unquoted("style", "styles", read) : read();
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
    draw.limits = typed.limits.read();
    return draw;
}

CameraChoice read_camera(const TypedOptions& typed, bool has_camera)
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

/// Checks the output format: some options apply only to strokes (.svg), others only to pictures.
void check_strokes(const TypedOptions& typed, const PictureChoice& picture)
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

/// Reads the options --motion and --since.
void read_motion(const TypedOptions& typed, RenderCommand& render)
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

/// Checks the options of a film: some options apply only to single pictures.
void check_film(const TypedOptions& typed, const RenderCommand& command)
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

TamCommand read_tam(const TypedOptions& typed)
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
    const Confinement confine{.is_on = typed.is_confined, .jobs = {}};
    return {.style = read_style(typed.style, typed.assignments, confine),
            .from = typed.from,
            .brush = typed.brush,
            .output = typed.output,
            .preview = typed.preview,
            .confine = confine};
}

StylesCommand read_styles(const CLI::App& app, const TypedOptions& typed)
{
    StylesCommand styles{.style = typed.style, .schema = typed.schema, .confine = typed.input.confinement()};
    if (typed.sheet.empty()) {
        return styles;
    }
    if (lower_extension(typed.sheet) != ".png") {
        throw UsageError("a sheet is a PNG picture", "--sheet " + typed.sheet, "the name must end in .png");
    }
    TypedOptions drawn = typed;
    drawn.scene = typed.style;
    drawn.style.clear();
    drawn.output = typed.sheet;
    styles.style.clear();
    styles.sheet = read_draw_options(drawn);
    const CLI::App& command = *app.get_subcommands().front();
    if (command.count("--size") == 0) {
        constexpr PageSize of_one{.width = 400, .height = 300};
        styles.sheet->page = of_one;
    }
    styles.sheet->camera = read_camera(typed, command.count("--camera") > 0);
    return styles;
}

Command to_command(const CLI::App& app, const TypedOptions& typed)
{
    if (app.got_subcommand("info")) {
        return InfoCommand{.scene = typed.scene,
                           .input_format = typed.input.format(),
                           .up = typed.input.up(),
                           .world = typed.world.read(typed.scene),
                           .confine = typed.input.confinement(),
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
    if (app.got_subcommand("normalmap")) {
        return typed.normal_map.read();
    }
    if (app.got_subcommand("batch")) {
        return typed.batch.read();
    }
    if (app.got_subcommand("bake")) {
        return typed.bake.read();
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
        check_range("--repeat", typed.repeat, 1, most_frames);
        const std::optional<FilmChoice> film = typed.film.read(draw.output);
        const PictureChoice picture =
            film ? typed.picture.of_film()
                 : typed.picture.read(draw.output, draw.page.width, draw.page.height);
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

/// Returns the value of --help-style, if the option is typed. The option is read before all others, because
/// it needs neither a scene nor an output. The rest of the command line may be invalid.
std::optional<StyleManualCommand> style_manual_of(std::span<const char* const> words)
{
    constexpr std::string_view option = "--help-style";
    for (size_t i = 1; i < words.size() && words[i] != std::string_view("--"); ++i) {
        const std::string_view word = words[i];
        if (word == option) {
            const bool has_section = i + 1 < words.size() && *words[i + 1] != '-';
            return StyleManualCommand{has_section ? words[i + 1] : ""};
        }
        if (word.starts_with(option) && word[option.size()] == '=') {
            return StyleManualCommand{std::string(word.substr(option.size() + 1))};
        }
    }
    return std::nullopt;
}

/// Returns advice for the user when the command line cannot be parsed.
std::string remedy_of(const CLI::ParseError& problem, const CLI::App& app, std::span<const char* const> words)
{
    if (app.get_subcommands().empty()) {
        return "see estampe --help";
    }
    const CLI::App& command = *app.get_subcommands().front();
    // The user typed several assignments after one --set: "--set a=1 b=2".
    for (size_t i = 2; i < words.size(); ++i) {
        const std::string_view option = words[i - 2];
        const std::string_view word = words[i];
        if ((option == "--set" || option == "--world") && !word.starts_with('-') &&
            word.find('=') != std::string_view::npos) {
            return fmt::format("{0} takes one value: write {0} {1}", option, word);
        }
    }
    const bool is_unknown_word = problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    const bool takes_worlds = find_option(command, "world") != nullptr;
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

std::optional<Command> read_command_line(int argc, const char* const* argv, const Confinement* of_job)
{
    if (std::optional<StyleManualCommand> manual = style_manual_of({argv, static_cast<size_t>(argc)})) {
        return *manual;
    }
    TypedOptions typed;
    typed.of_job = of_job;
    CLI::App app("Draws 3D scenes as a hand would: pen, ink and paper.", "estampe");
    app.set_version_flag("--version", "estampe " ESTAMPE_VERSION);
    app.require_subcommand(0, 1);
    app.formatter(std::make_shared<HelpPage>());
    app.group("Commands");
    app.set_help_flag("-h,--help", "Print a short help, one line per option, and exit");
    app.set_help_all_flag("--help-all", "Print every option in full, with more examples, and exit");
    app.footer(examples + world_examples() + exit_status);
    add_commands(app, typed);
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
    return to_command(app, typed);
}

} // namespace estampe::app
