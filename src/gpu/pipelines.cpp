// SPDX-License-Identifier: MIT
#include "gpu/pipelines.hpp"

namespace estampe::gpu {
namespace {

VkSampler make_sampler(VkDevice device, Sampling sampling)
{
    const bool linear = sampling != Sampling::nearest;
    const VkFilter filter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    const VkSamplerAddressMode address = sampling == Sampling::linear_repeat
                                             ? VK_SAMPLER_ADDRESS_MODE_REPEAT
                                             : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const VkSamplerCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = address,
        .addressModeV = address,
        .addressModeW = address,
        .maxLod = VK_LOD_CLAMP_NONE,
    };
    VkSampler sampler = VK_NULL_HANDLE;
    vk_check(vkCreateSampler(device, &info, nullptr, &sampler), "vkCreateSampler");
    return sampler;
}

} // namespace

PipelineCache::PipelineCache(Device& device) : device_(device)
{
    for (const Sampling sampling : {Sampling::nearest, Sampling::linear, Sampling::linear_repeat}) {
        samplers_[static_cast<size_t>(sampling)] = make_sampler(device.handle(), sampling);
    }
}

PipelineCache::~PipelineCache()
{
    for (const auto& [key, pipeline] : pipelines_) {
        vkDestroyPipeline(device_.handle(), pipeline.pipeline, nullptr);
        vkDestroyPipelineLayout(device_.handle(), pipeline.layout, nullptr);
        vkDestroyDescriptorSetLayout(device_.handle(), pipeline.set_layout, nullptr);
    }
    for (VkSampler sampler : samplers_) {
        vkDestroySampler(device_.handle(), sampler, nullptr);
    }
}

const Pipeline& PipelineCache::get(const Shader& shader, std::span<const VkDescriptorType> bindings,
                                   uint32_t push_bytes, uint32_t variant)
{
    const Key key{shader.spirv.data(), variant, {bindings.begin(), bindings.end()}};
    const auto found = pipelines_.find(key);
    if (found != pipelines_.end()) {
        return found->second;
    }
    return pipelines_.emplace(key, make(shader, bindings, push_bytes, variant)).first->second;
}

Pipeline PipelineCache::make(const Shader& shader, std::span<const VkDescriptorType> bindings,
                             uint32_t push_bytes, uint32_t variant)
{
    Pipeline made;
    std::vector<VkDescriptorSetLayoutBinding> layout_bindings;
    for (const VkDescriptorType type : bindings) {
        layout_bindings.push_back({.binding = static_cast<uint32_t>(layout_bindings.size()),
                                   .descriptorType = type,
                                   .descriptorCount = 1,
                                   .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
    }
    const VkDescriptorSetLayoutCreateInfo set_info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = static_cast<uint32_t>(layout_bindings.size()),
        .pBindings = layout_bindings.data()};
    vk_check(vkCreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &made.set_layout),
             "vkCreateDescriptorSetLayout");
    const VkPushConstantRange push_range{.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = push_bytes};
    const VkPipelineLayoutCreateInfo layout_info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                 .setLayoutCount = 1,
                                                 .pSetLayouts = &made.set_layout,
                                                 .pushConstantRangeCount = push_bytes > 0 ? 1U : 0U,
                                                 .pPushConstantRanges = &push_range};
    vk_check(vkCreatePipelineLayout(device_.handle(), &layout_info, nullptr, &made.layout),
             "vkCreatePipelineLayout");

    const VkShaderModuleCreateInfo module_info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                               .codeSize = shader.spirv.size_bytes(),
                                               .pCode = shader.spirv.data()};
    VkShaderModule shader_module = VK_NULL_HANDLE;
    vk_check(vkCreateShaderModule(device_.handle(), &module_info, nullptr, &shader_module),
             "vkCreateShaderModule");
    const VkSpecializationMapEntry entry{.size = sizeof(variant)};
    const VkSpecializationInfo specialization{
        .mapEntryCount = 1, .pMapEntries = &entry, .dataSize = sizeof(variant), .pData = &variant};
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = shader_module,
                  .pName = "main",
                  .pSpecializationInfo = &specialization},
        .layout = made.layout};
    const VkResult result =
        vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &made.pipeline);
    vkDestroyShaderModule(device_.handle(), shader_module, nullptr);
    vk_check(result, "vkCreateComputePipelines");
    device_.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(made.pipeline), shader.name);
    return made;
}

} // namespace estampe::gpu
