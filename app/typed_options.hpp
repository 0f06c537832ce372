// SPDX-License-Identifier: MIT
#pragma once

// The options of all commands as the user typed them, before anything is checked.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bake.hpp"
#include "batch.hpp"
#include "normal_map.hpp"
#include "option_values.hpp"
#include "options.hpp"
#include "worlds.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The options as the user typed them. Each command of the program fills its part of the options;
/// read_command_line() checks the values.
struct TypedOptions {
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
    /// Value of --help-style; never read here, because style_manual_of() reads the option earlier.
    std::string style_manual;
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
    bool is_confined = false;            ///< --confine of a command that reads no scene
    const Confinement* of_job = nullptr; ///< Confinement of a batch's job; null outside of a batch
    NormalMapOptions normal_map;
    BakeOptions bake;
    BatchOptions batch;
    PictureOptions picture;
    FilmOptions film;
    LimitOptions limits;
};

/// Adds all commands with their options to the program; `typed` must outlive the parsing.
void add_commands(CLI::App& app, TypedOptions& typed);

} // namespace estampe::app
