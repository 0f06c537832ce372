// SPDX-License-Identifier: MIT
#pragma once

// What passes cost: their times, frame by frame, the bytes that they bind and the arithmetic in their
// shaders.

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
    /// Additions, multiplications and the like, on floats and whole numbers, of each component; a fused
    /// multiply-add is two, a square root or a sine one.
    uint64_t operations = 0;
    glm::uvec3 group{1U}; ///< threads of a workgroup
};

/// Counts what a thread comes by when no branch leaves anything out and each loop runs once, with
/// specialization constant 0 at `variant`: branches that this decides count on the side taken alone. Of
/// kernels that loop it is the least; of those that branch it may be more than is done. Throws
/// std::logic_error when the words are no SPIR-V.
///
/// Cost    linear in words, some 0.1 ms for a large shader
/// Source  Khronos, "SPIR-V Specification", version 1.6
[[nodiscard]] ShaderOps ops_of(std::span<const uint32_t> spirv, uint32_t variant);

/// What one pass did and took.
struct PassWork {
    std::string name;
    double ms = 0.0; ///< GPU time; on a processor wall time, less what an empty run takes
    /// What it binds, each image and buffer once, and twice where it is read and written: what memory has to
    /// move at least, but for buffers that are larger than what is in them.
    uint64_t bytes = 0;
    /// Threads times what ops_of() counts in the shader. Nothing where only the device knows how many
    /// threads, and for passes without a shader.
    std::optional<uint64_t> operations;
};

using RunWatch = std::function<void(std::span<const PassWork>)>;

/// From now on each run of any executor of this process runs pass by pass, waits for each, and tells `watch`
/// afterwards; an empty one ends that. Not while anything runs.
void watch_runs(RunWatch watch);

[[nodiscard]] bool are_runs_watched();

/// Bytes of `pass` as PassWork has them.
[[nodiscard]] uint64_t bytes_of(const Graph& graph, const PassRecord& pass);

/// Operations of `pass` as PassWork has them.
[[nodiscard]] std::optional<uint64_t> operations_of(const Graph& graph, const PassRecord& pass);

} // namespace estampe::gpu
