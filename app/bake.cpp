// SPDX-License-Identifier: MIT
#include "bake.hpp"

#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/bake.hpp>
#include <estampe/error.hpp>
#include <estampe/work_limits.hpp>

#include "commands.hpp"
#include "core/file.hpp"
#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "messages.hpp"
#include "option_values.hpp"
#include "options.hpp"
#include "process.hpp"
#include "scene/scene_limits.hpp"

namespace estampe::app {
namespace {

constexpr const char* bake_examples = R"(Examples:
  estampe bake room.glb -o room.exr
  estampe render room.glb --lightmap room.exr -o room.png
  estampe bake room.glb -o room.exr --size 2048 --samples 512 --bounces 5
  estampe bake hall.glb -o hall.exr --direct sun,spot       (direct light too; render leaves it out)
  estampe bake street.glb -o street.exr --style pencil --set light.sun_elevation_deg=20

The lightmap holds indirect light, the light of glowing materials, and the style's ambient light as a sky that
objects occlude. In a picture the lightmap replaces the ambient light. The file is an OpenEXR picture in the
units of the scene's lights; its header says where each triangle lies. The second set of UVs is taken from the
scene's file if triangles do not overlap there; else the scene is unwrapped. Objects that move are left out.

Ctrl-C keeps what is done in OUT.partial; the same command continues from there.

Exit status: 0 done, 1 the job failed or was stopped, 2 the command line is wrong.)";

uint32_t read_kinds(const std::vector<std::string>& names)
{
    uint32_t kinds = 0;
    for (const std::string& name : names) {
        if (name == "sun") {
            kinds |= baked_directional;
        } else if (name == "point") {
            kinds |= baked_point;
        } else if (name == "spot") {
            kinds |= baked_spot;
        } else if (name == "all") {
            kinds |= baked_directional | baked_point | baked_spot;
        } else {
            throw UsageError(fmt::format("{} is no kind of light", in_quotes(name)), "--direct",
                             "allowed: sun, point, spot, all");
        }
    }
    return kinds;
}

} // namespace

void BakeOptions::add_to(CLI::App& app)
{
    CLI::App& command =
        *app.add_subcommand("bake", "Compute the light on objects that do not move, as a lightmap");
    command.footer(bake_examples);
    command
        .add_option("SCENE", scene_,
                    "Scene file to bake, name of a built-in world, or - for standard input.\n"
                    "Files are .gltf .glb .obj .ply .stl .fbx or .dae (see estampe info for\n"
                    "the worlds).")
        ->required()
        ->type_name("FILE");
    input_.add_to(command);
    // The world gets no option --seed, because --seed of `estampe bake` sets the noise of the lightmap.
    world_.add_to(command, WorldOptions::Seed::is_left_out);
    command.add_option("-o,--output", output_, "Output file, NAME.exr, an OpenEXR lightmap")
        ->required()
        ->type_name("FILE");
    command.add_option("--size", settings_.size, "Width and height of the lightmap in texels: more is finer")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--samples", settings_.samples,
                    "Number of light paths that are followed per texel of the lightmap. More\n"
                    "paths give less noise and take longer.")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--bounces", settings_.bounces,
                    "Largest number of surfaces that light bounces off: more is brighter")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--direct", direct_,
                    "Lights that the lightmap stores directly, too: sun, point, spot or all.\n"
                    "The command render then leaves out the direct light of these lights.\n"
                    "[none]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("KINDS");
    command
        .add_option("--sky", settings_.sky,
                    "Factor on the light from the sky, the ambient light of the style")
        ->type_name("X")
        ->capture_default_str();
    command
        .add_option("--seed", settings_.seed,
                    "Number that selects the random light paths: another gives other noise")
        ->type_name("N")
        ->capture_default_str();
    command.add_flag("--no-smooth", rough_, "Keep the noise instead of smoothing the lightmap");
    command.add_flag("--no-resume", anew_, "Start again, even if OUT.partial holds an unfinished lightmap");
    limits_.add_to(command);
    command
        .add_option("--style", style_, "Style that lights the scene by its section [light], as for render")
        ->type_name("STYLE");
    command
        .add_option("--set", assignments_,
                    "Set one parameter of the style: light.ambient=0.3; may be repeated.\n"
                    "See --help-style for the parameters.")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

