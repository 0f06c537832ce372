// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <memory>

#include <lcms2.h>

#include <estampe/error.hpp>

#include "output/pictures.hpp"

namespace estampe::output {
namespace {

struct CloseProfile {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};

std::vector<std::byte> make_srgb_profile()
{
    const std::unique_ptr<void, CloseProfile> profile(cmsCreate_sRGBProfile());
    cmsUInt32Number size = 0;
    std::vector<std::byte> bytes;
    if (profile && cmsSaveProfileToMem(profile.get(), nullptr, &size) != 0) {
        bytes.resize(size);
    }
    if (bytes.empty() || cmsSaveProfileToMem(profile.get(), bytes.data(), &size) == 0) {
        throw Error("cannot make a colour profile");
    }
    // It would be dated today, and the same picture would have other bytes tomorrow: 1 January 2000.
    constexpr size_t date_place = 24;
    constexpr std::array<uint8_t, 12> date{0x07, 0xD0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0};
    std::ranges::transform(date, bytes.begin() + date_place, [](uint8_t byte) { return std::byte(byte); });
    return bytes;
}

} // namespace

const std::vector<std::byte>& srgb_profile()
{
    static const std::vector<std::byte> profile = make_srgb_profile();
    return profile;
}

} // namespace estampe::output
