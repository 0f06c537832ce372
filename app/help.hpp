// SPDX-License-Identifier: MIT
#pragma once

// Texts about the program itself: examples for --help-all, the manual page, and the completion script for
// bash.

#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

// Examples at the end of each command's --help-all; the first example is also shown by --help.

inline constexpr const char* examples = R"(Examples:
  estampe render helmet.gltf -o helmet.png --style pencil --size 1920x1080
  estampe render helmet.gltf -o helmet.png --samples 16
  estampe render fox.glb -o fox.png --animation Run --time 0.4
  estampe render bunny.obj -o bunny.png --camera "eye=2,1,3 target=0,0.5,0 fov=35"
  estampe render chapel.glb -o chapel.png --style pencil --set hatch.width_mm=0.5
  estampe render chapel.glb -o chapel.svg --plotter
  estampe render fox.glb -o fox.mp4 --animation Run --fps 30
  estampe render helmet.gltf -o 'frames/%04d.png' --turntable --frames 96
  estampe render chapel.glb -o chapel.ora                          (layers, for Krita and GIMP)
  estampe render chapel.glb -o chapel.exr --depth 32 --layers layers.exr
  estampe render chapel.glb -o - --format jpg --quality 85 | lp
  estampe render chapel.glb -o chapel.png --page A4 --dpi 600
  estampe render part.stl -o part.svg --up z --view isometric
  estampe render house.glb -o plan.svg --view top --ortho --page A3
  curl -s https://example.org/helmet.glb | estampe render - -o helmet.png
  estampe render fox.glb -o fox.png --time 0.4 --motion fox.exr --since 0.36
  estampe view helmet.gltf
  estampe info helmet.gltf --json
  estampe tam -o pen.tam --preview pen.png
  estampe bake room.glb -o room.exr
)";

/// Text on the exit status: the last line of --help-all of the program, of `render` and of `info`;
/// manual_page() removes it.
inline constexpr const char* exit_status =
    "\nExit status: 0 done, 1 the job failed, 2 the command line is wrong.";

inline constexpr const char* tam_examples = R"(Examples:
  estampe tam -o pen.tam --preview pen.png
  estampe tam tam-charcoal -o charcoal.tam --set drawing.seed=7
  estampe tam mine.toml -o mine.tam --brush stroke.png
  estampe tam --from mine.tam -o painted/              (to paint over the images, then)
  estampe tam --from painted/ -o mine.tam

A folder holds square pictures of black ink on white, with a side that is a power of two: tone1.png,
tone2.png, ... from light to dark, from which coarser levels are derived, or tone1_level0.png,
tone1_level1.png, ... with a picture for each level.

Exit status: 0 done, 1 the job failed, 2 the command line is wrong.)";

inline constexpr const char* view_examples = R"(Examples:
  estampe view helmet.gltf
  estampe view fox.glb --animation Run --style comic
  estampe view                                    (and drop a scene on the window)

Exit status: 0 done, 1 the job failed, 2 the command line is wrong.)";

/// Returns a bash script that completes commands, options, presets, parameters of the style, and files with
/// the extensions that an option accepts.
[[nodiscard]] std::string bash_completion(const CLI::App& app);

/// Returns the manual page estampe(1) of the whole program: every command with its options, as in --help-all.
[[nodiscard]] std::string manual_page(const CLI::App& app);

} // namespace estampe::app
