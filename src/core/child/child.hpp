// SPDX-License-Identifier: MIT
#pragma once

// Runs work on files of strangers in a child process, which cannot harm this process or the machine. Read the
// files of this folder in this order:
//
//  1. child.hpp starts the child process, watches its time, and turns its end into a result or an Error.
//  2. exchange.hpp passes the result to this process as bytes, and checks the bytes.
//  3. sandbox.hpp takes rights away from the child process before it starts its work.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include <estampe/read_scope.hpp>

#include "core/child/exchange.hpp"

namespace estampe {

/// Limits of a child process. The parent ends a child that exceeds one of the limits.
struct ChildLimits {
    double wall_s = 120.0;
    uint32_t cpu_s = 60;
    /// Memory that the child may map in addition to the parent's; not enforced under sanitizers. Also the
    /// largest result that the parent accepts.
    uint64_t memory_bytes = uint64_t{4} << 30;
    /// If limited, the child cannot open files outside of these folders and of the system's folders of
    /// sandbox.hpp. Kernels without Landlock do not enforce this; open_to_read() does on any kernel.
    ReadScope scope;
};

/// Limits that suffice to decode a file of this size and the pictures that it names: the time and the memory
/// grow with the size. `scope` becomes that of the limits.
[[nodiscard]] ChildLimits limits_for_file(const std::filesystem::path& path, const ReadScope& scope);

namespace child {

using Send = std::function<void(ByteWriter&)>;

/// Runs `work` in the child process, which returns how to send its result. `receive` reads the result in the
/// parent process.
void run(const std::function<Send()>& work, const std::function<void(ByteReader&)>& receive,
         const ChildLimits& limits, const std::string& where);

} // namespace child

/// Runs `work` in a forked child process and returns the result of `work`, which send() and receive() pass to
/// this process. The child has no terminal output, and no rights but to read files and to compute (see
/// sandbox.hpp). If `work` crashes, hangs or runs out of memory, this function throws Error with `where` as
/// its place. An Error that `work` throws is thrown here with the same message, place and remedy. Progress
/// that `work` reports is reported here; if the ProgressWatch asks to stop, the child is ended.
///
/// `work` must not use a Vulkan device, nor locks that other threads of this process may hold. Cost: 1 to 3
/// ms, and about 1.5 ms per 4 megabytes of the result.
template <typename Work>
[[nodiscard]] std::invoke_result_t<Work> run_in_child(const Work& work, const ChildLimits& limits,
                                                      const std::string& where)
{
    using Result = std::invoke_result_t<Work>;
    Result result{};
    child::run(
        [&work]() -> child::Send {
            const auto made = std::make_shared<const Result>(work());
            return [made](ByteWriter& writer) { send(writer, *made); };
        },
        [&result](ByteReader& reader) { receive(reader, result); }, limits, where);
    return result;
}

} // namespace estampe
