// SPDX-License-Identifier: MIT
// A library to be loaded before all others, under which calls of the system and of the C++ library fail, so
// that tests see what becomes of a machine without memory, room or threads:
//
//     LD_PRELOAD=libestampe_failing_calls.so ESTAMPE_FAIL_CALLS=thread:3:1 estampe ...
//
// lets the third thread fail; thread:3:0 the third and all later threads. Kinds:
//
//     memory   operator new, malloc, calloc, realloc
//     thread   pthread_create
//     map      mmap
//     write    write, writev, pwrite, fwrite, fflush and ftruncate, which report a full disk
//     sync     fsync, fdatasync, and fclose and close of what is open for writing, which report a broken disk
//     create   open and fopen for writing, mkostemp, mkdtemp, mkdir, which report a full disk
//     rename   rename, renameat2, link
//     process  fork, posix_spawn, posix_spawnp, socketpair, pipe, pipe2
//
// ESTAMPE_COUNT_CALLS=FILE appends how often the program made the calls of each kind. Only calls of the
// program estampe count: those of its main executable, also through the libraries of C++ and of fmt, but not
// those of a graphics driver, whose compiler ends the process without memory.

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <unwind.h>

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

enum Kind { memory, thread, map, write_, sync_, create, rename_, process, kind_count };

constexpr std::array<const char*, kind_count> kind_names{"memory", "thread", "map",    "write",
                                                         "sync",   "create", "rename", "process"};

struct Range {
    uintptr_t begin = 0;
    uintptr_t end = 0;

    [[nodiscard]] bool has(uintptr_t address) const { return address >= begin && address < end; }
};

/// What the environment asks for, and where the program and the libraries that it calls through lie.
struct Plan {
    bool is_of_estampe = false; ///< the program is estampe, not one that estampe starts
    bool is_on = false;         ///< main() runs; nothing can report what fails before and after
    int kind = kind_count;
    long first = 0;
    long count = 0; ///< 0: all from the first on
    Range program;
    std::array<Range, 8> through{}; ///< libraries that the program calls through
    size_t through_count = 0;
    std::array<Range, 128> linked{}; ///< other libraries that the program is linked with; drivers come later
    size_t linked_count = 0;
};

Plan plan;
std::array<std::atomic<long>, kind_count> calls{};
thread_local bool is_looking = false; ///< this thread is inside this library

int note_object(dl_phdr_info* info, size_t /*size*/, void* /*data*/)
{
    Range range{UINTPTR_MAX, 0};
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        if (info->dlpi_phdr[i].p_type == PT_LOAD) {
            const uintptr_t begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            range.begin = std::min(range.begin, begin);
            range.end = std::max(range.end, begin + info->dlpi_phdr[i].p_memsz);
        }
    }
    const std::string_view name(info->dlpi_name);
    if (name.empty() && plan.program.end == 0) {
        plan.program = range; // the loader lists the executable first, without a name
        return 0;
    }
    for (const char* const passed : {"libstdc++", "libfmt", "libgcc_s", "libestampe_failing_calls"}) {
        if (name.find(passed) != std::string_view::npos && plan.through_count < plan.through.size()) {
            plan.through[plan.through_count++] = range;
            return 0;
        }
    }
    if (plan.linked_count < plan.linked.size()) {
        plan.linked[plan.linked_count++] = range;
    }
    return 0;
}

__attribute__((constructor)) void make_plan()
{
    if (std::string_view(program_invocation_short_name) != "estampe") {
        return; // a program that estampe starts
    }
    dl_iterate_phdr(note_object, nullptr);
    const char* const text = std::getenv("ESTAMPE_FAIL_CALLS");
    char kind[16] = "";
    if (text != nullptr && std::sscanf(text, "%15[^:]:%ld:%ld", kind, &plan.first, &plan.count) == 3) {
        for (size_t i = 0; i < kind_count; ++i) {
            plan.kind = std::string_view(kind_names[i]) == kind ? static_cast<int>(i) : plan.kind;
        }
    }
    if (text != nullptr && plan.kind == kind_count) {
        std::fprintf(stderr, "ESTAMPE_FAIL_CALLS=%s is not KIND:NUMBER:COUNT\n", text);
        std::abort();
    }
    plan.is_of_estampe = true;
}

