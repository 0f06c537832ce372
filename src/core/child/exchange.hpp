// SPDX-License-Identifier: MIT
#pragma once

// Passes values between processes as bytes: send() writes a value, receive() reads and checks it. Both follow
// the same list of members: a struct T takes part through a function `auto members(T&)` (also for const T)
// that returns std::tie of all members, and an enumeration through a function `bool is_valid(T)`. Both
// functions are found in the namespace of T.
//
// The receiver trusts no byte. Memory is claimed from a budget before it is allocated, and is filled only as
// bytes arrive. Bools and enumerations are checked. Numbers that are not finite are replaced: NaN by zero,
// infinity by the largest finite number. Indices are not checked here.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace estampe {

/// Collects the bytes of values and passes them on in large pieces.
class ByteWriter {
public:
    /// `write` receives the bytes.
    explicit ByteWriter(std::function<void(std::span<const std::byte>)> write) : write_(std::move(write)) {}

    void bytes(std::span<const std::byte> bytes);
    /// Passes on the bytes that are collected.
    void flush();

private:
    std::function<void(std::span<const std::byte>)> write_;
    std::vector<std::byte> collected_;
};

/// Reads bytes from a source in large pieces, and keeps the budget of memory for what is made of them.
class ByteReader {
public:
    /// `read` fills a part of the span and returns the size of this part; 0 at the end of the bytes.
    /// `budget_bytes` limits the memory of everything that is read. Errors name `where` as their place.
    ByteReader(std::function<size_t(std::span<std::byte>)> read, uint64_t budget_bytes, std::string where)
        : read_(std::move(read)), budget_bytes_(budget_bytes), where_(std::move(where))
    {
    }

    /// Fills `target`. Throws Error if the bytes end too early.
    void bytes(std::span<std::byte> target);
    /// Deducts the memory of `count` items from the budget. Throws Error if the budget does not suffice.
    void claim(uint64_t count, uint64_t bytes_each);
    /// Throws the Error that the bytes are damaged.
    [[noreturn]] void damaged() const;

private:
    [[nodiscard]] size_t read_ahead(std::span<std::byte> target);

    std::function<size_t(std::span<std::byte>)> read_;
    uint64_t budget_bytes_;
    std::string where_;
    std::vector<std::byte> ahead_; ///< Bytes that were read before they were asked for
    size_t next_ = 0;              ///< First byte of `ahead_` that was not returned yet
};

/// Replaces NaN by zero, and infinity by the largest number of its sign. Fast if all numbers are finite.
void make_finite(std::span<float> numbers);
void make_finite(std::span<double> numbers);

/// Numbers, and vectors and matrices of numbers, which cross as they lie in memory.
template <typename T>
concept PlainNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

template <typename T>
concept PlainVector = std::is_trivially_copyable_v<T> && requires
{
    requires PlainNumber<typename T::value_type>;
} && requires
{
    T::length();
};

template <typename T>
concept Plain = PlainNumber<T> || PlainVector<T> || std::same_as<T, std::byte>;

/// `T` is `Struct` or const `Struct`, as the functions `members` take.
template <typename T, typename Struct>
concept Either = std::same_as<std::remove_const_t<T>, Struct>;

template <typename T>
concept WithMembers = requires(T& value)
{
    members(value);
};

namespace exchange {

template <typename T>
inline constexpr bool is_vector = false;
template <typename Item>
inline constexpr bool is_vector<std::vector<Item>> = true;
template <typename T>
inline constexpr bool is_array = false;
template <typename Item, size_t size>
inline constexpr bool is_array<std::array<Item, size>> = true;
template <typename T>
inline constexpr bool is_optional = false;
template <typename Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

template <Plain T>
void make_plain_finite(std::span<T> values)
{
    if constexpr (std::is_floating_point_v<T>) {
        make_finite(values);
    } else if constexpr (PlainVector<T>) {
        using Number = typename T::value_type;
        if constexpr (std::is_floating_point_v<Number>)
            make_finite(
                std::span(reinterpret_cast<Number*>(values.data()), values.size_bytes() / sizeof(Number)));
    }
}

} // namespace exchange

