// SPDX-License-Identifier: MIT
#pragma once

// What every feature offers the renderer besides its own functions: to forget, and to outlive a run in the
// memory of a film's frame, which is bytes: sections with a name and a version, one per feature.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"

namespace estampe::features {

/// Throws Error: the bytes are no memory of a film's frame, or are damaged.
[[noreturn]] void fail_damaged();

/// What one section is written to.
class FilmWriter {
public:
    FilmWriter(gpu::Device& device, gpu::Executor& executor) : device_(device), executor_(executor) {}

    [[nodiscard]] gpu::Device& device() { return device_; }

    [[nodiscard]] gpu::Executor& executor() { return executor_; }

    /// A value without padding: its bytes are the same for equal values.
    template <typename T>
    void value(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        append(std::as_bytes(std::span(&value, 1)));
    }

    void flag(bool is_set) { value(uint8_t{is_set}); }

    /// The items alone; their number is for the caller to write.
    void floats(std::span<const float> numbers) { append(std::as_bytes(numbers)); }

    /// The contents of `buffers`, one after the other. Cost: a graph that copies them to the host.
    void buffers(std::span<gpu::Buffer* const> buffers);

    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    gpu::Device& device_;
    gpu::Executor& executor_;
    std::vector<std::byte> bytes_;
};

/// What one section is read from, in the order it was written. All functions throw Error past its end.
class FilmReader {
public:
    FilmReader(gpu::Device& device, std::span<const std::byte> bytes) : device_(device), left_(bytes) {}

    [[nodiscard]] gpu::Device& device() { return device_; }

    template <typename T>
    [[nodiscard]] T value()
    {
        static_assert(std::is_trivially_copyable_v<T>);
        T value;
        std::memcpy(static_cast<void*>(&value), take(sizeof value).data(), sizeof value);
        return value;
    }

    [[nodiscard]] bool flag() { return value<uint8_t>() != 0; }

    [[nodiscard]] std::vector<float> floats(uint64_t count);

    /// A new buffer on the device with the next `size_bytes`.
    [[nodiscard]] gpu::Buffer buffer(const char* name, uint64_t size_bytes);

    [[nodiscard]] bool is_at_end() const { return left_.empty(); }

    [[nodiscard]] std::span<const std::byte> take(uint64_t size_bytes);

private:
    gpu::Device& device_;
    std::span<const std::byte> left_;
};

/// What happened that may outdate what a feature keeps between pictures.
enum class Event : uint8_t {
    scene_replaced,    ///< set_scene(): what is drawn from now on is something else
    layout_replaced,   ///< the scene's draws, vertices and triangles are numbered afresh
    triangles_changed, ///< some triangles are flagged otherwise, or torn
    ground_replaced,   ///< the terrain is cut into other triangles, after layout_replaced
    lights_changed,    ///< shadows may fall otherwise
    pose_changed,      ///< vertices are about to be posed otherwise than in the frame before
    anchor_moved,      ///< positions on the device are relative to another origin
    film_recalled,     ///< the next frame goes on from a film's memory, which holds nothing of this feature
};

/// The feature's part of a film's memory.
struct FilmSection {
    std::string_view name;
    uint32_t version = 1; ///< of the bytes that save() writes; load() is never given another version
};

/// A part of the renderer that keeps buffers or state from picture to picture. A feature plans on the
/// processor, records its passes into a frame graph, forgets what an event outdates, and saves what a film's
/// next frame goes on from.
class Feature {
public:
    Feature() = default;
    Feature(const Feature&) = delete;
    Feature& operator=(const Feature&) = delete;
    Feature(Feature&&) = delete;
    Feature& operator=(Feature&&) = delete;
    virtual ~Feature() = default;

    /// Forgets what `event` outdates. Cost: nothing worth naming; buffers stay.
    virtual void invalidate(Event event) = 0;

    /// None where nothing of the feature goes on from frame to frame.
    [[nodiscard]] virtual std::optional<FilmSection> film_section() const { return std::nullopt; }

    /// Writes what load() makes the next frame go on from; nothing where the last frame left nothing.
    virtual void save(FilmWriter& /*writer*/) {}

    /// Makes the next frame go on from what save() wrote. Throws Error when that is damaged, or of another
    /// scene; the feature may then have forgotten what it had.
    virtual void load(FilmReader& /*reader*/) {}
};

} // namespace estampe::features