BakeCommand BakeOptions::read() const
{
    constexpr uint32_t least_size = 16;
    constexpr uint32_t most_size = 4096;
    constexpr uint32_t most_samples = 65536;
    constexpr uint32_t most_bounces = 64;
    constexpr float most_sky = 100.0F;
    if (lower_extension(output_) != ".exr") {
        throw UsageError(fmt::format("cannot write a lightmap as {}", in_quotes(lower_extension(output_))),
                         "-o " + output_, "the name must end in .exr");
    }
    check_range("--size", settings_.size, least_size, most_size);
    check_range("--samples", settings_.samples, 1, most_samples);
    check_range("--bounces", settings_.bounces, 0, most_bounces);
    if (!(settings_.sky >= 0.0F && settings_.sky <= most_sky)) {
        throw UsageError("is out of range", "--sky", fmt::format("allowed: 0 to {}", most_sky));
    }
    BakeCommand command{.scene = scene_,
                        .input_format = input_.format(),
                        .up = input_.up(),
                        .world = world_.read(scene_),
                        .output = output_,
                        .style = read_style(style_, assignments_, input_.confinement()),
                        .settings = settings_,
                        .resume = !anew_,
                        .confine = input_.confinement(),
                        .limits = limits_.read()};
    command.settings.smooth = !rough_;
    command.settings.direct = read_kinds(direct_);
    return command;
}

namespace {

/// Throws Error if the bake needs more memory than --max-memory leaves.
void check_memory(const Scene& scene, const BakeSettings& settings)
{
    constexpr uint64_t bytes_a_texel = 128;    // sums of light, places, the lightmap and its smoothed copies
    constexpr uint64_t bytes_a_triangle = 400; // charts, and the tree in which rays find triangles
    if (is_memory_limited()) {
        require_memory(bytes_a_texel * settings.size * settings.size +
                           bytes_a_triangle * drawn_size(scene).triangles,
                       fmt::format("a lightmap of {0} x {0} texels", settings.size), "--size",
                       "bake a smaller lightmap");
    }
}

/// Bakes until the lightmap is complete. Returns false when a signal stopped the work. The file `partial`
/// holds the progress of stopped work.
bool work_through(LightmapBake& bake, const std::filesystem::path& partial)
{
    constexpr double look_s = 0.5;
    constexpr double save_s = 5.0;
    Progress progress("bake", bake.done());
    Clock::time_point saved = Clock::now();
    bool has_more = true;
    while (has_more && !was_told_to_stop() && !is_time_up()) {
        progress.show(bake.done());
        has_more = bake.work(look_s);
        if (has_more && (was_told_to_stop() || is_time_up() || seconds_since(saved) > save_s)) {
            bake.save_progress(partial);
            saved = Clock::now();
        }
    }
    progress.clear();
    return !has_more;
}

} // namespace

void run(const BakeCommand& command)
{
    const LimitedWork limits(command.limits);
    check_output(command.output, {command.scene});
    const std::filesystem::path partial = command.output + ".partial";
    check_output(partial, {command.scene});
    DrawOptions draw;
    draw.scene = command.scene;
    draw.input_format = command.input_format;
    draw.load.up = command.up;
    draw.world = command.world;
    draw.confine = command.confine;
    Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    check_memory(scene, command.settings);
    LightmapBake bake(std::move(scene), command.style, command.settings);
    if (bake.leaves_out_moving()) {
        print_warnings(
            {fmt::format("{}: some of it moves; only what stands still is in the map", command.scene)});
    }
    if (command.resume && bake.load_progress(partial)) {
        print_notes(
            {fmt::format("goes on from {:.0f} %, found in {}", 100.0 * bake.done(), partial.string())});
    } else if (std::filesystem::exists(partial)) {
        print_notes({fmt::format("begins anew: {} is not taken up", partial.string())});
    }
    print_notes({fmt::format("{} texels of {} x {}, each {:.1f} mm wide", bake.texel_count(),
                             command.settings.size, command.settings.size, 1000.0 / bake.texels_per_m())});
    tell_of_signals();
    if (!work_through(bake, partial)) {
        throw Error(fmt::format("stopped at {:.0f} %{}", 100.0 * bake.done(),
                                was_told_to_stop() ? "" : ": the time of --max-seconds is over"),
                    command.output, "the same command goes on from there");
    }
    save_lightmap(bake.map(), command.output);
    std::filesystem::remove(partial);
}

} // namespace estampe::app
