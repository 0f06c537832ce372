// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace estampe {

/// Hash of a sequence of values; the same on all machines with the same byte order. The hash mixes eight
/// bytes at a time with the finaliser of Steele, Lea and Flood, "Fast Splittable Pseudorandom Number
/// Generators", 2014. It is not a cryptographic hash.
class Hash {
public:
    template <class T>
    void add(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        add_bytes(&value, sizeof value);
    }

    template <class T>
    void add_all(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        add(static_cast<uint64_t>(values.size()));
        add_bytes(values.data(), values.size() * sizeof(T));
    }

    void add_text(std::string_view text)
    {
        add(static_cast<uint64_t>(text.size()));
        add_bytes(text.data(), text.size());
    }

    [[nodiscard]] uint64_t value() const { return state_; }

    [[nodiscard]] static constexpr uint64_t mixed(uint64_t x)
    {
        x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
        return x ^ (x >> 31U);
    }

private:
    void add_bytes(const void* bytes, size_t count)
    {
        const auto* from = static_cast<const unsigned char*>(bytes);
        while (count > 0) {
            uint64_t word = 0;
            const size_t taken = count < sizeof word ? count : sizeof word;
            std::memcpy(&word, from, taken);
            state_ = mixed(state_ + 0x9E3779B97F4A7C15ULL + word);
            from += taken;
            count -= taken;
        }
    }

    uint64_t state_ = 0;
};

/// Hashes an integer with O'Neill's PCG output permutation, from Jarzynski and Olano, "Hash Functions for GPU
/// Rendering", JCGT 2020. The function in shaders/hash.glsl gives the same values.
[[nodiscard]] constexpr uint32_t hash(uint32_t x)
{
    const uint32_t state = x * 747796405U + 2891336453U;
    const uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

} // namespace estampe
