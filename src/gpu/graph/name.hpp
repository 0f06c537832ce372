// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace estampe::gpu {

/// The name of a pass or a resource while it is put together: frames are declared anew all the time, and
/// should not ask the heap for that. Cut off after 119 characters.
class Name {
public:
    Name(std::string_view text) { *this += text; } // NOLINT(google-explicit-constructor): names are texts

    Name(const char* text) : Name(std::string_view(text)) {} // NOLINT(google-explicit-constructor)

    Name(const std::string& text) : Name(std::string_view(text)) {} // NOLINT(google-explicit-constructor)

    Name& operator+=(std::string_view more)
    {
        const size_t added = std::min(more.size(), text_.size() - size_);
        std::copy_n(more.data(), added, text_.data() + size_);
        size_ += added;
        return *this;
    }

    [[nodiscard]] friend Name operator+(Name name, std::string_view more) { return name += more; }

    [[nodiscard]] std::string_view view() const { return {text_.data(), size_}; }

    operator std::string_view() const { return view(); } // NOLINT(google-explicit-constructor)

private:
    std::array<char, 119> text_;
    size_t size_ = 0;
};

} // namespace estampe::gpu
