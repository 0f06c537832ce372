// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe {

/// The bytes of a file, which all lie within it or are refused.
class PictureBytes {
public:
    PictureBytes(std::span<const std::byte> data, const char* format, const std::string& name)
        : data_(data), format_(format), name_(name)
    {
    }

    [[nodiscard]] size_t size() const { return data_.size(); }

    /// From that byte on; need() says whether it is there.
    [[nodiscard]] const std::byte* at(size_t place) const { return data_.data() + place; }

    [[nodiscard]] uint32_t byte(size_t at) const
    {
        need(at, 1);
        return static_cast<uint32_t>(data_[at]);
    }

    [[nodiscard]] uint32_t little16(size_t at) const { return byte(at) | byte(at + 1) << 8U; }

    [[nodiscard]] uint32_t little32(size_t at) const { return little16(at) | little16(at + 2) << 16U; }

    [[nodiscard]] uint32_t big16(size_t at) const { return byte(at) << 8U | byte(at + 1); }

    [[nodiscard]] uint32_t big32(size_t at) const { return big16(at) << 16U | big16(at + 2); }

    void need(uint64_t at, uint64_t count) const
    {
        if (at > data_.size() || count > data_.size() - at)
            throw Error(fmt::format("corrupt {}: the data ends too early", format_), name_);
    }

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw Error(fmt::format("{} {}", format_, why), name_);
    }

private:
    std::span<const std::byte> data_;
    const char* format_;
    const std::string& name_;
};

} // namespace estampe
