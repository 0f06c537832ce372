// SPDX-License-Identifier: MIT
#pragma once

// Runs compiled graphs on a device: owns the memory of transient resources, records barriers, descriptors,
// dispatches and draws, and times each pass.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/graph/compile.hpp"
#include "gpu/pipelines.hpp"
#include "gpu/resources.hpp"
#include "gpu/shader_bindings.hpp"

namespace estampe::gpu {

class Executor;

/// Argument of a custom pass while it is recorded: the command buffer, and the resources behind the graph's
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

    /// Compiles and runs `graph`, and waits for it. Reuses the transient memory of recent runs where it
    /// fits.
    void run(const Graph& graph);

    /// Binds the shaders of `graph` without running them, from the last pass to the first, while `go_on`
    /// returns true. Drivers that compile at first use then compile them. Does not access the graph's
    /// resources.
    void use_shaders(const Graph& graph, const std::function<bool()>& go_on);

    /// Sets whether each pass is timed (the default) or only the whole run. Without timing per pass,
    /// independent passes overlap.
    void time_passes(bool each) { times_passes_ = each; }

    /// From now on, timings of runs are added up, until replace_timings().
    void add_timings()
    {
        timing_count_ = 0;
        adds_timings_ = true;
    }

    void replace_timings()
    {
        adds_timings_ = false;
        timing_count_ = 0;
    }

    /// GPU time of the last run, or the sum over the runs added up: from the start of a run's first pass to
    /// the end of its last.
    [[nodiscard]] double gpu_ms() const { return gpu_ms_; }

    /// The passes of the last run, or of the runs added up, in order, with the GPU time of each if passes
    /// were timed, else 0.
    [[nodiscard]] const std::vector<PassTiming>& timings() const { return timings_; }

    /// The passes of the last run only.
    [[nodiscard]] std::span<const PassTiming> timings_of_run() const
    {
        return std::span(timings_).subspan(first_of_run_);
    }

private:
    friend class Recorder;

    static constexpr uint32_t not_there = UINT32_MAX;

    /// A transient resource with the last run that used it.
    template <class T, class Desc>
    struct Kept {
        T resource;
        Desc desc;
        uint64_t last_run = 0;
    };

    /// Destroys the resources that the last `runs` runs did not use.
    void drop_unused(uint64_t runs);
    /// Starts a run: finds resources for the slots of the compiled graph. Returns the number of missing
    /// bytes.
    [[nodiscard]] uint64_t find_slots();
    void ensure_slots();
    void begin_commands();
    void end_and_run_commands();
    void record(VkCommandBuffer commands);
    void record_pass(VkCommandBuffer commands, const CompiledPass& compiled);
    /// Runs each pass alone and reports the costs to the watcher.
    void run_by_passes();
    void record_barriers(VkCommandBuffer commands, const std::vector<Barrier>& barriers);
    void record_dispatch(VkCommandBuffer commands, const PassRecord& pass);
    void record_draw(VkCommandBuffer commands, const PassRecord& pass);
    /// Types of the pass's bindings, in order. Builds with assertions check them against the shaders.
    [[nodiscard]] std::span<const VkDescriptorType> binding_types(const PassRecord& pass);
    [[nodiscard]] VkDescriptorSet bind(const PassRecord& pass, const Pipeline& pipeline);
    [[nodiscard]] const Image& image_of(uint32_t resource) const;
    [[nodiscard]] const Buffer& buffer_of(uint32_t resource) const;
    void ensure_stand_ins();
    void use_shader(const PassRecord& pass);
    void reset_frame();
    /// Milliseconds between two of the timestamps read.
    [[nodiscard]] double between_ms(size_t from, size_t to) const;
    void read_timings();
    void note_timing(const std::string& pass, double gpu_ms);
    void end_timings();

    Device& device_;
    PipelineCache pipelines_;
    BindingCheck binding_check_;
    VkCommandPool commands_pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptor_pool_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;

    const Graph* graph_ = nullptr; ///< Only set during run() and use_shaders()
    Compiler compiler_;
    CompiledGraph compiled_;
    std::vector<Kept<Image, ImageDesc>> images_;
    std::vector<Kept<Buffer, BufferDesc>> buffers_;
    std::vector<uint32_t> physical_of_slot_;
    uint64_t run_ = 0;
    std::vector<Image> stand_in_images_;   ///< One per resource, only during use_shaders()
    std::vector<Buffer> stand_in_buffers_; ///< One per resource, only during use_shaders()
    std::vector<PassTiming> timings_;
    size_t timing_count_ = 0; ///< Number of timings in use
    size_t first_of_run_ = 0; ///< Index into timings_
    bool adds_timings_ = false;
    bool times_passes_ = true;
    double gpu_ms_ = 0.0;

    // Scratch memory of recording, reused for each pass.
    std::vector<VkImageMemoryBarrier2> image_barriers_;
    std::vector<VkBufferMemoryBarrier2> buffer_barriers_;
    std::vector<VkDescriptorType> binding_types_;
    std::vector<VkDescriptorImageInfo> image_infos_;
    std::vector<VkDescriptorBufferInfo> buffer_infos_;
    std::vector<VkBufferView> texel_views_;
    std::vector<VkWriteDescriptorSet> writes_;
    std::vector<uint64_t> ticks_;
};

} // namespace estampe::gpu
