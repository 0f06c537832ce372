// SPDX-License-Identifier: MIT
#include "gpu/pipelines.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "gpu/device.hpp"
#include "gpu/shader_bindings.hpp"

namespace estampe::gpu {
namespace {

std::atomic<bool>& are_kept_on_disk()
{
    static std::atomic<bool> kept = true;
    return kept;
}

constexpr uint64_t most_bytes = 256ULL << 20U;

/// Header of the pipeline cache file; the driver's cache data follows.
struct FileHead {
    std::array<char, 8> magic{};
    uint64_t size_bytes = 0;
    uint64_t hash = 0;
};

constexpr std::array<char, 8> magic_of_pipelines{'E', 'S', 'T', 'P', 'I', 'P', 'E', '1'};

FileHead head_of(std::span<const std::byte> pipelines)
{
    Hash hash;
    hash.add_text({reinterpret_cast<const char*>(pipelines.data()), pipelines.size()});
    return {.magic = magic_of_pipelines, .size_bytes = pipelines.size(), .hash = hash.value()};
}

/// Whether the driver's cache data belong to this device and driver. Drivers should check this themselves,
/// but some do not.
bool is_for(std::span<const std::byte> pipelines, const PipelineOwner& owner)
{
    VkPipelineCacheHeaderVersionOne head{};
    if (pipelines.size() < sizeof head) {
        return false;
    }
    std::memcpy(&head, pipelines.data(), sizeof head);
    return head.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && head.vendorID == owner.vendor &&
           head.deviceID == owner.device && std::ranges::equal(head.pipelineCacheUUID, owner.uuid);
}

} // namespace

void keep_pipelines(bool are_kept)
{
    are_kept_on_disk() = are_kept;
}

PipelineOwner owner_of(VkPhysicalDevice physical)
{
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    PipelineOwner owner{.vendor = properties.vendorID,
                        .device = properties.deviceID,
                        .driver_version = properties.driverVersion};
    std::ranges::copy(properties.pipelineCacheUUID, owner.uuid);
    return owner;
}

std::filesystem::path pipeline_file(const PipelineOwner& owner)
{
    const std::filesystem::path folder = user_cache_folder();
    if (folder.empty()) {
        return {};
    }
    Hash hash;
    hash.add_text(ESTAMPE_VERSION);
    hash.add(owner);
    return folder / "estampe" / fmt::format("pipelines-{:016x}", hash.value());
}

namespace {

/// Returns the driver's cache data of a file; nothing if the file is truncated or changed.
std::optional<std::vector<std::byte>> content_of(std::vector<std::byte> file)
{
    FileHead head;
    if (file.size() < sizeof head) {
        return std::nullopt;
    }
    std::memcpy(&head, file.data(), sizeof head);
    file.erase(file.begin(), file.begin() + sizeof head);
    const FileHead wanted = head_of(file);
    const bool is_whole =
        head.magic == wanted.magic && head.size_bytes == wanted.size_bytes && head.hash == wanted.hash;
    return is_whole ? std::optional(std::move(file)) : std::nullopt;
}

} // namespace

StoredPipelines read_pipelines(const std::filesystem::path& file, const PipelineOwner& owner)
{
    std::error_code missing;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, missing))) {
        return {};
    }
    if (const std::string fault = fault_of_private_folder(file.parent_path()); !fault.empty()) {
        return {.bytes = {},
                .note =
                    fmt::format("{} {}, so the compiled shaders in it are not used; make it a folder into "
                                "which only its user writes",
                                file.parent_path().string(), fault)};
    }
    // A file that is fine must not be deleted because this process lacks memory or file descriptors.
    std::string fault = "is no regular file";
    if (std::filesystem::is_regular_file(std::filesystem::symlink_status(file, missing))) {
        try {
            std::optional<std::vector<std::byte>> bytes =
                content_of(read_file(file, most_bytes, ReadScope::beside(file)));
            if (bytes && is_for(*bytes, owner)) {
                return {.bytes = *std::move(bytes), .note = {}};
            }
            fault = bytes ? "is of another device or driver" : "is truncated or changed";
        } catch (const std::exception&) {
            if (std::filesystem::file_size(file, missing) <= most_bytes) {
                return {};
            }
            fault = "is too long";
        }
    }
    std::error_code failed;
    std::filesystem::remove(file, failed);
    return {.bytes = {},
            .note = fmt::format("the file of compiled shaders {} {}; it is ignored and written again",
                                file.string(), fault)};
}

