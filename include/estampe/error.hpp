// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

/// Estampe draws 3D scenes in the manner of drawings by hand.
namespace estampe {

/// The exception of this library. The message of the exception states in one line what failed, where, and
/// what the user can do about it.
///
/// Error is thrown for failures that a correct program cannot exclude: bad input, a missing file, an
/// unavailable device. Programming mistakes are assertions, and expected failures are return values. `where`
/// is a file, `file:line:column`, or `file#/json/pointer`; it may be empty.
class Error : public std::runtime_error {
public:
    explicit Error(const std::string& what_failed, const std::string& where = {},
                   const std::string& remedy = {});

    [[nodiscard]] const std::string& where() const noexcept { return where_; }

    [[nodiscard]] const std::string& remedy() const noexcept { return remedy_; }

private:
    std::string where_;
    std::string remedy_;
};

/// The graphics device was lost: its driver was restarted, or the device was removed. All further work on it
/// fails; another Renderer may succeed.
class DeviceLost : public Error {
public:
    using Error::Error;
};

} // namespace estampe
