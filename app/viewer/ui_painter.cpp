// SPDX-License-Identifier: MIT
#include "viewer/ui_painter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include <glm/glm.hpp>
#include <imgui.h>

#include "shaders/ui_frag.hpp"
#include "shaders/ui_vert.hpp"

namespace estampe::viewer {
namespace {

using gpu::vk_check;

VkImageMemoryBarrier2 barrier_of(VkImage image)
{
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
}

} // namespace

Texture::Texture(Screen& screen, VkDescriptorPool pool, VkDescriptorSetLayout layout, VkSampler sampler)
    : screen_(screen), pool_(pool), sampler_(sampler)
{
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    vk_check(screen_.vk().AllocateDescriptorSets(screen_.device(), &info, &descriptor_),
             "vkAllocateDescriptorSets");
}

Texture::~Texture()
{
    screen_.vk().DeviceWaitIdle(screen_.device());
    destroy();
    screen_.vk().FreeDescriptorSets(screen_.device(), pool_, 1, &descriptor_);
}

void Texture::destroy()
{
    const DeviceFunctions& vk = screen_.vk();
    vk.DestroyImageView(screen_.device(), view_, nullptr);
    vk.DestroyImage(screen_.device(), image_, nullptr);
    vk.FreeMemory(screen_.device(), image_memory_.memory, nullptr);
    vk.DestroyBuffer(screen_.device(), staging_, nullptr);
    vk.FreeMemory(screen_.device(), staging_memory_.memory, nullptr);
    image_ = VK_NULL_HANDLE;
    view_ = VK_NULL_HANDLE;
    staging_ = VK_NULL_HANDLE;
    image_memory_ = {};
    staging_memory_ = {};
}

void Texture::create(uint32_t width, uint32_t height)
{
    const DeviceFunctions& vk = screen_.vk();
    destroy();
    width_ = width;
    height_ = height;
    const VkBufferCreateInfo buffer_info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                         .size = VkDeviceSize{4} * width * height,
                                         .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    vk_check(vk.CreateBuffer(screen_.device(), &buffer_info, nullptr, &staging_), "vkCreateBuffer");
    staging_memory_ = screen_.allocate(staging_);
    const VkImageCreateInfo image_info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                       .imageType = VK_IMAGE_TYPE_2D,
                                       .format = VK_FORMAT_R8G8B8A8_UNORM,
                                       .extent = {width, height, 1},
                                       .mipLevels = 1,
                                       .arrayLayers = 1,
                                       .samples = VK_SAMPLE_COUNT_1_BIT,
                                       .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    vk_check(vk.CreateImage(screen_.device(), &image_info, nullptr, &image_), "vkCreateImage");
    image_memory_ = screen_.allocate(image_);
    const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                          .image = image_,
                                          .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                          .format = image_info.format,
                                          .subresourceRange = barrier_of(image_).subresourceRange};
    vk_check(vk.CreateImageView(screen_.device(), &view_info, nullptr, &view_), "vkCreateImageView");
    const VkDescriptorImageInfo sampled{
        .sampler = sampler_, .imageView = view_, .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = descriptor_,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                     .pImageInfo = &sampled};
    vk.UpdateDescriptorSets(screen_.device(), 1, &write, 0, nullptr);
}

void Texture::set(uint32_t width, uint32_t height, std::span<const uint8_t> rgba)
{
    screen_.wait();
    if (width != width_ || height != height_) {
        create(width, height);
    }
    std::memcpy(staging_memory_.mapped, rgba.data(), rgba.size());
    is_new_ = true;
}

void Texture::record_upload(VkCommandBuffer commands)
{
    if (!is_new_) {
        return;
    }
    is_new_ = false;
    const DeviceFunctions& vk = screen_.vk();
    VkImageMemoryBarrier2 barrier = barrier_of(image_);
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount = 1,
                                      .pImageMemoryBarriers = &barrier};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    vk.CmdPipelineBarrier2(commands, &dependency);
    const VkBufferImageCopy region{
        .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
        .imageExtent = {width_, height_, 1}};
    vk.CmdCopyBufferToImage(commands, staging_, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    vk.CmdPipelineBarrier2(commands, &dependency);
}

namespace {

struct PushConstants {
    glm::vec2 clip_from_px;
    glm::vec2 origin_px;
};

VkShaderModule make_module(const Screen& screen, const gpu::Shader& shader)
{
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = shader.spirv.size_bytes(),
                                        .pCode = shader.spirv.data()};
    VkShaderModule made = VK_NULL_HANDLE;
    vk_check(screen.vk().CreateShaderModule(screen.device(), &info, nullptr, &made), "vkCreateShaderModule");
    return made;
}

} // namespace

