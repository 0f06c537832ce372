// SPDX-License-Identifier: MIT
#pragma once

// Reports about scenes, worlds, devices and timings: text for people (`json` false), or JSON for programs.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "world/registry.hpp"

namespace estampe::app {

/// Reports on a scene. `world` is the world that made the scene; null for a scene file.
[[nodiscard]] std::string report_scene(const Scene& scene, const std::string& path, bool json,
                                       const worlds::Description* world = nullptr);

[[nodiscard]] std::string report_devices(const std::vector<DeviceInfo>& devices, bool json);

/// Reports that the kernel lacks protections of missing_protections(). Empty if it lacks none.
[[nodiscard]] std::string report_protections(const std::string& missing);

/// Timings of one run of `estampe render`.
struct TimingReport {
    std::string device;
    RasterPath raster = RasterPath::automatic; ///< Raster path that was used
    std::string output;
    RenderSettings settings;
    uint32_t frames = 1;
    /// GPU time of each pass: medians over every second frame after the first; may be empty.
    std::vector<PassTiming> passes;
    /// GPU time of a whole frame: the median over the frames in which single passes are not timed and may
    /// overlap.
    double gpu_ms = 0.0;
    std::vector<SolverReport> solvers;
    std::vector<std::pair<std::string, double>> cpu_ms; ///< Wall time of the steps of the command, in order
};

[[nodiscard]] std::string report_timings(const TimingReport& report, bool json);

/// Reports on all worlds.
[[nodiscard]] std::string report_worlds(bool json);

/// Returns the examples of all worlds for help, one per line, indented as other examples are.
[[nodiscard]] std::string world_examples();

} // namespace estampe::app
