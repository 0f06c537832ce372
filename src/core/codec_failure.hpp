// SPDX-License-Identifier: MIT
#pragma once

#include <csetjmp>
#include <cstdio>

#include <png.h>

namespace estampe {

/// How libpng and libjpeg come back from an error, which they tell by calling a function that must not
/// return: whatever has a destructor lives outside the frame that longjmp leaves.
struct CodecFailure {
    std::jmp_buf jump;
    char message[256] = {};
};

/// Of libpng, whose error pointer is a CodecFailure.
[[noreturn]] inline void png_failed(png_structp png, png_const_charp message)
{
    auto* failure = static_cast<CodecFailure*>(png_get_error_ptr(png));
    std::snprintf(failure->message, sizeof failure->message, "%s", message);
    std::longjmp(failure->jump, 1);
}

inline void png_warned(png_structp /*png*/, png_const_charp /*message*/) {}

} // namespace estampe
