// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <type_traits>

namespace estampe {

/// Fixed-capacity vector with inline storage; never allocates. Throws std::length_error for more than `most`
/// items.
template <class T, size_t most>

requires(std::is_trivially_copyable_v<T>&& std::is_trivially_destructible_v<T>) class InlineVector {
public:
    InlineVector() = default;

    InlineVector(std::initializer_list<T> items)
    {
        for (const T& item : items) {
            push_back(item);
        }
    }

    void push_back(const T& item)
    {
        if (size_ == most) {
            throw std::length_error("a short list has no room for more");
        }
        std::construct_at(reinterpret_cast<T*>(room_.data()) + size_, item);
        ++size_;
    }

    [[nodiscard]] bool empty() const { return size_ == 0; }

    [[nodiscard]] size_t size() const { return size_; }

    [[nodiscard]] const T* data() const { return std::launder(reinterpret_cast<const T*>(room_.data())); }

    [[nodiscard]] const T* begin() const { return data(); }

    [[nodiscard]] const T* end() const { return data() + size_; }

    [[nodiscard]] const T& operator[](size_t i) const { return data()[i]; }

    [[nodiscard]] const T& front() const { return *data(); }

private:
    alignas(T) std::array<std::byte, most * sizeof(T)> room_{};
    size_t size_ = 0;
};

} // namespace estampe