__attribute__((destructor)) void write_counts()
{
    const char* const path = std::getenv("ESTAMPE_COUNT_CALLS");
    if (!plan.is_of_estampe || path == nullptr) {
        return;
    }
    if (std::FILE* const file = std::fopen(path, "a"); file != nullptr) {
        for (size_t i = 0; i < kind_count; ++i) {
            std::fprintf(file, "%s %ld\n", kind_names[i], calls[i].load());
        }
        std::fclose(file);
    }
}

bool is_in(const Range* ranges, size_t count, uintptr_t address)
{
    return std::any_of(ranges, ranges + count, [&](const Range& range) { return range.has(address); });
}

bool is_passed(uintptr_t address)
{
    return is_in(plan.through.data(), plan.through_count, address);
}

/// What the stack shows, from the innermost call on.
struct Walk {
    int of_program = 0; ///< calls by the program so far
    bool is_of_driver = false;
};

_Unwind_Reason_Code look(_Unwind_Context* context, void* data)
{
    // A template that the program instantiates, such as a part of std::string, serves a driver, too. It calls
    // fewer functions than this.
    constexpr int enough = 5;
    Walk& walk = *static_cast<Walk*>(data);
    const uintptr_t address = _Unwind_GetIP(context);
    if (is_passed(address)) {
        return _URC_NO_REASON;
    }
    if (plan.program.has(address)) {
        return ++walk.of_program < enough ? _URC_NO_REASON : _URC_END_OF_STACK;
    }
    walk.is_of_driver = !is_in(plan.linked.data(), plan.linked_count, address);
    return _URC_END_OF_STACK;
}

bool is_of_program(const void* caller)
{
    const auto address = reinterpret_cast<uintptr_t>(caller);
    if (!plan.program.has(address) && !is_passed(address)) {
        return false;
    }
    Walk walk;
    is_looking = true;
    _Unwind_Backtrace(look, &walk);
    is_looking = false;
    return walk.of_program > 0 && !walk.is_of_driver;
}

/// Counts a call, and returns whether the call is to fail.
bool fails(Kind kind, const void* caller)
{
    if (!plan.is_on || is_looking || !is_of_program(caller)) {
        return false;
    }
    const long number = ++calls[kind];
    return plan.kind == kind && number >= plan.first && (plan.count == 0 || number < plan.first + plan.count);
}

bool fails_with(int error, Kind kind, const void* caller)
{
    if (!fails(kind, caller)) {
        return false;
    }
    errno = error;
    return true;
}

int (*main_of_program)(int, char**, char**) = nullptr;

int watched_main(int count, char** words, char** environment)
{
    plan.is_on = plan.is_of_estampe;
    const int status = main_of_program(count, words, environment);
    plan.is_on = false;
    return status;
}

template <typename Function>
Function* next(const char* name)
{
    is_looking = true;
    void* const found = dlsym(RTLD_NEXT, name);
    is_looking = false;
    return reinterpret_cast<Function*>(found);
}

bool is_open_for_writing(int file)
{
    const int flags = fcntl(file, F_GETFL);

    struct stat status {};

    return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && fstat(file, &status) == 0 &&
           S_ISREG(status.st_mode);
}

/// Whether fopen() opens for writing in this mode.
bool writes(const char* mode)
{
    return mode[0] != 'r' || std::strchr(mode, '+') != nullptr;
}

void* allocate(size_t size, const void* caller)
{
    void* const made = fails(memory, caller) ? nullptr : __libc_malloc(size == 0 ? 1 : size);
    if (made == nullptr) {
        throw std::bad_alloc();
    }
    return made;
}

void* allocate_aligned(size_t size, std::align_val_t alignment, const void* caller)
{
    void* const made = fails(memory, caller)
                           ? nullptr
                           : __libc_memalign(static_cast<size_t>(alignment), size == 0 ? 1 : size);
    if (made == nullptr) {
        throw std::bad_alloc();
    }
    return made;
}

} // namespace

#define CALLER __builtin_return_address(0)
#define EXPORT __attribute__((visibility("default")))
#define NEXT(name) static const auto next_call = next<decltype(name)>(#name)

