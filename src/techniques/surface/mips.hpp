// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <vector>

#include <estampe/scene.hpp>

#include "gpu/resources.hpp"

namespace estampe::surface {

/// Makes all mip levels of `image`, resized to `side` x `side` (a power of two). Each level averages four
/// texels of the level above. Cost: about 10 ns per texel.
[[nodiscard]] gpu::LayerPixels make_mips(const Image& image, uint32_t side);

/// Computes the mip levels of several textures in advance, two at a time, so that uploads need not wait.
class MipQueue {
public:
    /// Starts computing. `scene` and `layers` must outlive the queue. Without layers the queue yields one
    /// white texel.
    MipQueue(const Scene& scene, const std::vector<Index>& layers, uint32_t side);

    /// The pixels of a layer with all mip levels. Call take() with 0, 1, 2, ... in order.
    [[nodiscard]] gpu::LayerPixels take(uint32_t layer);

private:
    void start(uint32_t layer);

    const Scene& scene_;
    const std::vector<Index>& layers_;
    uint32_t side_;
    std::vector<std::future<gpu::LayerPixels>> pending_;
};

} // namespace estampe::surface
