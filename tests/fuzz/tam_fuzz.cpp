// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the bytes, a tonal art map is read or refused with an Error. The first byte
// tells what the rest is: an archive, a DDS file, a manifest, or the PNG files of a folder one behind
// another.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <estampe/error.hpp>

#include "techniques/tam/files/map_files.hpp"

namespace {

using namespace estampe;

/// Takes `count` bytes that a length of two bytes announces.
std::span<const std::byte> take_part(std::span<const std::byte>& bytes)
{
    const size_t length =
        bytes.size() < 2 ? 0 : std::to_integer<size_t>(bytes[0]) | std::to_integer<size_t>(bytes[1]) << 8U;
    bytes = bytes.subspan(std::min<size_t>(2, bytes.size()));
    const std::span<const std::byte> part = bytes.first(std::min(length, bytes.size()));
    bytes = bytes.subspan(part.size());
    return part;
}

void read_folder(std::span<const std::byte> bytes)
{
    std::vector<std::vector<tam::Gray8>> level_of_tone;
    uint32_t size_px = 0;
    while (!bytes.empty() && level_of_tone.size() < 4) {
        tam::Square square = tam::decode_square(take_part(bytes), "tone.png");
        if (size_px != 0 && square.size_px != size_px) {
            return;
        }
        size_px = square.size_px;
        level_of_tone.push_back({std::move(square.coverage)});
    }
    (void)tam::complete_map(std::move(level_of_tone), size_px, {}, "folder");
}

void read_any(std::span<const std::byte> bytes, uint8_t kind)
{
    if (kind % 4 == 0) {
        const tam::TonalArtMap map = tam::decode_tam(bytes, "fuzz.tam");
        (void)tam::threshold_levels(map);
    } else if (kind % 4 == 1) {
        tam::DdsImages images = tam::decode_dds(bytes, "fuzz.dds");
        (void)tam::complete_map(std::move(images.level_of_layer), images.size_px, {}, "fuzz.dds");
    } else if (kind % 4 == 2) {
        (void)tam::parse_manifest(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                                  "tam.toml");
    } else {
        read_folder(bytes);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    if (size == 0) {
        return 0;
    }
    try {
        read_any({reinterpret_cast<const std::byte*>(data) + 1, size - 1}, data[0]);
    } catch (const Error&) {
        return 0;
    }
    return 0;
}
