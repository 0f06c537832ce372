// SPDX-License-Identifier: MIT
#pragma once

// Measures the cost of passes: GPU time in each frame, bytes of the bound resources, and number of arithmetic
// operations in their shaders.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <estampe/renderer.hpp>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// GPU times of each pass over many frames. Adding a frame with a different number of passes discards all
/// earlier frames.
class PassHistory {
public:
    void add(const std::vector<PassTiming>& passes);

    void forget()
    {
        times_.clear();
        last_.clear();
    }

    [[nodiscard]] std::vector<PassTiming> medians() const;

private:
    std::vector<std::vector<double>> times_;
    std::vector<PassTiming> last_;
};

struct ShaderOps {
    /// Arithmetic operations on floats and integers, counted per component; a fused multiply-add counts as
    /// two, a square root or a sine as one.
    uint64_t operations = 0;
    glm::uvec3 group{1U}; ///< Workgroup size in threads
};

/// Counts the arithmetic operations of one thread, with specialization constant 0 set to `variant`. The count
/// assumes that no branch skips code and that each loop runs once. For a branch on that constant, only the
/// taken side is counted. The result is a lower bound for kernels with loops, and may be too high for kernels
/// with branches. Throws std::logic_error if `spirv` is not a SPIR-V module.
///
/// Cost    linear in words, about 0.1 ms for a large shader
/// Source  Khronos, "SPIR-V Specification", version 1.6
[[nodiscard]] ShaderOps ops_of(std::span<const uint32_t> spirv, uint32_t variant);

/// Measured costs of one pass.
struct PassWork {
    std::string name;
    double ms = 0.0; ///< GPU time; on a CPU device, wall time minus that of an empty run
    /// Total size of the images and buffers that the pass binds. A resource that the pass both reads and
    /// writes counts twice. The sum is a lower bound of the memory traffic, unless a buffer is larger than
    /// its content.
    uint64_t bytes = 0;
    /// Number of threads times the operation count of ops_of(). Empty if the pass has no shader, or if the
    /// number of threads is known only on the device.
    std::optional<uint64_t> operations;
};

using RunWatch = std::function<void(std::span<const PassWork>)>;

/// Makes every executor of this process run its graphs pass by pass and wait for each pass. The executor
/// calls `watch` after each run. An empty `watch` restores the normal execution. Must not be called during a
/// run.
void watch_runs(RunWatch watch);

[[nodiscard]] bool are_runs_watched();

/// Computes PassWork::bytes for `pass`.
[[nodiscard]] uint64_t bytes_of(const Graph& graph, const PassRecord& pass);

/// Computes PassWork::operations for `pass`.
[[nodiscard]] std::optional<uint64_t> operations_of(const Graph& graph, const PassRecord& pass);

} // namespace estampe::gpu
