// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

namespace estampe::output {

/// A child process that reads data from this program. The child process does not receive the terminal's
/// signals, so it can complete its output when the parent program is interrupted. Only one thread may use a
/// Child. The destructor ends the process if it is still running.
class Child {
public:
    /// Starts the process. Throws Error, with `to_install` as remedy, if the program is not installed.
    Child(const std::vector<std::string>& command, const std::string& to_install);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Writes bytes to the process. Returns false if the process no longer reads.
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const;

    /// Closes the input of the process and waits for it. Returns whether the process reports success.
    [[nodiscard]] bool finish();

    /// Returns the first lines of the process's stderr, after the process has finished.
    [[nodiscard]] std::string complaint() const;

private:
    pid_t id_ = -1; ///< Number of the process; negative after the process has ended
    int input_ = -1;
    int errors_ = -1; ///< File descriptor of an unnamed file that receives the process's stderr
};

} // namespace estampe::output
