// SPDX-License-Identifier: MIT
#pragma once

// Reports about scenes, worlds, devices and timings, as text for people (`json` false) or as JSON for
// programs.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "world/registry.hpp"

namespace estampe::app {

/// `world` is the world that made the scene; null for a file.
[[nodiscard]] std::string report_scene(const Scene& scene, const std::string& path, bool json,
                                       const worlds::Description* world = nullptr);

[[nodiscard]] std::string report_devices(const std::vector<DeviceInfo>& devices, bool json);

/// Timings of one `render`.
struct TimingReport {
    std::string device;
    RasterPath raster = RasterPath::automatic; ///< the path that was used
    std::string output;
    RenderSettings settings;
    uint32_t frames = 1;
    std::vector<PassTiming> passes; ///< medians over every second frame after the first; may be empty
    double gpu_ms = 0.0;            ///< median of the other frames, in which passes may overlap
    std::vector<SolverReport> solvers;
    std::vector<std::pair<std::string, double>> cpu_ms; ///< wall time of the steps of the command, in order
};

[[nodiscard]] std::string report_timings(const TimingReport& report, bool json);

/// All worlds with their rows.
[[nodiscard]] std::string report_worlds(bool json);

/// The examples of all worlds, one per line, indented as examples are in help.
[[nodiscard]] std::string world_examples();

} // namespace estampe::app
