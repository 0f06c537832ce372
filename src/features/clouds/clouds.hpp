// SPDX-License-Identifier: MIT
#pragma once

// The buffers that hold a picture's clouds.

#include "features/common/feature.hpp"
#include "gpu/resources.hpp"
#include "techniques/sky/clouds/clouds.hpp"

namespace estampe::features {

class Clouds final : public Feature {
public:
    /// Does nothing: clouds depend only on the style and its time, so no change of the scene makes them
    /// obsolete.
    void invalidate(Event /*event*/) override {}

    /// Uploads the clouds of a plan. The shapes of the clouds are uploaded only if they have changed.
    void upload(gpu::Device& device, const sky::CloudPlan& plan);

    /// Returns the cloud shapes of the last plan, for sky::plan_clouds().
    [[nodiscard]] sky::CloudMemory& memory() { return memory_; }

    /// Returns the handles of the uploaded buffers, for sky::add_clouds() and sky::add_cloud_shadow().
    [[nodiscard]] sky::CloudHandles import(gpu::Graph& graph);

private:
    sky::CloudMemory memory_;
    /// Cloud shapes whose data is in starts_, puffs_ and streaks_.
    std::shared_ptr<const sky::CloudShapes> shapes_;
    gpu::Buffer globals_;
    gpu::Buffer starts_;
    gpu::Buffer puffs_;
    gpu::Buffer streaks_;
};

} // namespace estampe::features
