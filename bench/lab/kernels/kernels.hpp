// SPDX-License-Identifier: MIT
#pragma once

// Small kernels that show which constructs make a shader fast or slow on a device. Each experiment does one
// thing in several ways. These kernels are run alternately, so that their ratio does not depend on other load
// on the machine. Each kernel's output is compared with the CPU's.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/spread.hpp"
#include "gpu/device.hpp"
#include "gpu/resources.hpp"

namespace estampe::lab::kernels {

/// The constants that every kernel gets, as in lab.glsl. Each kernel gives `a` and `b` its own meaning.
struct Numbers {
    uint32_t threads = 0; ///< also the number of words that the kernel writes
    uint32_t rounds = 0;
    uint32_t a = 0;
    uint32_t b = 0;
};

/// One variant of an experiment: a compute shader, or a vertex and a fragment shader that draw a picture.
struct Kernel {
    std::string name;
    const gpu::Shader* compute = nullptr;
    const gpu::Shader* vertex = nullptr;
    const gpu::Shader* fragment = nullptr;
    uint32_t variant = 0;
    Numbers numbers;
    glm::uvec2 size_px{0}; ///< for compute shaders in squares of 8 x 8 threads, and for pictures
    gpu::Format picture = gpu::Format::r32ui;
    uint32_t vertex_count = 3;
    bool leaves_picture = false;   ///< true: also a compute shader writes a picture
    gpu::Image* texture = nullptr; ///< texture that the kernel samples; may be null
    gpu::Buffer* words = nullptr;  ///< buffer that the kernel reads; may be null
    size_t against = 0;            ///< index of the kernel whose time this kernel is compared with
    /// Whether the word that the kernel wrote at `index` is correct.
    std::function<bool(uint32_t index, uint32_t word)> is_right;
};

/// Amount of work: for a CPU, for a GPU, or only enough to check the results.
enum class Effort : uint8_t { check, processor, gpu };

/// Kernels, and the images and buffers that they read. Move-only.
struct Experiment {
    std::vector<Kernel> kernels;
    std::vector<std::unique_ptr<gpu::Image>> images;
    std::vector<std::unique_ptr<gpu::Buffer>> buffers;
};

/// An experiment that can be run.
struct Entry {
    const char* name;
    const char* about;
    Experiment (*make)(gpu::Device&, Effort);
};

/// All experiments, in the order of docs/laboratory.md.
[[nodiscard]] const std::vector<Entry>& all_experiments();

Experiment reads(gpu::Device& device, Effort effort);
Experiment branches(gpu::Device& device, Effort effort);
Experiment leaving(gpu::Device& device, Effort effort);
Experiment loops(gpu::Device& device, Effort effort);
Experiment minima(gpu::Device& device, Effort effort);
Experiment corners(gpu::Device& device, Effort effort);
Experiment memory_order(gpu::Device& device, Effort effort);
Experiment dead_code(gpu::Device& device, Effort effort);
Experiment stages(gpu::Device& device, Effort effort);
Experiment occupancy(gpu::Device& device, Effort effort);

struct KernelResult {
    std::string name;
    std::string against; ///< name of the reference kernel; the kernel's own name if it is the reference
    Spread ms;           ///< GPU time; on a CPU device, the time of all threads together
    Spread ratio;        ///< ratio to the reference kernel's time in the same round
};

struct ExperimentResult {
    std::string name;
    std::string about;
    std::vector<KernelResult> kernels;
};

struct KernelsResult {
    std::string device;
    std::string driver;
    bool software = false;
    uint32_t rounds = 0;
    std::vector<ExperimentResult> experiments;
};

/// Runs each kernel once and checks its output, then runs all kernels of an experiment alternately, `rounds`
/// times. Throws Error if an output is wrong, because then the kernel did not do the work that its name says.
[[nodiscard]] ExperimentResult run_experiment(gpu::Device& device, const Entry& entry, Effort effort,
                                              uint32_t rounds);

/// Runs several experiments on the device of that name. Calls `on_experiment` before each.
[[nodiscard]] KernelsResult run_experiments(const std::string& device,
                                            const std::vector<const Entry*>& entries, uint32_t rounds,
                                            const std::function<void(const Entry&)>& on_experiment);

/// Writes the result as a table, as JSON, and as CSV with one row per kernel.
[[nodiscard]] std::string text_of(const KernelsResult& result);
[[nodiscard]] std::string json_of(const KernelsResult& result);
[[nodiscard]] std::string csv_of(const KernelsResult& result);

// C++ versions of the functions of lab.glsl.

[[nodiscard]] constexpr uint32_t stir(uint32_t x)
{
    return (x ^ (x >> 15U)) * 0x2c1b3c6dU + 0x297a2d39U;
}

[[nodiscard]] constexpr uint32_t stir_otherwise(uint32_t x)
{
    return (x ^ (x >> 13U)) * 0x9e3779b1U + 0x85ebca6bU;
}

[[nodiscard]] constexpr uint32_t scattered(uint32_t x)
{
    return stir_otherwise(stir(stir_otherwise(x)));
}

[[nodiscard]] constexpr uint32_t next_of(uint32_t x)
{
    return x * 1664525U + 1013904223U;
}

/// Applies stir() `times` times.
[[nodiscard]] constexpr uint32_t stirred(uint32_t x, uint32_t times)
{
    for (uint32_t i = 0; i < times; ++i) {
        x = stir(x);
    }
    return x;
}

/// A square texture of words. `side` is a power of two. Texel p holds `word_of(p)`.
[[nodiscard]] std::unique_ptr<gpu::Image> texture_of(gpu::Device& device, uint32_t side, gpu::Format format,
                                                     const std::function<uint32_t(uint32_t)>& word_of);

/// A buffer of `count` words. Word p is `word_of(p)`.
[[nodiscard]] std::unique_ptr<gpu::Buffer> words_of(gpu::Device& device, uint32_t count,
                                                    const std::function<uint32_t(uint32_t)>& word_of);

/// Chooses one of three values by the amount of work.
template <class T>
[[nodiscard]] T by_effort(Effort effort, T for_check, T for_processor, T for_gpu)
{
    return effort == Effort::check ? for_check : effort == Effort::processor ? for_processor : for_gpu;
}

} // namespace estampe::lab::kernels
