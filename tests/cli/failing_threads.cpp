// SPDX-License-Identifier: MIT
// A library to be loaded before all others, under which threads cannot be started, so that tests see what
// becomes of a machine or a user that has its full number of them:
//
//     LD_PRELOAD=libestampe_failing_threads.so ESTAMPE_FAIL_THREADS=3:1 estampe ...
//
// lets the third thread fail; 3:0 that and all that come after.

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <pthread.h>

namespace {

using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

std::atomic<long> starts{0};

bool fails()
{
    const char* const text = std::getenv("ESTAMPE_FAIL_THREADS");
    long first = 0;
    long count = 0;
    if (text == nullptr || std::sscanf(text, "%ld:%ld", &first, &count) != 2) {
        return false;
    }
    const long number = ++starts;
    return number >= first && (count == 0 || number < first + count);
}

} // namespace

extern "C" __attribute__((visibility("default"))) int
pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument)
{
    static const auto next = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
    return fails() ? EAGAIN : next(thread, attributes, work, argument);
}
