// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "core/spread.hpp"

namespace estampe::lab {

[[nodiscard]] inline nlohmann::ordered_json spread_json(const Spread& spread)
{
    return {{"low", spread.low}, {"median", spread.median}, {"high", spread.high}};
}

} // namespace estampe::lab