template <typename T>
void send(ByteWriter& writer, const T& value)
{
    if constexpr (Plain<T>) {
        writer.bytes(std::as_bytes(std::span(&value, 1)));
    } else if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
        send(writer, static_cast<uint8_t>(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
        send(writer, uint64_t{value.size()});
        writer.bytes(std::as_bytes(std::span(value)));
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
        send(writer, value.native());
    } else if constexpr (exchange::is_vector<T>) {
        send(writer, uint64_t{value.size()});
        if constexpr (Plain<typename T::value_type>)
            writer.bytes(std::as_bytes(std::span(value)));
        else
            for (const auto& item : value)
                send(writer, item);
    } else if constexpr (exchange::is_array<T>) {
        for (const auto& item : value)
            send(writer, item);
    } else if constexpr (exchange::is_optional<T>) {
        send(writer, value.has_value());
        if (value)
            send(writer, *value);
    } else {
        static_assert(WithMembers<const T>);
        std::apply([&writer](const auto&... each) { (send(writer, each), ...); }, members(value));
    }
}

template <typename T>
void receive(ByteReader& reader, T& value);

namespace exchange {

template <typename Text>
void receive_plain(ByteReader& reader, Text& items)
{
    using Item = typename Text::value_type;
    // At most this much memory is reserved before its bytes arrive. Larger vectors grow as bytes arrive.
    constexpr uint64_t most_reserved_bytes = uint64_t{64} << 20U;
    constexpr uint64_t piece_bytes = uint64_t{1} << 18U; // stays in the cache from one step to the next
    uint64_t count = 0;
    receive(reader, count);
    reader.claim(count, sizeof(Item));
    items.clear();
    items.reserve(std::min(count, most_reserved_bytes / sizeof(Item)));
    while (items.size() < count) {
        const size_t done = items.size();
        items.resize(done + std::min<size_t>(count - done, piece_bytes / sizeof(Item)));
        const std::span added = std::span(items).subspan(done);
        reader.bytes(std::as_writable_bytes(added));
        make_plain_finite(added);
    }
}

template <typename Item>
void receive_items(ByteReader& reader, std::vector<Item>& items)
{
    uint64_t count = 0;
    receive(reader, count);
    reader.claim(count, sizeof(Item));
    items.clear();
    for (uint64_t i = 0; i < count; ++i)
        receive(reader, items.emplace_back());
}

} // namespace exchange

template <typename T>
void receive(ByteReader& reader, T& value)
{
    if constexpr (Plain<T>) {
        reader.bytes(std::as_writable_bytes(std::span(&value, 1)));
        exchange::make_plain_finite(std::span(&value, 1));
    } else if constexpr (std::is_same_v<T, bool>) {
        uint8_t byte = 0;
        receive(reader, byte);
        if (byte > 1)
            reader.damaged();
        value = byte != 0;
    } else if constexpr (std::is_enum_v<T>) {
        static_assert(sizeof(T) == 1);
        uint8_t byte = 0;
        receive(reader, byte);
        value = static_cast<T>(byte);
        if (!is_valid(value))
            reader.damaged();
    } else if constexpr (std::is_same_v<T, std::string>) {
        exchange::receive_plain(reader, value);
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
        std::string text;
        receive(reader, text);
        value = std::move(text);
    } else if constexpr (exchange::is_vector<T>) {
        if constexpr (Plain<typename T::value_type>)
            exchange::receive_plain(reader, value);
        else
            exchange::receive_items(reader, value);
    } else if constexpr (exchange::is_array<T>) {
        for (auto& item : value)
            receive(reader, item);
    } else if constexpr (exchange::is_optional<T>) {
        bool has_value = false;
        receive(reader, has_value);
        value.reset();
        if (has_value)
            receive(reader, value.emplace());
    } else {
        static_assert(WithMembers<T>);
        std::apply([&reader](auto&... each) { (receive(reader, each), ...); }, members(value));
    }
}

} // namespace estampe