void write_pipelines(const std::filesystem::path& file, std::span<const std::byte> pipelines)
{
    try {
        make_private_folder(file.parent_path());
        if (!fault_of_private_folder(file.parent_path()).empty()) {
            return;
        }
        const FileHead head = head_of(pipelines);
        const auto head_bytes = std::as_bytes(std::span(&head, 1));
        std::vector<std::byte> bytes(head_bytes.begin(), head_bytes.end());
        bytes.insert(bytes.end(), pipelines.begin(), pipelines.end());
        write_file_atomically(file, bytes);
    } catch (const std::exception&) {
        return; // Without a cache file, the next run compiles the pipelines again
    }
}

PipelineStore::PipelineStore(Device& device) : device_(device.handle())
{
    const PipelineOwner owner = owner_of(device.physical());
    std::vector<std::byte> pipelines;
    if (are_kept_on_disk()) {
        file_ = pipeline_file(owner);
        StoredPipelines stored = file_.empty() ? StoredPipelines() : read_pipelines(file_, owner);
        pipelines = std::move(stored.bytes);
        note_ = std::move(stored.note);
        size_read_ = pipelines.size();
    }
    const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                         .initialDataSize = pipelines.size(),
                                         .pInitialData = pipelines.data()};
    vk_check(vkCreatePipelineCache(device_, &info, nullptr, &cache_), "vkCreatePipelineCache");
}

PipelineStore::~PipelineStore()
{
    if (!file_.empty()) {
        try {
            write_back();
        } catch (const std::bad_alloc&) {
            file_.clear(); // The next run compiles the pipelines again
        }
    }
    vkDestroyPipelineCache(device_, cache_, nullptr);
}

void PipelineStore::write_back() const
{
    size_t size = 0;
    const bool is_known = vkGetPipelineCacheData(device_, cache_, &size, nullptr) == VK_SUCCESS;
    // An empty pipeline cache consists only of Vulkan's header.
    if (!is_known || size <= std::max(size_read_, sizeof(VkPipelineCacheHeaderVersionOne)) ||
        size > most_bytes) {
        return;
    }
    std::vector<std::byte> pipelines(size);
    if (vkGetPipelineCacheData(device_, cache_, &size, pipelines.data()) == VK_SUCCESS) {
        write_pipelines(file_, std::span(pipelines).first(size));
    }
}

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

/// A shader module, which is only needed until its pipeline exists.
class ShaderModule {
public:
    ShaderModule(VkDevice device, const Shader& shader) : device_(device)
    {
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .codeSize = shader.spirv.size_bytes(),
                                            .pCode = shader.spirv.data()};
        vk_check(vkCreateShaderModule(device, &info, nullptr, &handle_), "vkCreateShaderModule");
    }

    ~ShaderModule() { vkDestroyShaderModule(device_, handle_, nullptr); }

    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;

    [[nodiscard]] VkShaderModule handle() const { return handle_; }

private:
    VkDevice device_;
    VkShaderModule handle_ = VK_NULL_HANDLE;
};

/// Creates a pipeline that draws triangles without vertex buffers and without blending. Depth is reversed;
/// viewport and scissor are dynamic.
VkResult create_draw_pipeline(VkDevice device, VkPipelineCache kept, const DrawState& state,
                              const std::vector<VkPipelineShaderStageCreateInfo>& stages, Pipeline& made)
{
    const VkPipelineVertexInputStateCreateInfo no_input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo rasterization{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = state.cull_back_faces ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0F};
    const VkPipelineMultisampleStateCreateInfo one_sample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkBool32 has_depth = state.depth_format != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE;
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = has_depth,
        .depthWriteEnable = has_depth,
        .depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL};
    const VkPipelineColorBlendAttachmentState replace{
        .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                          VK_COLOR_COMPONENT_A_BIT};
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(state.color_formats.size(), replace);
    const auto color_count = static_cast<uint32_t>(state.color_formats.size());
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = color_count,
        .pAttachments = attachments.data()};
    const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = static_cast<uint32_t>(dynamic_states.size()),
        .pDynamicStates = dynamic_states.data()};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = color_count,
                                                  .pColorAttachmentFormats = state.color_formats.data(),
                                                  .depthAttachmentFormat = state.depth_format};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = static_cast<uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &no_input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &rasterization,
                                            .pMultisampleState = &one_sample,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = made.layout};
    return vkCreateGraphicsPipelines(device, kept, 1, &info, nullptr, &made.pipeline);
}

} // namespace

