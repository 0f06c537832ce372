// SPDX-License-Identifier: MIT
#pragma once

// Compares each pass of a frame with the device's copy and arithmetic speed, which separate kernels measure.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/spread.hpp"
#include "gpu/device.hpp"
#include "lab/series.hpp"

namespace estampe::lab::roofline {

/// The largest throughput of the device.
struct Ceilings {
    double bytes_a_s = 0.0;      ///< bytes read plus bytes written by a copy, per second
    double operations_a_s = 0.0; ///< per second, on 32-bit floats; a fused multiply-add counts as two
};

/// Best of `rounds` runs of a copy, and of independent multiply-adds. Cost: some 0.1 s on a GPU, 1 s on a
/// CPU; memory for the copy, 512 MiB on a GPU and 64 MiB on a CPU.
[[nodiscard]] Ceilings measure_ceilings(gpu::Device& device, uint32_t rounds);

/// A picture whose passes are measured.
struct Entry {
    const char* name;
    const char* about;
    BenchPicture (*picture)(bool software, uint32_t width, uint32_t height);
};

[[nodiscard]] const std::vector<Entry>& all_pictures();

/// Sum of all passes of a picture that have one name.
struct PassCost {
    std::string name;
    Spread ms;
    double share = 0.0;                 ///< share of the picture's time
    uint64_t bytes = 0;                 ///< as gpu::PassWork counts bytes
    std::optional<uint64_t> operations; ///< as gpu::PassWork counts operations
};

struct PictureCost {
    std::string name;
    std::string about;
    double ms = 0.0;              ///< sum of the passes' medians
    std::vector<PassCost> passes; ///< most expensive first; very small passes are left out
};

struct Result {
    std::string device;
    std::string driver;
    bool software = false;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t frames = 0;
    Ceilings ceilings;
    std::vector<PictureCost> pictures;
};

struct Plan {
    RendererOptions device;
    uint32_t width = 1280;
    uint32_t height = 720;
    uint32_t frames = 9;
    double least_share = 0.02; ///< passes below this share of a picture's time are left out
};

/// Draws the pictures pass by pass. Calls `on_picture` before each picture. Throws Error as Renderer does.
[[nodiscard]] Result measure(const std::vector<const Entry*>& entries, const Plan& plan,
                             const std::function<void(const Entry&)>& on_picture);

/// The speed of a pass as a share of a ceiling: 1 if the pass is as fast as the device can be.
[[nodiscard]] double share_of_copy(const PassCost& pass, const Ceilings& ceilings);
[[nodiscard]] std::optional<double> share_of_arithmetic(const PassCost& pass, const Ceilings& ceilings);

/// Writes the result as a table, as JSON, and as CSV with one row per pass.
[[nodiscard]] std::string text_of(const Result& result);
[[nodiscard]] std::string json_of(const Result& result);
[[nodiscard]] std::string csv_of(const Result& result);

} // namespace estampe::lab::roofline
