// SPDX-License-Identifier: MIT
#include "normal_map.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "core/file.hpp"
#include "core/long_jobs.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "messages.hpp"
#include "option_values.hpp"

namespace estampe::app {
namespace {

constexpr const char* normal_map_examples = R"(Examples:
  estampe normalmap bricks.png -o bricks_normal.png
  estampe normalmap bark.png -o bark_normal.png --relief 0.02                (flatter)
  estampe normalmap relief.png -o relief_normal.png --edges clamp           (a picture that does not repeat)
  estampe normalmap low.glb --from high.glb -o low_normal.png               (from a detailed mesh)
  estampe normalmap low.glb --from high.glb -o low_normal.png --size 2048 --distance 0.05
  estampe normalmap statue.glb --object low --from statue.glb --from-object high -o statue_normal.png
  estampe normalmap low.glb --from high.glb -o low_normal.png --tangents vertices --green down  (for Unreal)

White is high, black is low. A picture with 16 bits per channel gives smoother normals than one with 8. The map
is for normalTexture of glTF: red to the right, green up, blue out of the surface.

With --from, the plain and the detailed mesh must lie at the same place. For each texel, a ray from outside
the plain mesh finds the detailed mesh. Where no ray finds it within the distance, the map is flat.)";

/// Returns whether the user typed the first of an option's two allowed words. Throws UsageError if the user
/// typed neither word.
bool is_first(const std::string& typed, const char* option, const char* first, const char* second)
{
    if (typed != first && typed != second) {
        throw UsageError(fmt::format("{} is not one of its choices", in_quotes(typed)), option,
                         fmt::format("allowed: {}, {}", first, second));
    }
    return typed == first;
}

} // namespace

void NormalMapOptions::add_to(CLI::App& app)
{
    CLI::App& command =
        *app.add_subcommand("normalmap", "Make a normal map for a material, from heights or a detailed mesh");
    command.footer(normal_map_examples);
    command
        .add_option("SOURCE", source_,
                    "Picture of the heights: white is high, black is low. With --from: scene\n"
                    "file of the plain mesh, which must have UVs.")
        ->required()
        ->type_name("FILE");
    command.add_option("-o,--output", output_, "Output file for the normal map, NAME.png")
        ->required()
        ->type_name("FILE");
    CLI::Option* relief =
        command
            .add_option("--relief", relief_,
                        "Height of white over black, as a share of the picture's width. Allowed\n"
                        "are 0 to 10: more gives steeper slopes.")
            ->type_name("SHARE")
            ->capture_default_str();
    CLI::Option* edges =
        command
            .add_option("--edges", edges_,
                        "What lies beyond the edges of the picture. wrap: the opposite edge, for\n"
                        "textures that repeat; clamp: the texel at the edge.")
            ->type_name("wrap|clamp")
            ->capture_default_str();
    command
        .add_option("--green", green_,
                    "Direction of green. up: as in glTF, Blender and OpenGL; down: as in\n"
                    "Direct3D and Unreal.")
        ->type_name("up|down")
        ->capture_default_str();
    CLI::Option* from =
        command
            .add_option("--from", from_,
                        "Scene file of a detailed mesh, whose normals the map gives to the plain\n"
                        "mesh. Both meshes must lie at the same place.")
            ->type_name("FILE")
            ->excludes(relief)
            ->excludes(edges);
    add_confine_flag(command, is_confined_);
    for (CLI::Option* option : add_baking(command)) {
        option->needs(from);
    }
}

std::vector<CLI::Option*> NormalMapOptions::add_baking(CLI::App& command)
{
    CLI::Option* size = command
                            .add_option("--size", baking_.size,
                                        "Width and height of the map in texels, 16 to 8192: more is finer")
                            ->type_name("N")
                            ->capture_default_str();
    CLI::Option* samples =
        command
            .add_option("--samples", baking_.samples,
                        "Rays per texel along each of its sides, 1 to 8: 2 is 4 rays. More rays\n"
                        "give smoother maps and take longer.")
            ->type_name("N")
            ->capture_default_str();
    distance_ = command
                    .add_option("--distance", distance_m_,
                                "Largest distance between the plain and the detailed surface, in metres.\n"
                                "Longer rays find more, but may hit other parts of the mesh. [2 % of the\n"
                                "diagonal of the plain mesh]")
                    ->type_name("M");
    CLI::Option* border =
        command
            .add_option("--border", baking_.border,
                        "Texels by which the covered parts of the map are extended. 0 to 64; more\n"
                        "avoids seams when the texture is filtered from afar.")
            ->type_name("N")
            ->capture_default_str();
    CLI::Option* frame =
        command
            .add_option("--tangents", frame_,
                        "Directions of red and green, by triangles or vertices. triangles: as\n"
                        "Estampe draws; vertices: interpolated tangents (MikkTSpace), as other\n"
                        "programs draw.")
            ->type_name("KIND")
            ->capture_default_str();
    CLI::Option* uv = command
                          .add_option("--uv", baking_.uv_set,
                                      "Set of UVs of the plain mesh, 0 or 1: the texCoord of normalTexture")
                          ->type_name("SET")
                          ->capture_default_str();
    CLI::Option* object =
        command
            .add_option("--object", baking_.object,
                        "Plain meshes that take part, by the name of their object. Wildcards as\n"
                        "in a shell are allowed. [all]")
            ->type_name("NAME");
    CLI::Option* material =
        command
            .add_option("--material", baking_.material,
                        "Plain meshes that take part, by the name of their material. Wildcards as\n"
                        "in a shell are allowed. [all]")
            ->type_name("NAME");
    CLI::Option* from_object =
        command
            .add_option("--from-object", baking_.detailed_object,
                        "Detailed meshes that take part, by the name of their object. Wildcards\n"
                        "as in a shell are allowed. [all]")
            ->type_name("NAME");
    return {size, samples, distance_, border, frame, uv, object, material, from_object};
}

