// SPDX-License-Identifier: MIT
#pragma once

// Compiles Vulkan pipelines at first use and caches them on disk between runs of the program.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/vulkan.hpp"

namespace estampe::gpu {

/// Sets whether devices that are opened later cache pipelines on disk. The default is true. Thread-safe.
void keep_pipelines(bool are_kept);

/// Identifies the device and driver that compiled the cached pipelines. A cache file belongs to one
/// combination of device, driver and program version.
struct PipelineOwner {
    uint32_t vendor = 0;
    uint32_t device = 0;
    uint32_t driver_version = 0;
    uint8_t uuid[VK_UUID_SIZE]{}; ///< Identity of the driver's compiler
};

[[nodiscard]] PipelineOwner owner_of(VkPhysicalDevice physical);

/// Path of the pipeline cache file, in the folder `estampe` of $XDG_CACHE_HOME or ~/.cache. Empty if neither
/// is an absolute path.
[[nodiscard]] std::filesystem::path pipeline_file(const PipelineOwner& owner);

/// The content of a cache file.
struct StoredPipelines {
    std::vector<std::byte> bytes;
    std::string
        note; ///< Why a file that exists was ignored, as one line; empty if there is none or it was read
};

/// Reads the pipeline data of a cache file. Drivers trust these data, so the file is only read from a folder
/// into which no other user can write. The result is empty if the file does not exist, is truncated or
/// changed, or belongs to another device or driver. Such a file is deleted, so that it is written again.
[[nodiscard]] StoredPipelines read_pipelines(const std::filesystem::path& file, const PipelineOwner& owner);

/// Writes pipeline data to a cache file, and creates its folder, for the user alone. The file is replaced
/// atomically. If writing fails, or if other users can write into the folder, the old file stays and no error
/// is reported, because the file is only a cache.
void write_pipelines(const std::filesystem::path& file, std::span<const std::byte> pipelines);

/// The VkPipelineCache of a device. The constructor reads the cache from disk; the destructor writes the
/// cache if it has grown. No file is written for drivers whose cache stays empty, such as lavapipe.
class PipelineStore {
public:
    explicit PipelineStore(Device& device);
    ~PipelineStore();
    PipelineStore(const PipelineStore&) = delete;
    PipelineStore& operator=(const PipelineStore&) = delete;

    [[nodiscard]] VkPipelineCache handle() const { return cache_; }

    /// Why the cache on disk was ignored, as one line; empty if it was not.
    [[nodiscard]] const std::string& note() const { return note_; }

private:
    void write_back() const;

    VkDevice device_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    std::filesystem::path file_; ///< Path of the cache file; empty: pipelines are not cached on disk
    size_t size_read_ = 0;
    std::string note_;
};

/// Shaders and fixed-function state of a graphics pipeline.
struct DrawState {
    const Shader* vertex = nullptr;
    const Shader* fragment = nullptr; ///< Fragment shader; may be null
    std::span<const VkFormat> color_formats = {};
    /// Format of the depth attachment; VK_FORMAT_UNDEFINED: no depth test.
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    bool cull_back_faces = false;
};

/// A Vulkan pipeline with the layouts that match the declaration of its pass.
struct Pipeline {
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Creates pipelines at first use and caches them in memory and on disk (see PipelineStore). Cost of a
/// pipeline's first use: 1 to 100 ms of driver compilation, or less if an earlier run has compiled the
/// pipeline.
class PipelineCache {
public:
    explicit PipelineCache(Device& device);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    /// Why the cache on disk was ignored, as one line; empty if it was not.
    [[nodiscard]] const std::string& note() const { return store_.note(); }

    /// Returns the compute pipeline of `shader`. Bindings 0, 1, ... have the descriptor types `bindings`. The
    /// pipeline has `push_bytes` bytes of push constants, and its specialization constant 0 is `variant`.
    [[nodiscard]] const Pipeline& get(const Shader& shader, std::span<const VkDescriptorType> bindings,
                                      uint32_t push_bytes, uint32_t variant);

    /// Returns the graphics pipeline of `state`. The other parameters are as for the compute pipeline.
    [[nodiscard]] const Pipeline& get(const DrawState& state, std::span<const VkDescriptorType> bindings,
                                      uint32_t push_bytes, uint32_t variant);

    [[nodiscard]] VkSampler sampler(Sampling sampling) const
    {
        return samplers_[static_cast<size_t>(sampling)];
    }

private:
    /// Lookup key of a pipeline. The key refers to the caller's data, so that a lookup does not allocate.
    struct Wanted {
        const uint32_t* words = nullptr; ///< SPIR-V of the compute or vertex shader
        const uint32_t* fragment = nullptr;
        VkFormat depth_format = VK_FORMAT_UNDEFINED;
        bool cull_back_faces = false;
        uint32_t variant = 0;
        std::span<const VkFormat> color_formats = {};
        std::span<const VkDescriptorType> bindings = {};
    };

    struct Key {
        Wanted wanted; ///< The spans of `wanted` refer to the vectors below
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

    /// Adds a pipeline that `make_pipeline` fills in. If that fails, destroys what exists of the pipeline.
    template <typename Make>
    const Pipeline& add(const Wanted& wanted, const Make& make_pipeline);

    void make(Pipeline& made, const Shader& shader, std::span<const VkDescriptorType> bindings,
              uint32_t push_bytes, uint32_t variant);
    void make(Pipeline& made, const DrawState& state, std::span<const VkDescriptorType> bindings,
              uint32_t push_bytes, uint32_t variant);
    void make_layouts(Pipeline& made, std::span<const VkDescriptorType> bindings, uint32_t push_bytes,
                      VkShaderStageFlags stages) const;
    void destroy(const Pipeline& pipeline) const noexcept;
    void destroy_all() const noexcept;

    Device& device_;
    PipelineStore store_;
    std::map<Key, Pipeline, Less> pipelines_;
    VkSampler samplers_[3]{};
};

} // namespace estampe::gpu
