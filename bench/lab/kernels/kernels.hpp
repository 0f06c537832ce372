// SPDX-License-Identifier: MIT
#pragma once

// Small kernels that show what makes a shader quick or slow on the device at hand. Each experiment does one
// thing in several ways, which are run in turn, so that their ratio does not depend on how busy the machine
// is; what each leaves is held against what the processor finds.

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

/// What every kernel is given, as lab.glsl has it; `a` and `b` are each kernel's own.
struct Numbers {
    uint32_t threads = 0; ///< and words that the kernel leaves
    uint32_t rounds = 0;
    uint32_t a = 0;
    uint32_t b = 0;
};

/// One way of doing it: a compute shader, or a vertex and a fragment shader that draw a picture.
struct Kernel {
    std::string name;
    const gpu::Shader* compute = nullptr;
    const gpu::Shader* vertex = nullptr;
    const gpu::Shader* fragment = nullptr;
    uint32_t variant = 0;
    Numbers numbers;
    glm::uvec2 size_px{0}; ///< of compute shaders in squares of 8 x 8 threads; of pictures
    gpu::Format picture = gpu::Format::r32ui;
    uint32_t vertex_count = 3;
    bool leaves_picture = false;   ///< a compute shader's too
    gpu::Image* texture = nullptr; ///< that it samples, where it does
    gpu::Buffer* words = nullptr;  ///< that it reads, where it does
    size_t against = 0;            ///< number of the kernel that it is compared with
    /// Whether it left what it should, at `index`.
    std::function<bool(uint32_t index, uint32_t word)> is_right;
};

/// How much is done: for a processor, for a GPU, or only enough to see that the results are right.
enum class Effort : uint8_t { check, processor, gpu };

/// Kernels and what they read. Move-only.
struct Experiment {
    std::vector<Kernel> kernels;
    std::vector<std::unique_ptr<gpu::Image>> images;
    std::vector<std::unique_ptr<gpu::Buffer>> buffers;
};

/// What there is to be tried.
struct Entry {
    const char* name;
    const char* about;
    Experiment (*make)(gpu::Device&, Effort);
};

/// In the order of docs/laboratory.md.
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
    std::string against; ///< name of what it is compared with; its own where that is itself
    Spread ms;           ///< GPU time; on a processor what all of its threads took together
    Spread ratio;        ///< to the other's in the same round
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

/// Runs each kernel once and checks what it left, then all of an experiment in turn, `rounds` times. Throws
/// Error when a kernel left anything else than it should: what was measured would not be what its name says.
[[nodiscard]] ExperimentResult run_experiment(gpu::Device& device, const Entry& entry, Effort effort,
                                              uint32_t rounds);

/// Runs several experiments on the device of that name. Calls `on_experiment` before each.
[[nodiscard]] KernelsResult run_experiments(const std::string& device,
                                            const std::vector<const Entry*>& entries, uint32_t rounds,
                                            const std::function<void(const Entry&)>& on_experiment);

/// As a table, as JSON, and as a row for each kernel.
[[nodiscard]] std::string text_of(const KernelsResult& result);
[[nodiscard]] std::string json_of(const KernelsResult& result);
[[nodiscard]] std::string csv_of(const KernelsResult& result);

// The functions of lab.glsl.

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

/// stir(), so many times.
[[nodiscard]] constexpr uint32_t stirred(uint32_t x, uint32_t times)
{
    for (uint32_t i = 0; i < times; ++i) {
        x = stir(x);
    }
    return x;
}

/// A square texture of words, `side` a power of two, texel p of which is `word_of(p)`.
[[nodiscard]] std::unique_ptr<gpu::Image> texture_of(gpu::Device& device, uint32_t side, gpu::Format format,
                                                     const std::function<uint32_t(uint32_t)>& word_of);

/// So many words.
[[nodiscard]] std::unique_ptr<gpu::Buffer> words_of(gpu::Device& device, uint32_t count,
                                                    const std::function<uint32_t(uint32_t)>& word_of);

/// By how much work is done.
template <class T>
[[nodiscard]] T by_effort(Effort effort, T for_check, T for_processor, T for_gpu)
{
    return effort == Effort::check ? for_check : effort == Effort::processor ? for_processor : for_gpu;
}

} // namespace estampe::lab::kernels
