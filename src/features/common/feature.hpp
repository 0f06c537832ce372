// SPDX-License-Identifier: MIT
#pragma once

// The interface of all features of the renderer. A feature forgets data that an event makes obsolete. Between
// two frames of a film, a feature can save its state as a section of bytes with a name and a version.

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

/// Throws an Error which says that the bytes are damaged or are not the saved state of a film.
[[noreturn]] void fail_damaged();

/// Collects the bytes of one section of a film's saved state.
class FilmWriter {
public:
    FilmWriter(gpu::Device& device, gpu::Executor& executor) : device_(device), executor_(executor) {}

    [[nodiscard]] gpu::Device& device() { return device_; }

    [[nodiscard]] gpu::Executor& executor() { return executor_; }

    /// Appends a value to the section. The type must have no padding, so that equal values give equal bytes.
    template <typename T>
    void value(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        append(std::as_bytes(std::span(&value, 1)));
    }

    void flag(bool is_set) { value(uint8_t{is_set}); }

    /// Appends numbers to the section. The count of numbers is not stored; if the count is needed, the caller
    /// must write it first.
    void floats(std::span<const float> numbers) { append(std::as_bytes(numbers)); }

    /// Appends the contents of all `buffers` in order. Cost: a graph that copies them to the host.
    void buffers(std::span<gpu::Buffer* const> buffers);

    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    gpu::Device& device_;
    gpu::Executor& executor_;
    std::vector<std::byte> bytes_;
};

/// Reads one section of a film's saved state, in the order in which it was written. All functions throw Error
/// when they would read beyond the end of the section.
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

    /// Copies the next `size_bytes` into a new buffer on the device.
    [[nodiscard]] gpu::Buffer buffer(const char* name, uint64_t size_bytes);

    [[nodiscard]] bool is_at_end() const { return left_.empty(); }

    [[nodiscard]] std::span<const std::byte> take(uint64_t size_bytes);

private:
    gpu::Device& device_;
    std::span<const std::byte> left_;
};

/// Events that make data obsolete that features keep between pictures.
enum class Event : uint8_t {
    scene_replaced,    ///< set_scene() has replaced the whole scene
    layout_replaced,   ///< The scene's draw calls, vertices and triangles have new numbers
    triangles_changed, ///< Some triangles have other flags, or were torn
    ground_replaced,   ///< The terrain has other triangles; sent after layout_replaced
    lights_changed,    ///< Lights have changed, so shadows may have changed
    pose_changed,      ///< The vertices are about to be posed differently than in the previous frame
    anchor_moved,      ///< Positions on the device are relative to another origin
    film_recalled,     ///< A film's state was restored, but it has no section of this feature
};

/// The feature's section in the saved state of a film.
struct FilmSection {
    std::string_view name;
    uint32_t version = 1; ///< Version of the bytes that save() writes; load() only gets bytes of this version
};

/// A part of the renderer that keeps buffers or state from picture to picture. A feature plans on the CPU,
/// records its passes into a frame graph, and forgets data that an event makes obsolete. A feature also saves
/// the state from which the film's next frame continues.
class Feature {
public:
    Feature() = default;
    Feature(const Feature&) = delete;
    Feature& operator=(const Feature&) = delete;
    Feature(Feature&&) = delete;
    Feature& operator=(Feature&&) = delete;
    virtual ~Feature() = default;

    /// Forgets the data that `event` makes obsolete. Buffers stay allocated, so the call costs almost
    /// nothing.
    virtual void invalidate(Event event) = 0;

    /// Returns name and version of the feature's section in a film's saved state; none if the feature keeps
    /// no state from frame to frame.
    [[nodiscard]] virtual std::optional<FilmSection> film_section() const { return std::nullopt; }

    /// Writes the feature's state, which load() restores; writes nothing if the last frame left no state.
    virtual void save(FilmWriter& /*writer*/) {}

    /// Restores the feature's state that save() wrote, for the next frame. Throws Error if the bytes are
    /// damaged or belong to another scene. After an Error the feature may have lost its former state.
    virtual void load(FilmReader& /*reader*/) {}
};

} // namespace estampe::features
