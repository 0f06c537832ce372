// SPDX-License-Identifier: MIT
#include "core/failure.hpp"

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <pthread.h>
#include <sys/mman.h>

#include <fmt/format.h>

#include "core/free_memory.hpp"

namespace estampe {
namespace {

/// Returns the size in bytes of the stack that a new thread gets.
size_t stack_bytes()
{
    constexpr size_t usual_bytes = size_t{8} << 20U;
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) {
        return usual_bytes;
    }
    size_t bytes = 0;
    const bool is_known = pthread_attr_getstacksize(&attributes, &bytes) == 0;
    pthread_attr_destroy(&attributes);
    return is_known ? bytes : usual_bytes;
}

/// Returns whether the stack of another thread fits into memory. Tries it, because a limit of the address
/// space (ulimit -v) shows nowhere else; a control group's limit shows only in the free memory.
bool fits_stack(size_t bytes)
{
    void* const stack =
        mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (stack == MAP_FAILED) {
        return false;
    }
    munmap(stack, bytes);
    return free_memory_bytes() >= bytes;
}

} // namespace

std::string message_of_caught()
{
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return out_of_memory;
    } catch (const std::length_error&) {
        return out_of_memory; // A size beyond all address space
    } catch (const std::filesystem::filesystem_error& problem) {
        return problem.code() == std::errc::not_enough_memory
                   ? out_of_memory
                   : Error(fmt::format("cannot be reached: {}", problem.code().message()),
                           problem.path1().string(), "check the folder and its permissions")
                         .what();
    } catch (const std::system_error& problem) {
        if (problem.code() == std::errc::not_enough_memory) {
            return out_of_memory;
        }
        if (problem.code() == std::errc::resource_unavailable_try_again) {
            return no_thread("a thread could not be started", problem).what();
        }
        return fmt::format("the system refused: {}; it may be out of files", problem.code().message());
    } catch (const std::exception& problem) {
        return problem.what();
    }
}

Error no_thread(const std::string& what, const std::system_error& problem)
{
    const size_t bytes = stack_bytes();
    return fits_stack(bytes) ? Error(fmt::format("{}: {}", what, problem.code().message()), {},
                                     "end other programs, or raise the limit of threads (ulimit -u)")
                             : Error(fmt::format("{}: no memory for a stack of {}", what, in_bytes(bytes)),
                                     {}, "end other programs, or raise the limit of memory (ulimit -v)");
}

} // namespace estampe
