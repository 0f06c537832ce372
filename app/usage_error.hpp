// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/error.hpp>

namespace estampe::app {

/// A mistake on the command line itself: the program ends with 2 instead of 1.
class UsageError : public Error {
public:
    using Error::Error;
};

} // namespace estampe::app
