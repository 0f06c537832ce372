// SPDX-License-Identifier: MIT
#include "steady/counted_heap.hpp"

#include <cstdlib>
#include <new>

namespace {

thread_local estampe::test::HeapCount counted; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void* counted_room(std::size_t size, std::size_t alignment)
{
    ++counted.times;
    counted.bytes += size;
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    void* const room = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
    if (room == nullptr) {
        throw std::bad_alloc();
    }
    return room;
}

} // namespace

namespace estampe::test {

HeapCount heap_count()
{
    return counted;
}

} // namespace estampe::test

// All other forms of new and delete come down to these.

void* operator new(std::size_t size)
{
    return counted_room(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}

void* operator new(std::size_t size, std::align_val_t alignment)
{
    return counted_room(size, static_cast<std::size_t>(alignment));
}

void operator delete(void* room) noexcept
{
    std::free(room); // NOLINT(cppcoreguidelines-no-malloc)
}

void operator delete(void* room, std::size_t /*size*/) noexcept
{
    std::free(room); // NOLINT(cppcoreguidelines-no-malloc)
}

void operator delete(void* room, std::align_val_t /*alignment*/) noexcept
{
    std::free(room); // NOLINT(cppcoreguidelines-no-malloc)
}

void operator delete(void* room, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
    std::free(room); // NOLINT(cppcoreguidelines-no-malloc)
}
