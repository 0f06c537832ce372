// SPDX-License-Identifier: MIT
#pragma once

// The memory of a film's frame as bytes: sections with a name and a version, one per feature.

#include <cstddef>
#include <cstdint>
#include <cstring>
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

} // namespace estampe::features
