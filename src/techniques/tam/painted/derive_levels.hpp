// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// Gives a map the levels that it lacks below those that were painted, of which every tone has as many.
///
/// The strokes of a tone are found in its difference from the tone before (see painted_strokes.hpp). Each
/// coarser level drops some of the strokes of the finer one, keeping those that are best spaced, and draws
/// the rest as many pixels wide as they were painted, until the ink is the darkness of the tone.
///
/// Cost    a second or two for 512 px and 6 tones
void derive_levels(TonalArtMap& map);

} // namespace estampe::tam
