// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

/// Draws 3D scenes as a hand would.
namespace estampe {

/// What failed, where, and what to do about it, in one line a person can act on.
///
/// Thrown for adverse conditions: bad input, a missing file, a device that is not there. Mistakes of the
/// programmer are assertions instead, and expected failures are return values.
/// `where` is a file, `file:line:column`, or `file#/json/pointer`; it may be empty.
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

} // namespace estampe
