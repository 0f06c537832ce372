// SPDX-License-Identifier: MIT
#include "normal_map.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "messages.hpp"

namespace estampe::app {
namespace {

constexpr const char* normal_map_examples = R"(Examples:
  estampe normalmap bricks.png -o bricks_normal.png
  estampe normalmap bark.png -o bark_normal.png --relief 0.02                (flatter)
  estampe normalmap relief.png -o relief_normal.png --edges clamp           (a picture that does not repeat)

White is high, black is low. A picture with 16 bits per channel gives smoother normals than one with 8. The map
is for normalTexture of glTF: red to the right, green up, blue out of the surface.)";

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
        *app.add_subcommand("normalmap", "Make a normal map from a picture of heights, for a material");
    command.footer(normal_map_examples);
    command.add_option("HEIGHTS", picture_, "Picture of the heights: white is high, black is low")
        ->required()
        ->type_name("PICTURE");
    command.add_option("-o,--output", output_, "Output file for the normal map, NAME.png")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--relief", relief_,
                    "Height of white over black, as a share of the picture's width. Allowed\n"
                    "are 0 to 10: more gives steeper slopes.")
        ->type_name("SHARE")
        ->capture_default_str();
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
}

NormalMapCommand NormalMapOptions::read() const
{
    if (lower_extension(output_) != ".png") {
        throw UsageError("a normal map is a PNG picture", "-o " + output_, "the name must end in .png");
    }
    if (!(relief_ >= 0.0 && relief_ <= most_relief)) {
        throw UsageError(fmt::format("{} is out of range", relief_), "--relief",
                         fmt::format("allowed: 0 to {}", most_relief));
    }
    return {.picture = picture_,
            .output = output_,
            .settings = {.relief = relief_,
                         .wraps = is_first(edges_, "--edges", "wrap", "clamp"),
                         .is_green_down = !is_first(green_, "--green", "up", "down")}};
}

void run(const NormalMapCommand& command)
{
    constexpr double most_step_texels = 0.25;
    check_output(command.output, {command.picture});
    const HeightMap heights = load_height_map(command.picture);
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

} // namespace estampe::app
