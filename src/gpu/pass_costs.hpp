// SPDX-License-Identifier: MIT
#pragma once

// Costs of passes: their times in each frame, the bytes that they bind, and the arithmetic in their shaders.

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

/// GPU times of frames, per pass. A frame whose number of passes differs discards the frames before it.
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
    glm::uvec3 group{1U}; ///< Threads of a workgroup
};

/// Counts the operations of one thread, as if no branch skipped code and each loop ran once, with
/// specialization constant 0 set to `variant`. Of a branch on that constant, only the taken side is counted.
/// The result is a lower bound for kernels with loops, and may be too high for kernels with branches. Throws
/// std::logic_error if the words are not SPIR-V.
///
/// Cost    linear in words, about 0.1 ms for a large shader
/// Source  Khronos, "SPIR-V Specification", version 1.6
[[nodiscard]] ShaderOps ops_of(std::span<const uint32_t> spirv, uint32_t variant);

/// Measured costs of one pass.
struct PassWork {
    std::string name;
    double ms = 0.0; ///< GPU time; on a processor wall time minus the time of an empty run
    /// Size of the images and buffers that the pass binds, counted twice if it reads and writes them. This
    /// is the least memory traffic, unless a buffer is larger than its content.
    uint64_t bytes = 0;
    /// Threads times the count of ops_of(). Empty for passes without a shader, and if only the device knows
    /// the number of threads.
    std::optional<uint64_t> operations;
};

using RunWatch = std::function<void(std::span<const PassWork>)>;

/// From now on, every executor of this process runs its graphs pass by pass, waits for each pass, and
/// reports to `watch` afterwards. An empty `watch` ends this. Must not be called during a run.
void watch_runs(RunWatch watch);

[[nodiscard]] bool are_runs_watched();

/// The value of PassWork::bytes for `pass`.
[[nodiscard]] uint64_t bytes_of(const Graph& graph, const PassRecord& pass);

/// The value of PassWork::operations for `pass`.
[[nodiscard]] std::optional<uint64_t> operations_of(const Graph& graph, const PassRecord& pass);

} // namespace estampe::gpu
