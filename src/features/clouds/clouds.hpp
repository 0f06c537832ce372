// SPDX-License-Identifier: MIT
#pragma once

// What the clouds of a picture are drawn from.

#include "features/common/feature.hpp"
#include "gpu/resources.hpp"
#include "techniques/sky/clouds/clouds.hpp"

namespace estampe::features {

class Clouds final : public Feature {
public:
    /// Clouds are of the style and its time alone: nothing that happens to a scene outdates them.
    void invalidate(Event /*event*/) override {}

    /// Uploads the clouds of a plan; their shapes only where they are others than before.
    void upload(gpu::Device& device, const sky::CloudPlan& plan);

    /// The shapes that were planned last, for sky::plan_clouds().
    [[nodiscard]] sky::CloudMemory& memory() { return memory_; }

    /// What was uploaded, for sky::add_clouds() and sky::add_cloud_shadow().
    [[nodiscard]] sky::CloudHandles import(gpu::Graph& graph);

private:
    sky::CloudMemory memory_;
    std::shared_ptr<const sky::CloudShapes> shapes_; ///< what starts, puffs and streaks hold
    gpu::Buffer globals_;
    gpu::Buffer starts_;
    gpu::Buffer puffs_;
    gpu::Buffer streaks_;
};

} // namespace estampe::features
