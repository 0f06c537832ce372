// SPDX-License-Identifier: MIT
#include "gpu/graph/execute.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <estampe/error.hpp>

#include "core/job_limits.hpp"
#include "gpu/pass_costs.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {
namespace {

constexpr uint32_t max_passes = 1024;
constexpr uint32_t max_bindings_per_frame = 8192;

VkDescriptorType descriptor_type(const Use& use, bool is_image)
{
    if (!is_image) {
        return is_sampled(use.access)   ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
               : is_uniform(use.access) ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                        : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    return is_sampled(use.access) ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                  : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

} // namespace

const Image& Recorder::image(ImageId id) const
{
    return executor_.image_of(id.resource);
}

const Buffer& Recorder::buffer(BufferId id) const
{
    return executor_.buffer_of(id.resource);
}

Executor::Executor(Device& device) : device_(device), pipelines_(device)
{
    try {
        create_pools();
    } catch (...) {
        destroy_pools();
        throw;
    }
}

void Executor::create_pools()
{
    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .queueFamilyIndex = device_.queue_family()};
    vk_check(vkCreateCommandPool(device_.handle(), &pool_info, nullptr, &commands_pool_),
             "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = commands_pool_,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    vk_check(vkAllocateCommandBuffers(device_.handle(), &info, &commands_), "vkAllocateCommandBuffers");
    const std::array<VkDescriptorPoolSize, 5> sizes{{
        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, max_bindings_per_frame},
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, max_bindings_per_frame},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, max_bindings_per_frame},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, max_bindings_per_frame},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, max_bindings_per_frame},
    }};
    const VkDescriptorPoolCreateInfo descriptor_info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                     .maxSets = max_passes,
                                                     .poolSizeCount = static_cast<uint32_t>(sizes.size()),
                                                     .pPoolSizes = sizes.data()};
    vk_check(vkCreateDescriptorPool(device_.handle(), &descriptor_info, nullptr, &descriptor_pool_),
             "vkCreateDescriptorPool");
    const VkQueryPoolCreateInfo query_info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                           .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                           .queryCount = max_passes + 1};
    vk_check(vkCreateQueryPool(device_.handle(), &query_info, nullptr, &queries_), "vkCreateQueryPool");
}

Executor::~Executor()
{
    destroy_pools();
}

void Executor::destroy_pools() noexcept
{
    vkDestroyQueryPool(device_.handle(), queries_, nullptr);
    vkDestroyDescriptorPool(device_.handle(), descriptor_pool_, nullptr);
    vkDestroyCommandPool(device_.handle(), commands_pool_, nullptr);
}

const Image& Executor::image_of(uint32_t resource) const
{
    if (!stand_in_images_.empty()) {
        return stand_in_images_[resource];
    }
    const ResourceRecord& record = graph_->resources()[resource];
    return record.imported_image != nullptr
               ? *record.imported_image
               : images_[physical_of_slot_[compiled_.slot_of_resource[resource]]].resource;
}

const Buffer& Executor::buffer_of(uint32_t resource) const
{
    if (!stand_in_buffers_.empty()) {
        return stand_in_buffers_[resource];
    }
    const ResourceRecord& record = graph_->resources()[resource];
    return record.imported_buffer != nullptr
               ? *record.imported_buffer
               : buffers_[physical_of_slot_[compiled_.slot_of_resource[resource]]].resource;
}

void Executor::run(const Graph& graph)
{
    check_time();
    compiler_.compile(graph, compiled_);
    if (compiled_.passes.size() > max_passes) {
        throw Error("the frame has too many passes");
    }
    graph_ = &graph;
    first_of_run_ = timing_count_;
    gpu_ms_ = timing_count_ == 0 ? 0.0 : gpu_ms_;
    ensure_slots();
    if (are_runs_watched()) {
        run_by_passes();
    } else {
        begin_commands();
        record(commands_);
        end_and_run_commands();
        read_timings();
    }
    graph_ = nullptr;
}

void Executor::begin_commands()
{
    reset_frame();
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
}

void Executor::end_and_run_commands()
{
    vk_check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    device_.submit_and_wait(commands_);
}

void Executor::drop_unused(uint64_t runs)
{
    const auto is_old = [&](const auto& kept) { return kept.last_run + runs < run_; };
    std::erase_if(images_, is_old);
    std::erase_if(buffers_, is_old);
}

