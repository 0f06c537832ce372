// SPDX-License-Identifier: MIT
#include "gpu/graph/access.hpp"

namespace estampe::gpu {

StageAccess stage_access(Access access)
{
    constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 raster =
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    switch (access) {
    case Access::compute_sampled:
        return {compute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    case Access::compute_storage_read:
        return {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    case Access::compute_storage_write:
        return {compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    case Access::compute_storage_modify:
        return {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    case Access::compute_uniform:
        return {compute, VK_ACCESS_2_UNIFORM_READ_BIT};
    case Access::raster_sampled:
        return {raster, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    case Access::raster_storage_read:
        return {raster, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    case Access::raster_uniform:
        return {raster, VK_ACCESS_2_UNIFORM_READ_BIT};
    case Access::indirect:
        return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
    case Access::transfer_read:
        return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    case Access::transfer_write:
        return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    case Access::color_attachment:
        return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case Access::color_attachment_modify:
        return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case Access::depth_attachment:
        return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    case Access::host_read:
        return {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    }
    return {};
}

StageAccess stage_access(AccessSet accesses)
{
    StageAccess all;
    accesses.for_each([&](Access access) {
        all.stage |= stage_access(access).stage;
        all.access |= stage_access(access).access;
    });
    return all;
}

VkImageLayout vulkan_layout(Layout layout)
{
    switch (layout) {
    case Layout::undefined:
        return VK_IMAGE_LAYOUT_UNDEFINED;
    case Layout::general:
        return VK_IMAGE_LAYOUT_GENERAL;
    case Layout::shader_read:
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case Layout::transfer_source:
        return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Layout::transfer_target:
        return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    case Layout::color:
        return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case Layout::depth:
        return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    }
    return VK_IMAGE_LAYOUT_UNDEFINED;
}

} // namespace estampe::gpu
