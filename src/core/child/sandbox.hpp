// SPDX-License-Identifier: MIT
#pragma once

// Takes rights away from a process that decodes files of strangers, so that a fault in a decoder cannot be
// used to change files, start programs or reach the network.

#include <cstdint>
#include <string>

#include <estampe/read_scope.hpp>

namespace estampe {

/// Lowers the resource limits of this process: no core file, no writing to files, few open files, `cpu_s`
/// seconds of processor time, and `memory_bytes` of memory in addition to what is mapped already. The limit
/// on memory does not apply under sanitizers, which map terabytes.
void limit_resources(uint32_t cpu_s, uint64_t memory_bytes);

/// Unmaps all writable memory that this process shares with others, such as mapped buffers of a graphics
/// card, and closes all files except 0, 1, 2 and `kept_file`.
void drop_shared(int kept_file);

/// Forbids this process to write, create, remove and execute files, through Landlock. If `scope` is limited,
/// files and folders outside of its folders cannot be opened either, except what tells how much memory is
/// free: /proc/meminfo, /proc/self and /sys/fs/cgroup. Folders that do not exist are left out. Already open
/// files stay open. Returns false if the kernel lacks Landlock. Source: Linux, "Landlock: unprivileged access
/// control".
[[nodiscard]] bool forbid_files(const ReadScope& scope);

/// Forbids all system calls of this process that a decoder does not need, through a seccomp filter. Refused
/// calls return EPERM: sockets, opening files for writing, executing, tracing, new processes, and signals to
/// other processes. Threads are allowed. Returns false if the kernel lacks seccomp.
[[nodiscard]] bool forbid_system_calls();

/// Returns the names of the protections that the kernel lacks: "seccomp", "Landlock" or "seccomp and
/// Landlock". Empty if it lacks none.
[[nodiscard]] std::string missing_protections();

} // namespace estampe