uint64_t Executor::find_slots()
{
    ++run_;
    uint64_t missing_bytes = 0;
    const auto find = [&](auto& all, const auto& desc, uint64_t bytes) {
        const auto found = std::ranges::find_if(
            all, [&](const auto& kept) { return kept.last_run != run_ && kept.desc == desc; });
        missing_bytes += found == all.end() ? bytes : 0;
        if (found == all.end()) {
            return not_there;
        }
        found->last_run = run_;
        return static_cast<uint32_t>(found - all.begin());
    };
    physical_of_slot_.clear();
    for (const Slot& slot : compiled_.slots) {
        physical_of_slot_.push_back(slot.is_image ? find(images_, slot.image, size_bytes(slot.image))
                                                  : find(buffers_, slot.buffer, slot.buffer.size_bytes));
    }
    return missing_bytes;
}

void Executor::ensure_slots()
{
    // Other graphs, such as cloth simulation steps, run between frames. The resources of a frame are
    // therefore kept for several runs.
    constexpr uint64_t runs_kept = 8;
    drop_unused(runs_kept);
    uint64_t missing_bytes = find_slots();
    if (!device_.memory().has(missing_bytes)) {
        drop_unused(0);
        missing_bytes = find_slots();
    }
    device_.memory().require(missing_bytes);
    for (size_t i = 0; i < compiled_.slots.size(); ++i) {
        const Slot& slot = compiled_.slots[i];
        if (physical_of_slot_[i] == not_there) {
            physical_of_slot_[i] = static_cast<uint32_t>(slot.is_image ? images_.size() : buffers_.size());
            if (slot.is_image) {
                images_.push_back({Image(device_, "transient", slot.image), slot.image, run_});
            } else {
                buffers_.push_back({Buffer(device_, "transient", slot.buffer.size_bytes, MemoryUse::device),
                                    slot.buffer, run_});
            }
        }
    }
}

void Executor::reset_frame()
{
    vk_check(vkResetCommandPool(device_.handle(), commands_pool_, 0), "vkResetCommandPool");
    vk_check(vkResetDescriptorPool(device_.handle(), descriptor_pool_, 0), "vkResetDescriptorPool");
    vkResetQueryPool(device_.handle(), queries_, 0, max_passes + 1);
}

void Executor::record(VkCommandBuffer commands)
{
    uint32_t query = 0;
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, query++);
    for (const CompiledPass& compiled : compiled_.passes) {
        record_pass(commands, compiled);
        if (times_passes_ || &compiled == &compiled_.passes.back()) {
            vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, query++);
        }
    }
}

void Executor::record_pass(VkCommandBuffer commands, const CompiledPass& compiled)
{
    const PassRecord& pass = graph_->passes()[compiled.pass];
    record_barriers(commands, compiled.barriers);
    if (pass.shader != nullptr) {
        record_dispatch(commands, pass);
    } else if (pass.is_raster()) {
        record_draw(commands, pass);
    } else if (pass.record) {
        Recorder recorder(*this, commands);
        pass.record(recorder);
    }
}

void Executor::record_barriers(VkCommandBuffer commands, const std::vector<Barrier>& barriers)
{
    image_barriers_.clear();
    buffer_barriers_.clear();
    for (const Barrier& barrier : barriers) {
        const ResourceRecord& resource = graph_->resources()[barrier.resource];
        // A resource without an earlier use in this frame waits for nothing, because the previous frame has
        // finished.
        const StageAccess before = stage_access(barrier.before);
        const StageAccess after = stage_access(barrier.after);
        if (resource.is_image) {
            const Image& image = image_of(barrier.resource);
            const VkImageAspectFlags aspect = image.desc().format == Format::depth32f
                                                  ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                  : VK_IMAGE_ASPECT_COLOR_BIT;
            image_barriers_.push_back(
                {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                 .srcStageMask = before.stage,
                 .srcAccessMask = before.access,
                 .dstStageMask = after.stage,
                 .dstAccessMask = after.access,
                 .oldLayout = vulkan_layout(barrier.old_layout),
                 .newLayout = vulkan_layout(barrier.new_layout),
                 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                 .image = image.handle(),
                 .subresourceRange = {aspect, 0, image.desc().mips, 0, image.desc().layers}});
        } else if (!barrier.first_use()) {
            buffer_barriers_.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                        .srcStageMask = before.stage,
                                        .srcAccessMask = before.access,
                                        .dstStageMask = after.stage,
                                        .dstAccessMask = after.access,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .buffer = buffer_of(barrier.resource).handle(),
                                        .size = VK_WHOLE_SIZE});
        }
    }
    if (image_barriers_.empty() && buffer_barriers_.empty()) {
        return;
    }
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .bufferMemoryBarrierCount = static_cast<uint32_t>(buffer_barriers_.size()),
        .pBufferMemoryBarriers = buffer_barriers_.data(),
        .imageMemoryBarrierCount = static_cast<uint32_t>(image_barriers_.size()),
        .pImageMemoryBarriers = image_barriers_.data()};
    vkCmdPipelineBarrier2(commands, &dependency);
}