EXPORT void* operator new(size_t size)
{
    return allocate(size, CALLER);
}

EXPORT void* operator new[](size_t size)
{
    return allocate(size, CALLER);
}

EXPORT void* operator new(size_t size, std::align_val_t alignment)
{
    return allocate_aligned(size, alignment, CALLER);
}

EXPORT void* operator new[](size_t size, std::align_val_t alignment)
{
    return allocate_aligned(size, alignment, CALLER);
}

EXPORT void* operator new(size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    return fails(memory, CALLER) ? nullptr : __libc_malloc(size == 0 ? 1 : size);
}

EXPORT void* operator new[](size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    return fails(memory, CALLER) ? nullptr : __libc_malloc(size == 0 ? 1 : size);
}

extern "C" {

EXPORT int __libc_start_main(int (*program)(int, char**, char**), int count, char** words, void (*begin)(),
                             void (*end)(), void (*end_of_loader)(), void* stack)
{
    NEXT(__libc_start_main);
    main_of_program = program;
    return next_call(watched_main, count, words, begin, end, end_of_loader, stack);
}

// Memory that libraries in C allocate for themselves does not count.
EXPORT void* malloc(size_t size)
{
    return plan.program.has(reinterpret_cast<uintptr_t>(CALLER)) && fails_with(ENOMEM, memory, CALLER)
               ? nullptr
               : __libc_malloc(size);
}

EXPORT void* calloc(size_t count, size_t size)
{
    return plan.program.has(reinterpret_cast<uintptr_t>(CALLER)) && fails_with(ENOMEM, memory, CALLER)
               ? nullptr
               : __libc_calloc(count, size);
}

EXPORT void* realloc(void* old, size_t size)
{
    return plan.program.has(reinterpret_cast<uintptr_t>(CALLER)) && fails_with(ENOMEM, memory, CALLER)
               ? nullptr
               : __libc_realloc(old, size);
}

EXPORT int pthread_create(pthread_t* made, const pthread_attr_t* attributes, void* (*work)(void*),
                          void* argument)
{
    NEXT(pthread_create);
    return fails(thread, CALLER) ? EAGAIN : next_call(made, attributes, work, argument);
}

EXPORT void* mmap(void* address, size_t length, int protection, int flags, int file, off_t offset)
{
    NEXT(mmap);
    return fails_with(ENOMEM, map, CALLER) ? MAP_FAILED
                                           : next_call(address, length, protection, flags, file, offset);
}

EXPORT ssize_t write(int file, const void* bytes, size_t size)
{
    NEXT(write);
    return fails_with(ENOSPC, write_, CALLER) ? -1 : next_call(file, bytes, size);
}

EXPORT ssize_t writev(int file, const iovec* parts, int count)
{
    NEXT(writev);
    return fails_with(ENOSPC, write_, CALLER) ? -1 : next_call(file, parts, count);
}

EXPORT ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset)
{
    NEXT(pwrite);
    return fails_with(ENOSPC, write_, CALLER) ? -1 : next_call(file, bytes, size, offset);
}

EXPORT size_t fwrite(const void* bytes, size_t size, size_t count, std::FILE* file)
{
    NEXT(fwrite);
    const bool is_of_message = file == stdout || file == stderr;
    return !is_of_message && fails_with(ENOSPC, write_, CALLER) ? 0 : next_call(bytes, size, count, file);
}

EXPORT int fflush(std::FILE* file)
{
    NEXT(fflush);
    const bool is_of_message = file == stdout || file == stderr || file == nullptr;
    return !is_of_message && fails_with(ENOSPC, write_, CALLER) ? EOF : next_call(file);
}

EXPORT int ftruncate(int file, off_t size)
{
    NEXT(ftruncate);
    return fails_with(ENOSPC, write_, CALLER) ? -1 : next_call(file, size);
}

EXPORT int fsync(int file)
{
    NEXT(fsync);
    return fails_with(EIO, sync_, CALLER) ? -1 : next_call(file);
}

EXPORT int fdatasync(int file)
{
    NEXT(fdatasync);
    return fails_with(EIO, sync_, CALLER) ? -1 : next_call(file);
}