UiPainter::UiPainter(Screen& screen) : screen_(screen)
{
    create_layout();
    create_pipeline();
}

UiPainter::~UiPainter()
{
    const DeviceFunctions& vk = screen_.vk();
    vk.DeviceWaitIdle(screen_.device());
    fonts_.reset();
    destroy(vertices_);
    destroy(indices_);
    vk.DestroyPipeline(screen_.device(), pipeline_, nullptr);
    vk.DestroyPipelineLayout(screen_.device(), layout_, nullptr);
    vk.DestroyDescriptorPool(screen_.device(), pool_, nullptr);
    vk.DestroyDescriptorSetLayout(screen_.device(), set_layout_, nullptr);
    vk.DestroySampler(screen_.device(), sampler_, nullptr);
}

void UiPainter::create_layout()
{
    constexpr uint32_t most_textures = 16;
    const DeviceFunctions& vk = screen_.vk();
    const VkSamplerCreateInfo sampler_info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                           .magFilter = VK_FILTER_LINEAR,
                                           .minFilter = VK_FILTER_LINEAR,
                                           .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    vk_check(vk.CreateSampler(screen_.device(), &sampler_info, nullptr, &sampler_), "vkCreateSampler");
    const VkDescriptorSetLayoutBinding binding{.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                               .descriptorCount = 1,
                                               .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};
    const VkDescriptorSetLayoutCreateInfo set_info{.sType =
                                                       VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                   .bindingCount = 1,
                                                   .pBindings = &binding};
    vk_check(vk.CreateDescriptorSetLayout(screen_.device(), &set_info, nullptr, &set_layout_),
             "vkCreateDescriptorSetLayout");
    const VkDescriptorPoolSize size{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                    .descriptorCount = most_textures};
    const VkDescriptorPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                               .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                               .maxSets = most_textures,
                                               .poolSizeCount = 1,
                                               .pPoolSizes = &size};
    vk_check(vk.CreateDescriptorPool(screen_.device(), &pool_info, nullptr, &pool_),
             "vkCreateDescriptorPool");
    const VkPushConstantRange push{.stageFlags = VK_SHADER_STAGE_VERTEX_BIT, .size = sizeof(PushConstants)};
    const VkPipelineLayoutCreateInfo layout_info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                 .setLayoutCount = 1,
                                                 .pSetLayouts = &set_layout_,
                                                 .pushConstantRangeCount = 1,
                                                 .pPushConstantRanges = &push};
    vk_check(vk.CreatePipelineLayout(screen_.device(), &layout_info, nullptr, &layout_),
             "vkCreatePipelineLayout");
}

void UiPainter::create_pipeline()
{
    const std::array stages{
        VkPipelineShaderStageCreateInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                        .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                        .module = make_module(screen_, shaders::ui_vert),
                                        .pName = "main"},
        VkPipelineShaderStageCreateInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                        .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
                                        .module = make_module(screen_, shaders::ui_frag),
                                        .pName = "main"}};
    const VkVertexInputBindingDescription binding{.stride = sizeof(ImDrawVert)};
    const std::array attributes{
        VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
        VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
        VkVertexInputAttributeDescription{2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}};
    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 1,
        .pVertexBindingDescriptions = &binding,
        .vertexAttributeDescriptionCount = static_cast<uint32_t>(attributes.size()),
        .pVertexAttributeDescriptions = attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo rasterization{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0F};
    const VkPipelineMultisampleStateCreateInfo one_sample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineColorBlendAttachmentState over{.blendEnable = VK_TRUE,
                                                   .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
                                                   .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                                   .colorBlendOp = VK_BLEND_OP_ADD,
                                                   .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                   .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                                   .alphaBlendOp = VK_BLEND_OP_ADD,
                                                   .colorWriteMask = 0xf};
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &over};
    const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = static_cast<uint32_t>(dynamic_states.size()),
        .pDynamicStates = dynamic_states.data()};
    const VkFormat format = screen_.format();
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = 1,
                                                  .pColorAttachmentFormats = &format};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = static_cast<uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &rasterization,
                                            .pMultisampleState = &one_sample,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout_};
    const VkResult result =
        screen_.vk().CreateGraphicsPipelines(screen_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    for (const VkPipelineShaderStageCreateInfo& stage : stages) {
        screen_.vk().DestroyShaderModule(screen_.device(), stage.module, nullptr);
    }
    vk_check(result, "vkCreateGraphicsPipelines");
}

