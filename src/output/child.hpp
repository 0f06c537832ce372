// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

namespace estampe::output {

/// A program that reads what we write. It gets none of the terminal's signals, so that what it writes is
/// whole when we are stopped. A thread's own; it is ended, if it still runs, with the object.
class Child {
public:
    /// Throws Error when there is no such program, with `to_install` as advice.
    Child(const std::vector<std::string>& command, const std::string& to_install);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// False when it reads no more.
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const;

    /// Ends its input and waits for it. True when it says that all went well.
    [[nodiscard]] bool finish();

    /// The first lines of what it said on stderr, once it has finished.
    [[nodiscard]] std::string complaint() const;

private:
    pid_t id_ = -1; ///< negative: it has ended
    int input_ = -1;
    int errors_ = -1; ///< a file without a name
};

} // namespace estampe::output
