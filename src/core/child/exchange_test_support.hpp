// SPDX-License-Identifier: MIT
#pragma once

// Sends values to memory and receives them from there, for tests.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/child/exchange.hpp"

namespace estampe::test {

/// The bytes that send() makes of a value.
template <typename T>
std::vector<std::byte> sent(const T& value)
{
    std::vector<std::byte> bytes;
    ByteWriter writer(
        [&bytes](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    send(writer, value);
    writer.flush();
    return bytes;
}

/// Reads `bytes`, which must outlive the reader, in pieces of at most `piece` bytes.
inline ByteReader reader_of(std::span<const std::byte> bytes, uint64_t budget_bytes, std::string where,
                            size_t piece = SIZE_MAX)
{
    const auto read = [bytes, piece](std::span<std::byte> target) mutable {
        const size_t count = std::min({target.size(), bytes.size(), piece});
        std::copy_n(bytes.begin(), count, target.begin());
        bytes = bytes.subspan(count);
        return count;
    };
    return {read, budget_bytes, std::move(where)};
}

} // namespace estampe::test