PipelineCache::PipelineCache(Device& device) : device_(device), store_(device)
{
    try {
        for (const Sampling sampling : {Sampling::nearest, Sampling::linear, Sampling::linear_repeat}) {
            samplers_[static_cast<size_t>(sampling)] = make_sampler(device.handle(), sampling);
        }
    } catch (...) {
        destroy_all();
        throw;
    }
}

PipelineCache::~PipelineCache()
{
    destroy_all();
}

void PipelineCache::destroy_all() const noexcept
{
    for (const auto& [key, pipeline] : pipelines_) {
        destroy(pipeline);
    }
    for (VkSampler sampler : samplers_) {
        vkDestroySampler(device_.handle(), sampler, nullptr);
    }
}

void PipelineCache::destroy(const Pipeline& pipeline) const noexcept
{
    vkDestroyPipeline(device_.handle(), pipeline.pipeline, nullptr);
    vkDestroyPipelineLayout(device_.handle(), pipeline.layout, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), pipeline.set_layout, nullptr);
}

bool PipelineCache::Less::operator()(const Wanted& a, const Wanted& b) const
{
    const auto plain = [](const Wanted& wanted) {
        return std::tuple(wanted.words, wanted.fragment, wanted.depth_format, wanted.cull_back_faces,
                          wanted.variant);
    };
    if (plain(a) != plain(b)) {
        return plain(a) < plain(b);
    }
    if (!std::ranges::equal(a.color_formats, b.color_formats)) {
        return std::ranges::lexicographical_compare(a.color_formats, b.color_formats);
    }
    return std::ranges::lexicographical_compare(a.bindings, b.bindings);
}

PipelineCache::Wanted PipelineCache::Less::of(const Key& key)
{
    Wanted wanted = key.wanted;
    wanted.color_formats = key.color_formats;
    wanted.bindings = key.bindings;
    return wanted;
}

PipelineCache::Key PipelineCache::key_of(const Wanted& wanted)
{
    Key key{.wanted = wanted,
            .color_formats = {wanted.color_formats.begin(), wanted.color_formats.end()},
            .bindings = {wanted.bindings.begin(), wanted.bindings.end()}};
    key.wanted.color_formats = {};
    key.wanted.bindings = {};
    return key;
}

template <typename Make>
const Pipeline& PipelineCache::add(const Wanted& wanted, const Make& make_pipeline)
{
    const auto place = pipelines_.try_emplace(key_of(wanted)).first;
    try {
        make_pipeline(place->second);
    } catch (...) {
        destroy(place->second);
        pipelines_.erase(place);
        throw;
    }
    return place->second;
}

const Pipeline& PipelineCache::get(const Shader& built_in, std::span<const VkDescriptorType> bindings,
                                   uint32_t push_bytes, uint32_t variant)
{
    const Shader shader = current_build(built_in);
    const Wanted wanted{.words = shader.spirv.data(), .variant = variant, .bindings = bindings};
    const auto found = pipelines_.find(wanted);
    if (found != pipelines_.end()) {
        return found->second;
    }
    return add(wanted, [&](Pipeline& made) { make(made, shader, bindings, push_bytes, variant); });
}

