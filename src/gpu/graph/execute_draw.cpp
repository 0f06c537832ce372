// SPDX-License-Identifier: MIT
// Raster passes: dynamic rendering into the attachments that the pass declares.
#include <algorithm>
#include <array>
#include <optional>

#include "gpu/graph/access.hpp"
#include "gpu/graph/execute.hpp"

namespace estampe::gpu {
namespace {

constexpr size_t most_colors = 8; // devices promise four

/// What a raster pass draws into.
struct Targets {
    std::array<VkRenderingAttachmentInfo, most_colors> colors{};
    std::array<VkFormat, most_colors> color_formats{};
    uint32_t color_count = 0;
    std::optional<VkRenderingAttachmentInfo> depth;
    VkExtent2D extent{UINT32_MAX, UINT32_MAX}; ///< what all of them have
};

void add_target(Targets& targets, const Use& use, const Image& image, bool clears)
{
    const VkRenderingAttachmentInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                         .imageView = image.view(),
                                         .imageLayout = vulkan_layout(layout_for(use.access)),
                                         .loadOp = clears ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                          : VK_ATTACHMENT_LOAD_OP_LOAD,
                                         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                         .clearValue = {}}; // zeros: in reversed depth, the farthest
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
