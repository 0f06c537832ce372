// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHARED
#define ESTAMPE_SHARED
// Lets the headers named *.glsl.h, which describe data that C++ and GLSL share, compile as GLSL.
// shaders/shared.hpp is the counterpart for C++.

#define SHARED_CONSTANT const

#endif
