// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHARED
#define ESTAMPE_SHARED
// Lets the headers named *.glsl.h compile as GLSL. These headers describe data that C++ and GLSL share.
// shaders/shared.hpp is the counterpart for C++.

#define SHARED_CONSTANT const

#endif
