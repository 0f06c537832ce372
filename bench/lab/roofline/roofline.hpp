// SPDX-License-Identifier: MIT
#pragma once

// Each pass of a frame, held against what the device can copy and compute, which kernels of its own measure.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/spread.hpp"
#include "gpu/device.hpp"
#include "lab/series.hpp"

namespace estampe::lab::roofline {

/// What the device can do at most.
struct Ceilings {
    double bytes_a_s = 0.0;      ///< read and written by a copy, together
    double operations_a_s = 0.0; ///< on 32-bit floats; a fused multiply-add is two
};

/// Best of `rounds` of a copy, and of multiply-adds that wait for nothing. Cost: some 0.1 s on a GPU, 1 s on
/// a processor; memory for the copy, 512 MiB on a GPU and 64 on a processor.
[[nodiscard]] Ceilings measure_ceilings(gpu::Device& device, uint32_t rounds);

/// A picture whose passes are looked at.
struct Entry {
    const char* name;
    const char* about;
    BenchPicture (*picture)(bool software, uint32_t width, uint32_t height);
};

[[nodiscard]] const std::vector<Entry>& all_pictures();

/// One pass of a picture, by its name: all that have it are added up.
struct PassCost {
    std::string name;
    Spread ms;
    double share = 0.0;                 ///< of the picture's time
    uint64_t bytes = 0;                 ///< as gpu::PassWork has them
    std::optional<uint64_t> operations; ///< likewise
};

struct PictureCost {
    std::string name;
    std::string about;
    double ms = 0.0;              ///< sum of the passes' medians
    std::vector<PassCost> passes; ///< dearest first; those that are hardly anything left out
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
    double least_share = 0.02; ///< of a picture's time, below which a pass is left out
};

/// Draws the pictures pass by pass. `on_picture` is told what is about to be drawn. Throws Error as Renderer
/// does.
[[nodiscard]] Result measure(const std::vector<const Entry*>& entries, const Plan& plan,
                             const std::function<void(const Entry&)>& on_picture);

/// What a pass comes to of a ceiling: 1 where it is all that the device can do.
[[nodiscard]] double share_of_copy(const PassCost& pass, const Ceilings& ceilings);
[[nodiscard]] std::optional<double> share_of_arithmetic(const PassCost& pass, const Ceilings& ceilings);

/// As a table, as JSON, and as a row for each pass.
[[nodiscard]] std::string text_of(const Result& result);
[[nodiscard]] std::string json_of(const Result& result);
[[nodiscard]] std::string csv_of(const Result& result);

} // namespace estampe::lab::roofline
