// SPDX-License-Identifier: MIT
#pragma once

// Pipelines, made at first use and kept on disk from one run to the next.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/vulkan.hpp"

namespace estampe::gpu {

/// Whether devices opened from now on keep pipelines on disk, and use those that are there: they do, until
/// this says otherwise. Any thread may call it.
void keep_pipelines(bool are_kept);

/// What pipelines are kept for: another device, driver or version of the program has a file of its own.
struct PipelineOwner {
    uint32_t vendor = 0;
    uint32_t device = 0;
    uint32_t driver_version = 0;
    uint8_t uuid[VK_UUID_SIZE]{}; ///< of the driver's compiler
};

[[nodiscard]] PipelineOwner owner_of(VkPhysicalDevice physical);

/// Where they are kept: in `estampe` under $XDG_CACHE_HOME, or ~/.cache. Empty where neither is a place.
[[nodiscard]] std::filesystem::path pipeline_file(const PipelineOwner& owner);

/// What the file holds; empty when there is none, or it is cut off, changed, or of another owner.
[[nodiscard]] std::vector<std::byte> read_pipelines(const std::filesystem::path& file,
                                                    const PipelineOwner& owner);

/// Makes the folder and writes the file whole, or leaves the one before: no error, it is a cache.
void write_pipelines(const std::filesystem::path& file, std::span<const std::byte> pipelines);

/// Vulkan's cache of a device's pipelines, read from disk when it is made and written back at its end where
/// it has grown. Drivers that keep nothing in it, as lavapipe's, have no file.
class PipelineStore {
public:
    explicit PipelineStore(Device& device);
    ~PipelineStore();
    PipelineStore(const PipelineStore&) = delete;
    PipelineStore& operator=(const PipelineStore&) = delete;

    [[nodiscard]] VkPipelineCache handle() const { return cache_; }

private:
    void write_back() const;

    VkDevice device_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    std::filesystem::path file_; ///< empty: not kept
    size_t size_read_ = 0;
};

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
