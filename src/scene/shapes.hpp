// SPDX-License-Identifier: MIT
#pragma once

// The shapes that are offered to all, where the sources and their tests look for them.

#include <estampe/shapes.hpp> // IWYU pragma: export
