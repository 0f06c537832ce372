// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/pipeline_store.hpp"

namespace estampe::gpu {

/// What a graphics pipeline draws, into what.
struct DrawState {
    const Shader* vertex = nullptr;
    const Shader* fragment = nullptr; ///< may be null
    std::span<const VkFormat> color_formats = {};
    VkFormat depth_format = VK_FORMAT_UNDEFINED; ///< undefined for no depth test
    bool cull_back_faces = false;
};

/// A pipeline with the layouts that a pass's declaration implies.
struct Pipeline {
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Makes pipelines on first use and keeps them, on disk too (see PipelineStore). Cost of a first use: 1 to
/// 100 ms of driver compilation, less where it was made in a run before.
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
    /// All that a pipeline hangs on, and how it is kept; looking it up asks nothing of the heap.
    struct Wanted {
        const uint32_t* words = nullptr; ///< of the compute or the vertex shader
        const uint32_t* fragment = nullptr;
        VkFormat depth_format = VK_FORMAT_UNDEFINED;
        bool cull_back_faces = false;
        uint32_t variant = 0;
        std::span<const VkFormat> color_formats = {};
        std::span<const VkDescriptorType> bindings = {};
    };

    struct Key {
        Wanted wanted; ///< whose lists are these:
        std::vector<VkFormat> color_formats;
        std::vector<VkDescriptorType> bindings;
    };

    struct Less {
        using is_transparent = void;

        [[nodiscard]] bool operator()(const Key& a, const Key& b) const { return (*this)(of(a), of(b)); }

        [[nodiscard]] bool operator()(const Wanted& a, const Key& b) const { return (*this)(a, of(b)); }

        [[nodiscard]] bool operator()(const Key& a, const Wanted& b) const { return (*this)(of(a), b); }

        [[nodiscard]] bool operator()(const Wanted& a, const Wanted& b) const;
        [[nodiscard]] static Wanted of(const Key& key);
    };

    [[nodiscard]] static Key key_of(const Wanted& wanted);

    [[nodiscard]] Pipeline make(const Shader& shader, std::span<const VkDescriptorType> bindings,
                                uint32_t push_bytes, uint32_t variant);
    [[nodiscard]] Pipeline make(const DrawState& state, std::span<const VkDescriptorType> bindings,
                                uint32_t push_bytes, uint32_t variant);
    [[nodiscard]] Pipeline make_layouts(std::span<const VkDescriptorType> bindings, uint32_t push_bytes,
                                        VkShaderStageFlags stages) const;
    void destroy(const Pipeline& pipeline) const;

    Device& device_;
    PipelineStore store_;
    std::map<Key, Pipeline, Less> pipelines_;
    VkSampler samplers_[3]{};
};

} // namespace estampe::gpu