const Pipeline& PipelineCache::get(const DrawState& built_in, std::span<const VkDescriptorType> bindings,
                                   uint32_t push_bytes, uint32_t variant)
{
    const Shader vertex = current_build(*built_in.vertex);
    const Shader fragment = built_in.fragment != nullptr ? current_build(*built_in.fragment) : Shader{};
    DrawState state = built_in;
    state.vertex = &vertex;
    state.fragment = built_in.fragment != nullptr ? &fragment : nullptr;
    const Wanted wanted{.words = vertex.spirv.data(),
                        .fragment = fragment.spirv.data(),
                        .depth_format = state.depth_format,
                        .cull_back_faces = state.cull_back_faces,
                        .variant = variant,
                        .color_formats = state.color_formats,
                        .bindings = bindings};
    const auto found = pipelines_.find(wanted);
    if (found != pipelines_.end()) {
        return found->second;
    }
    return add(wanted, [&](Pipeline& made) { make(made, state, bindings, push_bytes, variant); });
}

void PipelineCache::make_layouts(Pipeline& made, std::span<const VkDescriptorType> bindings,
                                 uint32_t push_bytes, VkShaderStageFlags stages) const
{
    std::vector<VkDescriptorSetLayoutBinding> layout_bindings;
    for (const VkDescriptorType type : bindings) {
        layout_bindings.push_back({.binding = static_cast<uint32_t>(layout_bindings.size()),
                                   .descriptorType = type,
                                   .descriptorCount = 1,
                                   .stageFlags = stages});
    }
    const VkDescriptorSetLayoutCreateInfo set_info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = static_cast<uint32_t>(layout_bindings.size()),
        .pBindings = layout_bindings.data()};
    vk_check(vkCreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &made.set_layout),
             "vkCreateDescriptorSetLayout");
    const VkPushConstantRange push_range{.stageFlags = stages, .size = push_bytes};
    const VkPipelineLayoutCreateInfo layout_info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                 .setLayoutCount = 1,
                                                 .pSetLayouts = &made.set_layout,
                                                 .pushConstantRangeCount = push_bytes > 0 ? 1U : 0U,
                                                 .pPushConstantRanges = &push_range};
    vk_check(vkCreatePipelineLayout(device_.handle(), &layout_info, nullptr, &made.layout),
             "vkCreatePipelineLayout");
}

void PipelineCache::make(Pipeline& made, const Shader& shader, std::span<const VkDescriptorType> bindings,
                         uint32_t push_bytes, uint32_t variant)
{
    make_layouts(made, bindings, push_bytes, VK_SHADER_STAGE_COMPUTE_BIT);
    const ShaderModule shader_module(device_.handle(), shader);
    const VkSpecializationMapEntry entry{.size = sizeof(variant)};
    const VkSpecializationInfo specialization{
        .mapEntryCount = 1, .pMapEntries = &entry, .dataSize = sizeof(variant), .pData = &variant};
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = shader_module.handle(),
                  .pName = "main",
                  .pSpecializationInfo = &specialization},
        .layout = made.layout};
    vk_check(vkCreateComputePipelines(device_.handle(), store_.handle(), 1, &info, nullptr, &made.pipeline),
             "vkCreateComputePipelines");
    device_.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(made.pipeline), shader.name);
}

void PipelineCache::make(Pipeline& made, const DrawState& state, std::span<const VkDescriptorType> bindings,
                         uint32_t push_bytes, uint32_t variant)
{
    make_layouts(made, bindings, push_bytes, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    const VkSpecializationMapEntry entry{.size = sizeof(variant)};
    const VkSpecializationInfo specialization{
        .mapEntryCount = 1, .pMapEntries = &entry, .dataSize = sizeof(variant), .pData = &variant};
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const auto add_stage = [&](const ShaderModule& shader, VkShaderStageFlagBits stage) {
        stages.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                          .stage = stage,
                          .module = shader.handle(),
                          .pName = "main",
                          .pSpecializationInfo = &specialization});
    };
    const ShaderModule vertex(device_.handle(), *state.vertex);
    add_stage(vertex, VK_SHADER_STAGE_VERTEX_BIT);
    std::optional<ShaderModule> fragment;
    if (state.fragment != nullptr) {
        fragment.emplace(device_.handle(), *state.fragment);
        add_stage(*fragment, VK_SHADER_STAGE_FRAGMENT_BIT);
    }
    vk_check(create_draw_pipeline(device_.handle(), store_.handle(), state, stages, made),
             "vkCreateGraphicsPipelines");
    device_.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(made.pipeline), state.vertex->name);
}

} // namespace estampe::gpu