std::span<const VkDescriptorType> Executor::binding_types(const PassRecord& pass)
{
#ifndef NDEBUG
    binding_check_.check(*graph_, pass);
#endif
    binding_types_.clear();
    for (const Use& use : pass.uses) {
        if (use.bound) {
            binding_types_.push_back(descriptor_type(use, graph_->resources()[use.resource].is_image));
        }
    }
    return binding_types_;
}

void Executor::record_dispatch(VkCommandBuffer commands, const PassRecord& pass)
{
    const Pipeline& pipeline = pipelines_.get(*pass.shader, binding_types(pass),
                                              static_cast<uint32_t>(pass.push.size()), pass.variant);
    const VkDescriptorSet set = bind(pass, pipeline);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0,
                            nullptr);
    if (!pass.push.empty()) {
        vkCmdPushConstants(commands, pipeline.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           static_cast<uint32_t>(pass.push.size()), pass.push.data());
    }
    const Dispatch& dispatch = pass.dispatch;
    if (dispatch.indirect_resource != UINT32_MAX) {
        vkCmdDispatchIndirect(commands, buffer_of(dispatch.indirect_resource).handle(),
                              dispatch.indirect_offset_bytes);
    } else {
        vkCmdDispatch(commands, dispatch.groups_x, dispatch.groups_y, dispatch.groups_z);
    }
}

VkDescriptorSet Executor::bind(const PassRecord& pass, const Pipeline& pipeline)
{
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = descriptor_pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &pipeline.set_layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    vk_check(vkAllocateDescriptorSets(device_.handle(), &info, &set), "vkAllocateDescriptorSets");

    image_infos_.assign(pass.uses.size(), {});
    buffer_infos_.assign(pass.uses.size(), {});
    texel_views_.assign(pass.uses.size(), VK_NULL_HANDLE);
    writes_.clear();
    for (size_t i = 0; i < pass.uses.size(); ++i) {
        const Use& use = pass.uses[i];
        if (!use.bound) {
            continue;
        }
        const bool is_image = graph_->resources()[use.resource].is_image;
        if (is_image) {
            image_infos_[i] = {.sampler =
                                   is_sampled(use.access) ? pipelines_.sampler(use.sampling) : VK_NULL_HANDLE,
                               .imageView = image_of(use.resource).view(),
                               .imageLayout = vulkan_layout(layout_for(use.access))};
        } else if (is_sampled(use.access)) {
            texel_views_[i] = buffer_of(use.resource).texels(use.texel);
        } else {
            buffer_infos_[i] = {.buffer = buffer_of(use.resource).handle(), .range = VK_WHOLE_SIZE};
        }
        writes_.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                           .dstSet = set,
                           .dstBinding = static_cast<uint32_t>(writes_.size()),
                           .descriptorCount = 1,
                           .descriptorType = descriptor_type(use, is_image),
                           .pImageInfo = &image_infos_[i],
                           .pBufferInfo = &buffer_infos_[i],
                           .pTexelBufferView = &texel_views_[i]});
    }
    vkUpdateDescriptorSets(device_.handle(), static_cast<uint32_t>(writes_.size()), writes_.data(), 0,
                           nullptr);
    return set;
}

double Executor::between_ms(size_t from, size_t to) const
{
    return static_cast<double>(ticks_[to] - ticks_[from]) * device_.timestamp_period_ns() * 1e-6;
}

