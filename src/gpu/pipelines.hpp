// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// What a graphics pipeline draws, into what.
struct DrawState {
    const Shader* vertex = nullptr;
    const Shader* fragment = nullptr; ///< may be null
    std::vector<VkFormat> color_formats;
    VkFormat depth_format = VK_FORMAT_UNDEFINED; ///< undefined for no depth test
    bool cull_back_faces = false;
};

/// A pipeline with the layouts that a pass's declaration implies.
struct Pipeline {
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Makes pipelines on first use and keeps them. Cost of a first use: 1 to 100 ms of driver compilation.
class PipelineCache {
public:
    explicit PipelineCache(Device& device);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    /// The pipeline of `shader` whose bindings 0, 1, ... have these types, with `push_bytes` of push
    /// constants and specialization constant 0 set to `variant`.
    [[nodiscard]] const Pipeline& get(const Shader& shader, std::span<const VkDescriptorType> bindings,
                                      uint32_t push_bytes, uint32_t variant);

    /// The graphics pipeline of `state`, with the same meaning of the rest.
    [[nodiscard]] const Pipeline& get(const DrawState& state, std::span<const VkDescriptorType> bindings,
                                      uint32_t push_bytes, uint32_t variant);

    [[nodiscard]] VkSampler sampler(Sampling sampling) const
    {
        return samplers_[static_cast<size_t>(sampling)];
    }

private:
    using Key = std::tuple<const uint32_t*, uint32_t, std::vector<VkDescriptorType>>;
    using DrawKey = std::tuple<const uint32_t*, const uint32_t*, std::vector<VkFormat>, VkFormat, bool,
                               uint32_t, std::vector<VkDescriptorType>>;

    [[nodiscard]] Pipeline make(const Shader& shader, std::span<const VkDescriptorType> bindings,
                                uint32_t push_bytes, uint32_t variant);
    [[nodiscard]] Pipeline make(const DrawState& state, std::span<const VkDescriptorType> bindings,
                                uint32_t push_bytes, uint32_t variant);
    [[nodiscard]] Pipeline make_layouts(std::span<const VkDescriptorType> bindings, uint32_t push_bytes,
                                        VkShaderStageFlags stages) const;
    void destroy(const Pipeline& pipeline) const;

    Device& device_;
    std::map<Key, Pipeline> pipelines_;
    std::map<DrawKey, Pipeline> draw_pipelines_;
    VkSampler samplers_[3]{};
};

} // namespace estampe::gpu
