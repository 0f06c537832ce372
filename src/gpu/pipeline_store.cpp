// SPDX-License-Identifier: MIT
#include "gpu/pipeline_store.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>

#include <fmt/format.h>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "gpu/device.hpp"

namespace estampe::gpu {
namespace {

std::atomic<bool>& are_kept_on_disk()
{
    static std::atomic<bool> kept = true;
    return kept;
}

constexpr uint64_t most_bytes = 256ULL << 20U;

/// What stands before the driver's own bytes.
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

/// Whether the driver's bytes are for this owner: drivers should look, and some did not.
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

std::vector<std::byte> read_pipelines(const std::filesystem::path& file, const PipelineOwner& owner)
{
    try {
        std::vector<std::byte> bytes = read_file(file, most_bytes);
        FileHead head;
        if (bytes.size() < sizeof head) {
            return {};
        }
        std::memcpy(&head, bytes.data(), sizeof head);
        bytes.erase(bytes.begin(), bytes.begin() + sizeof head);
        const FileHead wanted = head_of(bytes);
        const bool is_whole =
            head.magic == wanted.magic && head.size_bytes == wanted.size_bytes && head.hash == wanted.hash;
        return is_whole && is_for(bytes, owner) ? bytes : std::vector<std::byte>();
    } catch (const std::exception&) {
        return {}; // there is none yet, most likely
    }
}

void write_pipelines(const std::filesystem::path& file, std::span<const std::byte> pipelines)
{
    try {
        std::filesystem::create_directories(file.parent_path());
        const FileHead head = head_of(pipelines);
        const auto head_bytes = std::as_bytes(std::span(&head, 1));
        std::vector<std::byte> bytes(head_bytes.begin(), head_bytes.end());
        bytes.insert(bytes.end(), pipelines.begin(), pipelines.end());
        write_file_atomically(file, bytes);
    } catch (const std::exception&) {
        return; // the next run compiles again
    }
}

PipelineStore::PipelineStore(Device& device) : device_(device.handle())
{
    const PipelineOwner owner = owner_of(device.physical());
    std::vector<std::byte> pipelines;
    if (are_kept_on_disk()) {
        file_ = pipeline_file(owner);
        pipelines = file_.empty() ? std::vector<std::byte>() : read_pipelines(file_, owner);
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
        write_back();
    }
    vkDestroyPipelineCache(device_, cache_, nullptr);
}

void PipelineStore::write_back() const
{
    size_t size = 0;
    const bool is_known = vkGetPipelineCacheData(device_, cache_, &size, nullptr) == VK_SUCCESS;
    // Of one with nothing in it there is the head alone.
    if (!is_known || size <= std::max(size_read_, sizeof(VkPipelineCacheHeaderVersionOne)) ||
        size > most_bytes) {
        return;
    }
    std::vector<std::byte> pipelines(size);
    if (vkGetPipelineCacheData(device_, cache_, &size, pipelines.data()) == VK_SUCCESS) {
        write_pipelines(file_, std::span(pipelines).first(size));
    }
}

} // namespace estampe::gpu