std::unique_ptr<Texture> UiPainter::make_texture()
{
    return std::make_unique<Texture>(screen_, pool_, set_layout_, sampler_);
}

void UiPainter::update_fonts()
{
    if (!fonts_) {
        fonts_ = make_texture();
    }
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
    fonts_->set(static_cast<uint32_t>(width), static_cast<uint32_t>(height),
                {pixels, size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height)});
    atlas.SetTexID(id_of(*fonts_));
}

void UiPainter::record_upload(VkCommandBuffer commands)
{
    fonts_->record_upload(commands);
}

void UiPainter::destroy(Mapped& mapped)
{
    screen_.vk().DestroyBuffer(screen_.device(), mapped.buffer, nullptr);
    screen_.vk().FreeMemory(screen_.device(), mapped.memory.memory, nullptr);
    mapped = {};
}

void UiPainter::ensure(Mapped& mapped, VkDeviceSize size_bytes, VkBufferUsageFlags usage)
{
    if (mapped.size_bytes >= size_bytes) {
        return;
    }
    destroy(mapped);
    mapped.size_bytes = size_bytes + size_bytes / 2;
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = mapped.size_bytes, .usage = usage};
    vk_check(screen_.vk().CreateBuffer(screen_.device(), &info, nullptr, &mapped.buffer), "vkCreateBuffer");
    mapped.memory = screen_.allocate(mapped.buffer);
}

void UiPainter::copy_geometry(const ImDrawData& data)
{
    ensure(vertices_, sizeof(ImDrawVert) * static_cast<VkDeviceSize>(data.TotalVtxCount),
           VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    ensure(indices_, sizeof(ImDrawIdx) * static_cast<VkDeviceSize>(data.TotalIdxCount),
           VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    auto* vertices = static_cast<ImDrawVert*>(vertices_.memory.mapped);
    auto* indices = static_cast<ImDrawIdx*>(indices_.memory.mapped);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        vertices = std::copy(list.VtxBuffer.begin(), list.VtxBuffer.end(), vertices);
        indices = std::copy(list.IdxBuffer.begin(), list.IdxBuffer.end(), indices);
    }
}

void UiPainter::paint(const ImDrawData& data, VkCommandBuffer commands)
{
    if (data.TotalVtxCount == 0) {
        return;
    }
    copy_geometry(data);
    const DeviceFunctions& vk = screen_.vk();
    const glm::vec2 page_px(data.DisplaySize.x * data.FramebufferScale.x,
                            data.DisplaySize.y * data.FramebufferScale.y);
    const VkDeviceSize offset = 0;
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    vk.CmdBindVertexBuffers(commands, 0, 1, &vertices_.buffer, &offset);
    vk.CmdBindIndexBuffer(commands, indices_.buffer, 0,
                          sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    const VkViewport viewport{.width = page_px.x, .height = page_px.y, .maxDepth = 1.0F};
    vk.CmdSetViewport(commands, 0, 1, &viewport);
    const PushConstants push{{2.0F / data.DisplaySize.x, 2.0F / data.DisplaySize.y},
                             {data.DisplayPos.x, data.DisplayPos.y}};
    vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
    uint32_t first_index = 0;
    int32_t first_vertex = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const glm::vec2 scale(data.FramebufferScale.x, data.FramebufferScale.y);
            const glm::vec2 origin(data.DisplayPos.x, data.DisplayPos.y);
            const glm::vec2 least =
                glm::clamp((glm::vec2(command.ClipRect.x, command.ClipRect.y) - origin) * scale,
                           glm::vec2(0.0F), page_px);
            const glm::vec2 most = glm::clamp(
                (glm::vec2(command.ClipRect.z, command.ClipRect.w) - origin) * scale, least, page_px);
            const VkRect2D scissor{
                {static_cast<int32_t>(least.x), static_cast<int32_t>(least.y)},
                {static_cast<uint32_t>(most.x - least.x), static_cast<uint32_t>(most.y - least.y)}};
            vk.CmdSetScissor(commands, 0, 1, &scissor);
            VkDescriptorSet set = descriptor_of(command.GetTexID());
            vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                                     nullptr);
            vk.CmdDrawIndexed(commands, command.ElemCount, 1, first_index + command.IdxOffset,
                              first_vertex + static_cast<int32_t>(command.VtxOffset), 0);
        }
        first_index += static_cast<uint32_t>(list.IdxBuffer.Size);
        first_vertex += list.VtxBuffer.Size;
    }
}

} // namespace estampe::viewer