// As the system does, a close that fails closes the file all the same.
EXPORT int fclose(std::FILE* file)
{
    NEXT(fclose);
    const bool is_written = plan.is_on && is_open_for_writing(fileno(file));
    const bool is_failing = is_written && fails(sync_, CALLER);
    const int result = next_call(file);
    errno = is_failing ? EIO : errno;
    return is_failing ? EOF : result;
}

EXPORT int close(int file)
{
    NEXT(close);
    const bool is_written = plan.is_on && is_open_for_writing(file);
    const bool is_failing = is_written && fails(sync_, CALLER);
    const int result = next_call(file);
    errno = is_failing ? EIO : errno;
    return is_failing ? -1 : result;
}

EXPORT int open(const char* path, int flags, ...)
{
    NEXT(open);
    va_list rest;
    va_start(rest, flags);
    const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    const mode_t mode = has_mode ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return has_mode && fails_with(ENOSPC, create, CALLER) ? -1 : next_call(path, flags, mode);
}

EXPORT std::FILE* fopen(const char* path, const char* mode)
{
    NEXT(fopen);
    return writes(mode) && fails_with(ENOSPC, create, CALLER) ? nullptr : next_call(path, mode);
}

EXPORT std::FILE* fopen64(const char* path, const char* mode)
{
    NEXT(fopen64);
    return writes(mode) && fails_with(ENOSPC, create, CALLER) ? nullptr : next_call(path, mode);
}

EXPORT int mkostemp(char* name, int flags)
{
    NEXT(mkostemp);
    return fails_with(ENOSPC, create, CALLER) ? -1 : next_call(name, flags);
}

EXPORT int mkstemp(char* name)
{
    NEXT(mkstemp);
    return fails_with(ENOSPC, create, CALLER) ? -1 : next_call(name);
}

EXPORT char* mkdtemp(char* name)
{
    NEXT(mkdtemp);
    return fails_with(ENOSPC, create, CALLER) ? nullptr : next_call(name);
}

EXPORT int mkdir(const char* path, mode_t mode)
{
    NEXT(mkdir);
    return fails_with(ENOSPC, create, CALLER) ? -1 : next_call(path, mode);
}

EXPORT int rename(const char* from, const char* to)
{
    NEXT(rename);
    return fails_with(EIO, rename_, CALLER) ? -1 : next_call(from, to);
}

EXPORT int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags)
{
    NEXT(renameat2);
    return fails_with(EIO, rename_, CALLER) ? -1 : next_call(from_folder, from, to_folder, to, flags);
}

EXPORT int link(const char* from, const char* to)
{
    NEXT(link);
    return fails_with(EIO, rename_, CALLER) ? -1 : next_call(from, to);
}

EXPORT pid_t fork()
{
    NEXT(fork);
    return fails_with(EAGAIN, process, CALLER) ? -1 : next_call();
}

EXPORT int posix_spawn(pid_t* made, const char* path, const posix_spawn_file_actions_t* actions,
                       const posix_spawnattr_t* attributes, char* const* words, char* const* environment)
{
    NEXT(posix_spawn);
    return fails(process, CALLER) ? EAGAIN : next_call(made, path, actions, attributes, words, environment);
}

EXPORT int posix_spawnp(pid_t* made, const char* name, const posix_spawn_file_actions_t* actions,
                        const posix_spawnattr_t* attributes, char* const* words, char* const* environment)
{
    NEXT(posix_spawnp);
    return fails(process, CALLER) ? EAGAIN : next_call(made, name, actions, attributes, words, environment);
}

EXPORT int socketpair(int domain, int type, int protocol, int* ends)
{
    NEXT(socketpair);
    return fails_with(EMFILE, process, CALLER) ? -1 : next_call(domain, type, protocol, ends);
}

EXPORT int pipe2(int* ends, int flags)
{
    NEXT(pipe2);
    return fails_with(EMFILE, process, CALLER) ? -1 : next_call(ends, flags);
}

EXPORT int pipe(int* ends)
{
    NEXT(pipe);
    return fails_with(EMFILE, process, CALLER) ? -1 : next_call(ends);
}
}
