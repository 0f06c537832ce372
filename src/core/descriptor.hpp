// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <utility>

#include <unistd.h>

namespace estampe {

/// A file descriptor that is closed by the destructor. A negative number stands for a file that could not be
/// opened. Closing keeps errno, so that the reason of a failed call can still be read.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}

    ~Descriptor() { reset(-1); }

    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}

    Descriptor& operator=(Descriptor&&) = delete;

    [[nodiscard]] int number() const { return number_; }

    /// Returns the number, which the caller closes from now on.
    [[nodiscard]] int release() { return std::exchange(number_, -1); }

    /// Closes the descriptor, and holds another one.
    void reset(int number)
    {
        const int reason = errno;
        if (number_ >= 0) {
            close(number_);
        }
        number_ = number;
        errno = reason;
    }

private:
    int number_;
};

} // namespace estampe
