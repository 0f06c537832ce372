// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace estampe::gpu {

class Recorder;

/// What a custom pass records: a callable of one Recorder&, or nothing. As std::function, but what it holds
/// on to stands within it, up to 256 bytes, and not on the heap.
class Recording {
public:
    Recording() = default;

    template <class Callable>

    requires(!std::is_same_v<std::remove_cvref_t<Callable>, Recording>)
        Recording(Callable&& callable) // NOLINT: implicit, and of no recordings
    {
        using Held = std::remove_cvref_t<Callable>;
        static_assert(sizeof(Held) <= room_bytes && alignof(Held) <= alignof(std::max_align_t));
        new (room_.data()) Held(std::forward<Callable>(callable));
        acts_ = &acts_of<Held>;
    }

    Recording(const Recording& other) : acts_(other.acts_)
    {
        if (acts_ != nullptr) {
            acts_->copy(other.room_.data(), room_.data());
        }
    }

    Recording& operator=(const Recording& other)
    {
        if (this != &other) {
            clear();
            if (other.acts_ != nullptr) {
                other.acts_->copy(other.room_.data(), room_.data());
            }
            acts_ = other.acts_;
        }
        return *this;
    }

    ~Recording() { clear(); }

    void clear()
    {
        if (acts_ != nullptr) {
            acts_->destroy(room_.data());
            acts_ = nullptr;
        }
    }

    explicit operator bool() const { return acts_ != nullptr; }

    void operator()(Recorder& recorder) const { acts_->call(room_.data(), recorder); }

private:
    static constexpr size_t room_bytes = 256;

    struct Acts {
        void (*call)(const std::byte* held, Recorder& recorder);
        void (*copy)(const std::byte* held, std::byte* to);
        void (*destroy)(std::byte* held);
    };

    template <class Held>
    static constexpr Acts acts_of{
        [](const std::byte* held, Recorder& recorder) {
            (*std::launder(reinterpret_cast<const Held*>(held)))(recorder);
        },
        [](const std::byte* held, std::byte* to) {
            new (to) Held(*std::launder(reinterpret_cast<const Held*>(held)));
        },
        [](std::byte* held) { std::destroy_at(std::launder(reinterpret_cast<Held*>(held))); }};

    alignas(std::max_align_t) std::array<std::byte, room_bytes> room_;
    const Acts* acts_ = nullptr;
};

} // namespace estampe::gpu
