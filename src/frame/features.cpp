// SPDX-License-Identifier: MIT
#include "frame/features.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::frame {
namespace {

using features::FilmReader;
using features::FilmSection;

/// First bytes of a film's saved state; change them when the layout of its sections changes.
constexpr uint64_t signature = 0x38304d4c49465345ULL;

/// A section of a film's saved state, stored as its name, version, size and bytes.
struct Section {
    std::string_view name;
    uint32_t version = 0;
    std::span<const std::byte> bytes;
};

template <typename T>
void append(std::vector<std::byte>& bytes, const T& value)
{
    const size_t begin = bytes.size();
    // resize() and memcpy() avoid a false warning that GCC 12 gives for insert() with -O3.
    bytes.resize(begin + sizeof(value));
    std::memcpy(bytes.data() + begin, &value, sizeof(value));
}

void append_text(std::vector<std::byte>& bytes, std::string_view text)
{
    append(bytes, static_cast<uint32_t>(text.size()));
    const auto characters = std::as_bytes(std::span(text));
    bytes.insert(bytes.end(), characters.begin(), characters.end());
}

std::vector<Section> sections_of(gpu::Device& device, std::span<const std::byte> memory)
{
    FilmReader reader(device, memory);
    if (reader.value<uint64_t>() != signature) {
        features::fail_damaged();
    }
    std::vector<Section> sections;
    while (!reader.is_at_end()) {
        const auto name = reader.take(reader.value<uint32_t>());
        const auto version = reader.value<uint32_t>();
        const auto bytes = reader.take(reader.value<uint64_t>());
        sections.push_back({.name = {reinterpret_cast<const char*>(name.data()), name.size()},
                            .version = version,
                            .bytes = bytes});
    }
    return sections;
}

/// Checks the sections of a film's saved state. Throws Error unless each section belongs to a feature that
/// still writes its version.
void check_sections(const std::vector<Section>& sections, std::span<features::Feature* const> all)
{
    for (const Section& section : sections) {
        const bool is_known = std::ranges::any_of(all, [&](const features::Feature* feature) {
            const std::optional<FilmSection> own = feature->film_section();
            return own && own->name == section.name && own->version == section.version;
        });
        if (!is_known) {
            throw Error(fmt::format("the memory of a film's frame holds {} in version {}, which this build "
                                    "does not read",
                                    section.name, section.version),
                        "", "draw the film's frames with one version of the program");
        }
    }
}

} // namespace

std::array<features::Feature*, 13> Features::all()
{
    return {&shadows, &lighting, &occlusion, &lines,       &hatching, &cloth,  &ink,
            &smoke,   &clouds,   &particles, &motion_blur, &toon,     &culling};
}

void Features::invalidate(features::Event event)
{
    for (features::Feature* const feature : all()) {
        feature->invalidate(event);
    }
}

std::vector<std::byte> save_film(Features& features, gpu::Device& device, gpu::Executor& executor)
{
    std::vector<std::byte> memory;
    append(memory, signature);
    for (features::Feature* const feature : features.all()) {
        const std::optional<FilmSection> section = feature->film_section();
        if (!section) {
            continue;
        }
        features::FilmWriter writer(device, executor);
        feature->save(writer);
        const std::vector<std::byte> bytes = writer.take();
        if (!bytes.empty()) {
            append_text(memory, section->name);
            append(memory, section->version);
            append(memory, uint64_t{bytes.size()});
            memory.insert(memory.end(), bytes.begin(), bytes.end());
        }
    }
    return memory;
}

void load_film(Features& features, gpu::Device& device, std::span<const std::byte> memory)
{
    const auto all = features.all();
    const std::vector<Section> sections = sections_of(device, memory);
    check_sections(sections, all);
    features.invalidate(features::Event::film_recalled);
    try {
        for (features::Feature* const feature : all) {
            const std::optional<FilmSection> own = feature->film_section();
            const auto found = std::ranges::find_if(
                sections, [&](const Section& section) { return own && section.name == own->name; });
            if (found == sections.end()) {
                continue;
            }
            FilmReader reader(device, found->bytes);
            feature->load(reader);
            if (!reader.is_at_end()) {
                features::fail_damaged();
            }
        }
    } catch (const Error&) {
        features.invalidate(features::Event::film_recalled);
        throw;
    }
}

} // namespace estampe::frame
