// SPDX-License-Identifier: MIT
#pragma once

// Opens files within a ReadScope.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <estampe/error.hpp>
#include <estampe/read_scope.hpp>

namespace estampe {

/// Reports a file that lies outside a ReadScope. Readers that turn a missing file into a warning pass this
/// error on, because an attempt to leave the scope is no accident.
class OutsideScope : public Error {
public:
    using Error::Error;
};

/// Method that resolves the part of a path below a folder of a scope.
enum class ScopeWalk : uint8_t {
    automatic, ///< openat2() of Linux 5.6, or single parts where a kernel or a container lacks openat2()
    by_parts,  ///< One openat() for each part of the path
};

/// Opens a file or folder for reading with open() and the given flags. O_CLOEXEC is added. Returns a file
/// descriptor, or -1 with errno set. Throws OutsideScope if `scope` does not allow the path.
[[nodiscard]] int open_to_read(const std::filesystem::path& path, const ReadScope& scope, int flags,
                               ScopeWalk walk = ScopeWalk::automatic);

/// Checks a file name that stands in a scene, a style or a terrain. Throws OutsideScope if `scope` is limited
/// and the name is an absolute path or has a part "..". Backslashes count as slashes. `where` is the place of
/// the name, for the message.
void require_inside(std::string_view name, const ReadScope& scope, const std::string& where);

/// Returns whether a file name has a part "..". Backslashes count as slashes.
[[nodiscard]] bool leads_upwards(std::string_view name);

/// Throws OutsideScope that says that the file with this name lies outside of `scope`.
[[noreturn]] void fail_outside(std::string_view name, const ReadScope& scope, const std::string& where);

} // namespace estampe
