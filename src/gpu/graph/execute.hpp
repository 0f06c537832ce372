// SPDX-License-Identifier: MIT
#pragma once

// Runs compiled frame graphs on a device. The executor owns the memory of transient resources; records
// barriers, descriptors, dispatches and draw calls; and times each pass.

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

/// Argument of a custom pass's recording function. Gives access to the command buffer, and to the images and
/// buffers behind the graph's handles.
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

    /// Compiles and runs `graph`, and waits until the device has finished. Throws TimeIsUp instead if the
    /// time limit of the current thread (JobLimits) is over. Reuses transient images and buffers of recent
    /// runs if they match.
    void run(const Graph& graph);

    /// Why the cache of compiled pipelines on disk was ignored, as one line; empty if it was not.
    [[nodiscard]] const std::string& pipelines_note() const { return pipelines_.note(); }

    /// Binds the shaders of `graph` without running them, from the last pass to the first, while `go_on`
    /// returns true. Drivers that compile a shader at its first use then compile all shaders of the graph.
    /// The resources of `graph` are not accessed.
    void use_shaders(const Graph& graph, const std::function<bool()>& go_on);

    /// Sets whether each pass is timed (the default), or only the whole run. Independent passes can overlap
    /// only if passes are not timed one by one.
    void time_passes(bool each) { times_passes_ = each; }

    /// Starts to add up the timings of runs; replace_timings() ends this.
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

    /// GPU time of the last run, or the sum over all runs since add_timings(). A run's time is measured from
    /// the start of its first pass to the end of its last pass.
    [[nodiscard]] double gpu_ms() const { return gpu_ms_; }

    /// The passes of the last run, or of all runs since add_timings(), in execution order. Each pass is
    /// listed with its GPU time, or 0 if passes were not timed.
    [[nodiscard]] const std::vector<PassTiming>& timings() const { return timings_; }

    /// The passes of the last run only, as in timings().
    [[nodiscard]] std::span<const PassTiming> timings_of_run() const
    {
        return std::span(timings_).subspan(first_of_run_);
    }

private:
    friend class Recorder;

    void create_pools();
    /// Destroys those pools that exist.
    void destroy_pools() noexcept;

    static constexpr uint32_t not_there = UINT32_MAX;

    /// A transient resource, and the number of the last run that used it.
    template <class T, class Desc>
    struct Kept {
        T resource;
        Desc desc;
        uint64_t last_run = 0;
    };

    /// Destroys the resources that the last `runs` runs did not use.
    void drop_unused(uint64_t runs);
    /// Starts a run: finds existing resources for the memory slots of the compiled graph. Returns the number
    /// of bytes that must still be allocated.
    [[nodiscard]] uint64_t find_slots();
    void ensure_slots();
    void begin_commands();
    void end_and_run_commands();
    void record(VkCommandBuffer commands);
    void record_pass(VkCommandBuffer commands, const CompiledPass& compiled);
    /// Runs each pass alone and reports the costs to the function that watch_runs() has set.
    void run_by_passes();
    void record_barriers(VkCommandBuffer commands, const std::vector<Barrier>& barriers);
    void record_dispatch(VkCommandBuffer commands, const PassRecord& pass);
    void record_draw(VkCommandBuffer commands, const PassRecord& pass);
    /// Descriptor types of the pass's bindings, in order. Builds with assertions check these types against
    /// the shaders.
    [[nodiscard]] std::span<const VkDescriptorType> binding_types(const PassRecord& pass);
    [[nodiscard]] VkDescriptorSet bind(const PassRecord& pass, const Pipeline& pipeline);
    [[nodiscard]] const Image& image_of(uint32_t resource) const;
    [[nodiscard]] const Buffer& buffer_of(uint32_t resource) const;
    void ensure_stand_ins();
    void use_shader(const PassRecord& pass);
    void reset_frame();
    /// Milliseconds between two of the timestamps in `ticks_`.
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

    const Graph* graph_ = nullptr; ///< Null except during run() and use_shaders()
    Compiler compiler_;
    CompiledGraph compiled_;
    std::vector<Kept<Image, ImageDesc>> images_;
    std::vector<Kept<Buffer, BufferDesc>> buffers_;
    std::vector<uint32_t> physical_of_slot_;
    uint64_t run_ = 0;
    std::vector<Image> stand_in_images_;   ///< One image per image of the graph; used by use_shaders()
    std::vector<Buffer> stand_in_buffers_; ///< One buffer per buffer of the graph; used by use_shaders()
    std::vector<PassTiming> timings_;
    size_t timing_count_ = 0; ///< Number of valid entries of timings_
    size_t first_of_run_ = 0; ///< Index of the last run's first pass in timings_
    bool adds_timings_ = false;
    bool times_passes_ = true;
    double gpu_ms_ = 0.0;

    // Scratch memory for recording a pass; reused for each pass.
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