void Executor::read_timings()
{
    const size_t passes = compiled_.passes.size();
    const auto count = static_cast<uint32_t>(times_passes_ ? passes + 1 : std::min<size_t>(passes, 1) + 1);
    ticks_.resize(count);
    vk_check(vkGetQueryPoolResults(device_.handle(), queries_, 0, count, count * sizeof(uint64_t),
                                   ticks_.data(), sizeof(uint64_t),
                                   VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
             "vkGetQueryPoolResults");
    for (size_t i = 0; i < passes; ++i) {
        note_timing(graph_->passes()[compiled_.passes[i].pass].name,
                    times_passes_ ? between_ms(i, i + 1) : 0.0);
    }
    gpu_ms_ += between_ms(0, count - 1);
    end_timings();
}

void Executor::note_timing(const std::string& pass, double gpu_ms)
{
    if (timing_count_ == timings_.size()) {
        timings_.emplace_back();
    }
    timings_[timing_count_].name = pass; // The assignment reuses the memory of the previous name
    timings_[timing_count_].gpu_ms = gpu_ms;
    ++timing_count_;
}

void Executor::end_timings()
{
    timings_.resize(timing_count_);
    if (!adds_timings_) {
        timing_count_ = 0;
    }
}

// Raster passes render into their declared attachments with Vulkan's dynamic rendering.

namespace {

// Largest number of color attachments that is supported; Vulkan guarantees only four.
constexpr size_t most_colors = 8;

/// Attachments of a raster pass.
struct Targets {
    std::array<VkRenderingAttachmentInfo, most_colors> colors{};
    std::array<VkFormat, most_colors> color_formats{};
    uint32_t color_count = 0;
    std::optional<VkRenderingAttachmentInfo> depth;
    VkExtent2D extent{UINT32_MAX, UINT32_MAX}; ///< Size of all attachments in pixels
};

void add_target(Targets& targets, const Use& use, const Image& image, bool clears)
{
    const VkRenderingAttachmentInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                         .imageView = image.view(),
                                         .imageLayout = vulkan_layout(layout_for(use.access)),
                                         .loadOp = clears ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                          : VK_ATTACHMENT_LOAD_OP_LOAD,
                                         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                         .clearValue = {}}; // In reversed depth, zero is the farthest depth
    targets.extent = {std::min(targets.extent.width, image.desc().width),
                      std::min(targets.extent.height, image.desc().height)};
    if (use.access == Access::depth_attachment) {
        targets.depth = info;
    } else {
        targets.colors.at(targets.color_count) = info;
        targets.color_formats.at(targets.color_count) = vulkan_format(image.desc().format);
        ++targets.color_count;
    }
}

} // namespace

void Executor::record_draw(VkCommandBuffer commands, const PassRecord& pass)
{
    Targets targets;
    for (const Use& use : pass.uses) {
        if (is_write(use.access)) {
            const bool is_new =
                use.version == 0 && graph_->resources()[use.resource].imported_image == nullptr;
            add_target(targets, use, image_of(use.resource), is_new);
        }
    }
    const DrawState state{.vertex = pass.draw.vertex,
                          .fragment = pass.draw.fragment,
                          .color_formats = std::span(targets.color_formats).first(targets.color_count),
                          .depth_format =
                              targets.depth ? vulkan_format(Format::depth32f) : VK_FORMAT_UNDEFINED,
                          .cull_back_faces = pass.draw.cull_back_faces};
    const Pipeline& pipeline =
        pipelines_.get(state, binding_types(pass), static_cast<uint32_t>(pass.push.size()), pass.variant);
    const VkDescriptorSet set = bind(pass, pipeline);

    const VkRect2D area{.extent = targets.extent};
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = area,
                                    .layerCount = 1,
                                    .colorAttachmentCount = targets.color_count,
                                    .pColorAttachments = targets.colors.data(),
                                    .pDepthAttachment = targets.depth ? &*targets.depth : nullptr};
    const VkViewport viewport{.width = static_cast<float>(area.extent.width),
                              .height = static_cast<float>(area.extent.height),
                              .minDepth = 0.0F,
                              .maxDepth = 1.0F};
    vkCmdBeginRendering(commands, &rendering);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1, &set, 0,
                            nullptr);
    if (!pass.push.empty()) {
        vkCmdPushConstants(commands, pipeline.layout,
                           VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                           static_cast<uint32_t>(pass.push.size()), pass.push.data());
    }
    if (pass.draw.indirect_resource != UINT32_MAX) {
        vkCmdDrawIndirect(commands, buffer_of(pass.draw.indirect_resource).handle(), 0, 1, 0);
    } else {
        vkCmdDraw(commands, pass.draw.vertex_count, 1, 0, 0);
    }
    vkCmdEndRendering(commands);
}

} // namespace estampe::gpu
