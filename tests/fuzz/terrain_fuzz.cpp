// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the text, a terrain is read or refused with an Error; one that is read can be
// written and read back, and every place has a height, or the graph says why not.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <estampe/error.hpp>
#include <estampe/terrain.hpp>

namespace {

/// Files are not the input's.
bool names_files(const estampe::TerrainDescription& description)
{
    return std::ranges::any_of(description.nodes, [](const estampe::HeightNode& node) {
        return node.expression.find("texture") != std::string::npos;
    });
}

void ask(const estampe::TerrainDescription& description)
{
    const estampe::Terrain terrain(description);
    for (const double place_m : {0.0, 0.37, -1234.5, 1e6}) {
        static_cast<void>(terrain.sample(place_m, -0.7 * place_m, 3.25));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const estampe::TerrainDescription description = estampe::parse_terrain(text, "fuzz.toml");
        const std::string written = estampe::terrain_toml(description);
        if (estampe::terrain_toml(estampe::parse_terrain(written, "again.toml")) != written) {
            std::abort();
        }
        if (!names_files(description)) {
            ask(description);
        }
    } catch (const estampe::Error&) {
    }
    return 0;
}
