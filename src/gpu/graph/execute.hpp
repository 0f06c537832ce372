// SPDX-License-Identifier: MIT
#pragma once

// Runs compiled graphs on a device: owns the transients' memory, records barriers, descriptors, dispatches
// and draws, and times each pass.

#include <functional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/graph/check_bindings.hpp"
#include "gpu/graph/compile.hpp"
#include "gpu/pipelines.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

class Executor;

/// What a custom pass sees while it is recorded: the command buffer, and the resources behind the graph's
/// handles.
class Recorder {
public:
    Recorder(Executor& executor, VkCommandBuffer commands) : executor_(executor), commands_(commands) {}

    [[nodiscard]] VkCommandBuffer commands() const { return commands_; }

    [[nodiscard]] const Image& image(ImageId id) const;
    [[nodiscard]] const Buffer& buffer(BufferId id) const;

private:
    Executor& executor_;
    VkCommandBuffer commands_;
};

class Executor {
public:
    explicit Executor(Device& device);
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Compiles and runs `graph`, and waits for it. Transient memory of the frame before is reused where it
    /// fits.
    void run(const Graph& graph);

    /// Binds the shaders of `graph`, from the last pass to the first, and runs none of them, until `go_on`
    /// says no: drivers that compile at first use compile them now. Touches nothing of the graph's resources.
    void use_shaders(const Graph& graph, const std::function<bool()>& go_on);

    /// GPU time by pass of the last run, in order.
    [[nodiscard]] const std::vector<PassTiming>& timings() const { return timings_; }

private:
    friend class Recorder;

    void provide_slots();
    void record(VkCommandBuffer commands);
    void record_barriers(VkCommandBuffer commands, const std::vector<Barrier>& barriers);
    void record_dispatch(VkCommandBuffer commands, const PassRecord& pass);
    void record_draw(VkCommandBuffer commands, const PassRecord& pass);
    /// What the pass binds, in order. Builds with assertions hold it against what the shaders declare.
    [[nodiscard]] std::vector<VkDescriptorType> binding_types(const PassRecord& pass);
    [[nodiscard]] VkDescriptorSet bind(const PassRecord& pass, const Pipeline& pipeline);
    [[nodiscard]] const Image& image_of(uint32_t resource) const;
    [[nodiscard]] const Buffer& buffer_of(uint32_t resource) const;
    void provide_stand_ins();
    void use_shader(const PassRecord& pass);
    void reset_frame();
    void read_timings();

    Device& device_;
    PipelineCache pipelines_;
    BindingCheck binding_check_;
    VkCommandPool commands_pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptor_pool_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;

    const Graph* graph_ = nullptr; ///< during run() and use_shaders() only
    CompiledGraph compiled_;
    std::vector<Image> images_;   ///< one per image slot
    std::vector<Buffer> buffers_; ///< one per buffer slot
    std::vector<uint32_t> physical_of_slot_;
    std::vector<Image> stand_in_images_;   ///< one a resource, during use_shaders() only
    std::vector<Buffer> stand_in_buffers_; ///< one a resource, during use_shaders() only
    std::vector<PassTiming> timings_;
};

} // namespace estampe::gpu
