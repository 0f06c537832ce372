// SPDX-License-Identifier: MIT
#pragma once

// What the program prints of scenes, worlds, devices and timings, as text for people (`json` false) or as
// JSON for programs.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "world/registry.hpp"

namespace estampe::app {

/// `world` is the one that made the scene; null for a file.
[[nodiscard]] std::string report_scene(const Scene& scene, const std::string& path, bool json,
                                       const worlds::Description* world = nullptr);

[[nodiscard]] std::string report_devices(const std::vector<DeviceInfo>& devices, bool json);

/// Where the time of one `render` went.
struct TimingReport {
    std::string device;
    RasterPath raster = RasterPath::automatic; ///< that was taken
    std::string output;
    RenderSettings settings;
    uint32_t frames = 1;
    std::vector<PassTiming> passes; ///< medians of every second frame after the first, where there are any
    double gpu_ms = 0.0;            ///< median of the others, in which passes run side by side
    std::vector<SolverReport> solvers;
    std::vector<std::pair<std::string, double>> cpu_ms; ///< wall time of the steps of the command, in order
};

[[nodiscard]] std::string report_timings(const TimingReport& report, bool json);

/// All worlds with their rows, as text for people or as JSON for programs.
[[nodiscard]] std::string report_worlds(bool json);

/// The examples of all worlds, one per line, indented as examples are in help.
[[nodiscard]] std::string world_examples();

} // namespace estampe::app