Command NormalMapOptions::read() const
{
    if (lower_extension(output_) != ".png") {
        throw UsageError("a normal map is a PNG picture", "-o " + output_, "the name must end in .png");
    }
    if (!from_.empty()) {
        return read_baking();
    }
    if (!(relief_ >= 0.0 && relief_ <= most_relief)) {
        throw UsageError(fmt::format("{} is out of range", relief_), "--relief",
                         fmt::format("allowed: 0 to {}", most_relief));
    }
    return NormalMapCommand{.picture = source_,
                            .output = output_,
                            .settings = {.relief = relief_,
                                         .wraps = is_first(edges_, "--edges", "wrap", "clamp"),
                                         .is_green_down = !is_first(green_, "--green", "up", "down")},
                            .confine = {.is_on = is_confined_, .jobs = {}}};
}

NormalBakeCommand NormalMapOptions::read_baking() const
{
    check_range("--size", baking_.size, 16, 8192);
    check_range("--samples", baking_.samples, 1, 8);
    check_range("--border", baking_.border, 0, 64);
    check_range("--uv", baking_.uv_set, 0, 1);
    NormalBakeCommand command{.plain = source_,
                              .detailed = from_,
                              .output = output_,
                              .settings = baking_,
                              .confine = {.is_on = is_confined_, .jobs = {}}};
    if (distance_->count() > 0) {
        if (!(distance_m_ > 0.0)) {
            throw UsageError(fmt::format("{} is out of range", distance_m_), "--distance",
                             "allowed: more than 0");
        }
        command.settings.distance_m = distance_m_;
    }
    command.settings.is_green_down = !is_first(green_, "--green", "up", "down");
    command.settings.frame = is_first(frame_, "--tangents", "triangles", "vertices")
                                 ? TangentFrame::of_triangle
                                 : TangentFrame::of_vertices;
    return command;
}

void run(const NormalMapCommand& command)
{
    constexpr double most_step_texels = 0.25;
    check_output(command.output, {command.picture});
    const HeightMap heights = load_height_map(command.picture, command.confine.of(command.picture));
    const double step_texels = height_step_texels(heights, command.settings);
    if (step_texels > most_step_texels) {
        print_notes(
            {fmt::format("{}: neighbouring shades of grey are {:.2g} texels apart in height, so the map "
                         "shows terraces; a picture with 16 bits per channel or a smaller --relief "
                         "avoids them",
                         command.picture, step_texels)});
    }
    save_png(make_normal_map(heights, command.settings), command.output);
}

namespace {

Scene load_mesh(const std::string& file, const Confinement& confine)
{
    LoadOptions options;
    options.scope = confine.of(file);
    Scene scene = load_scene(file, options);
    print_warnings(scene.warnings);
    scene.name = file; // for the messages of errors
    return scene;
}

/// Warns of what is not in a baked normal map, and why.
void tell_losses(const NormalBakeCommand& command, const BakedNormals& baked)
{
    std::vector<std::string> warnings;
    const auto percent = [](double share) {
        return fmt::format("{:.{}f} %", 100.0 * share, share < 0.1 ? 2 : 0);
    };
    if (baked.triangles_without_uvs > 0) {
        warnings.push_back(
            fmt::format("{}: {} of {} triangles get no part of the map: they have no UVs, or UVs "
                        "without area",
                        command.plain, baked.triangles_without_uvs, baked.triangles));
    }
    if (baked.triangles_of_wild_uvs > 0) {
        warnings.push_back(fmt::format("{}: {} of {} triangles get no part of the map: their UVs are not "
                                       "finite, or span more than 16 widths of the map",
                                       command.plain, baked.triangles_of_wild_uvs, baked.triangles));
    }
    if (baked.overlapping_share > 0.0005) {
        warnings.push_back(
            fmt::format("{}: triangles share {} of the covered map, which shows the detail of "
                        "the first of them; unwrap them apart, or choose some with --object or "
                        "--material",
                        command.plain, percent(baked.overlapping_share)));
    }
    print_warnings(warnings);
    print_notes({fmt::format("{} texels of {} x {} are covered; rays reached {:.4g} m", baked.covered_texels,
                             command.settings.size, command.settings.size, baked.distance_m)});
    if (baked.missed_share > 0.0) {
        print_notes({fmt::format("{} of the covered texels found no detail and are flat; a larger --distance "
                                 "may find it",
                                 percent(baked.missed_share))});
    }
}

} // namespace

void run(const NormalBakeCommand& command)
{
    check_output(command.output, {command.plain, command.detailed});
    const Scene plain = load_mesh(command.plain, command.confine);
    const Scene detailed = load_mesh(command.detailed, command.confine);
    constexpr double short_s = 1.0; // a shorter job shows no progress
    Progress progress("normalmap", 0.0);
    const ProgressWatch watch([&, start = Clock::now()](double share) {
        if (seconds_since(start) > short_s) {
            progress.show(share);
        }
        return true;
    });
    const BakedNormals baked = bake_normals(plain, detailed, command.settings);
    progress.clear();
    tell_losses(command, baked);
    save_png(baked.map, command.output);
}

} // namespace estampe::app
