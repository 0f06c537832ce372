// SPDX-License-Identifier: MIT
#pragma once

// Tools for measuring: rounds and their times, a device that runs graphs, and pictures of results.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/renderer.hpp>

#include "core/spread.hpp"
#include "gpu/device.hpp"
#include "gpu/graph/execute.hpp"

namespace estampe::bench {

/// Measures wall time from its construction on.
class WallClock {
public:
    [[nodiscard]] double ms() const
    {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// GPU time of all passes together.
[[nodiscard]] double sum_ms(const std::vector<PassTiming>& passes);

/// Times of repeated measurements of one thing.
class Rounds {
public:
    /// Adds one round, and the passes of the round if they were timed.
    void add(double ms, const std::vector<PassTiming>& passes = {});

    [[nodiscard]] const std::vector<double>& times_ms() const { return times_ms_; }

    // These require at least one round.
    [[nodiscard]] double mean_ms() const;
    [[nodiscard]] double most_ms() const;

    /// "1.234 ms (1.200 to 1.300)": median and quartiles.
    [[nodiscard]] std::string text() const;

    /// A line for each pass, the most expensive first: its name, its mean time per round, and its time in the
    /// slowest round.
    [[nodiscard]] std::string passes_table() const;

private:
    std::vector<double> times_ms_;
    std::map<std::string, double> passes_ms_;  ///< sums over all rounds
    std::map<std::string, double> slowest_ms_; ///< times in the slowest round
};

/// A device with the executor that runs graphs on this device.
class Machine {
public:
    explicit Machine(const std::string& device_name);

    /// Runs the graph. Returns milliseconds: the sum of the passes' GPU times. On a CPU device returns wall
    /// time, because the device's own clock is wrong for short passes.
    double run(const gpu::Graph& graph);

    /// The passes of the last run.
    [[nodiscard]] const std::vector<PassTiming>& passes() const { return executor.timings(); }

    [[nodiscard]] const std::string& name() const { return device.info().name; }

    gpu::Device device;
    gpu::Executor executor;
};

/// Divides `total` steps among graphs of at most `most` steps each. Calls step(count, is_last) for each
/// graph.
template <class Step>
void in_batches(uint32_t total, uint32_t most, const Step& step)
{
    for (uint32_t left = total; left > 0;) {
        const uint32_t count = std::min(left, most);
        left -= count;
        step(count, left == 0);
    }
}

/// Writes a gray PNG file. `gray_at(x, y)` gives each pixel, x to the right and y down.
template <class GrayAt>
void save_gray_picture(uint32_t width, uint32_t height, const GrayAt& gray_at, const std::string& file)
{
    Image image{.width = width, .height = height};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const uint8_t gray = gray_at(x, y);
            image.rgba.insert(image.rgba.end(), {gray, gray, gray, 255});
        }
    }
    save_png(image, file);
}

} // namespace estampe::bench
