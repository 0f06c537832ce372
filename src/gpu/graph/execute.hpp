// SPDX-License-Identifier: MIT
#pragma once

// Runs compiled graphs on a device: owns the transients' memory, records barriers, descriptors, dispatches
// and draws, and times each pass.

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

    /// Compiles and runs `graph`, and waits for it. Transient memory of the last runs is reused where it
    /// fits.
    void run(const Graph& graph);

    /// Binds the shaders of `graph`, from the last pass to the first, and runs none of them, until `go_on`
    /// says no: drivers that compile at first use compile them now. Touches nothing of the graph's resources.
    void use_shaders(const Graph& graph, const std::function<bool()>& go_on);

    /// Whether each pass is timed, or only what is run as a whole: passes that hang on none of each other
    /// then run side by side. At first each is.
    void time_passes(bool each) { times_passes_ = each; }

    /// What is run until the next replace_timings() is timed together.
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

    /// GPU time of the last run, or of those timed together, from the begin of the first pass of each to the
    /// end of its last.
    [[nodiscard]] double gpu_ms() const { return gpu_ms_; }

    /// The passes of these, in order, with the GPU time of each if passes were timed, or else 0.
    [[nodiscard]] const std::vector<PassTiming>& timings() const { return timings_; }

    /// Of the last run alone.
    [[nodiscard]] std::span<const PassTiming> timings_of_run() const
    {
        return std::span(timings_).subspan(first_of_run_);
    }

private:
    friend class Recorder;

    static constexpr uint32_t not_there = UINT32_MAX;

    /// A transient resource, and the run that took it last.
    template <class T, class Desc>
    struct Kept {
        T resource;
        Desc desc;
        uint64_t last_run = 0;
    };

    /// Those that no run took for so many.
    void drop_unused(uint64_t runs);
    /// Begins a run: finds what there is for the compiled graph. Returns how much is missing.
    [[nodiscard]] uint64_t find_slots();
    void ensure_slots();
    void begin_commands();
    void end_and_run_commands();
    void record(VkCommandBuffer commands);
    void record_pass(VkCommandBuffer commands, const CompiledPass& compiled);
    /// Runs each pass by itself, and tells who watches.
    void run_by_passes();
    void record_barriers(VkCommandBuffer commands, const std::vector<Barrier>& barriers);
    void record_dispatch(VkCommandBuffer commands, const PassRecord& pass);
    void record_draw(VkCommandBuffer commands, const PassRecord& pass);
    /// What the pass binds, in order. Builds with assertions hold it against what the shaders declare.
    [[nodiscard]] std::span<const VkDescriptorType> binding_types(const PassRecord& pass);
    [[nodiscard]] VkDescriptorSet bind(const PassRecord& pass, const Pipeline& pipeline);
    [[nodiscard]] const Image& image_of(uint32_t resource) const;
    [[nodiscard]] const Buffer& buffer_of(uint32_t resource) const;
    void ensure_stand_ins();
    void use_shader(const PassRecord& pass);
    void reset_frame();
    /// Milliseconds between two of the timestamps that were read.
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

    const Graph* graph_ = nullptr; ///< during run() and use_shaders() only
    Compiler compiler_;
    CompiledGraph compiled_;
    std::vector<Kept<Image, ImageDesc>> images_;
    std::vector<Kept<Buffer, BufferDesc>> buffers_;
    std::vector<uint32_t> physical_of_slot_;
    uint64_t run_ = 0;
    std::vector<Image> stand_in_images_;   ///< one a resource, during use_shaders() only
    std::vector<Buffer> stand_in_buffers_; ///< one a resource, during use_shaders() only
    std::vector<PassTiming> timings_;
    size_t timing_count_ = 0; ///< of those timed together, until now
    size_t first_of_run_ = 0; ///< of timings_
    bool adds_timings_ = false;
    bool times_passes_ = true;
    double gpu_ms_ = 0.0;

    // Room that recording takes again and again.
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
