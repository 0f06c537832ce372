// SPDX-License-Identifier: MIT
#include "scene/pictures/picture_files.hpp"

#include <algorithm>
#include <map>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/image_codec.hpp"
#include "core/read_scope.hpp"
#include "core/text.hpp"

namespace estampe {
namespace {

/// Longest path that is searched; no operating system opens a longer path.
constexpr size_t longest_name = 4096;
constexpr size_t most_parts = 16;      ///< largest number of parts at the end of a path that are searched
constexpr size_t most_listed = 200000; ///< largest number of cached entries per folder

int hex_digit(char letter)
{
    if (letter >= '0' && letter <= '9')
        return letter - '0';
    const char small = static_cast<char>(letter | 0x20);
    return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

/// Decodes percent-encoded bytes such as "%20" in a name.
std::string percent_decoded(std::string_view name)
{
    std::string decoded;
    for (size_t i = 0; i < name.size(); ++i) {
        if (name[i] == '%' && i + 2 < name.size() && hex_digit(name[i + 1]) >= 0 &&
            hex_digit(name[i + 2]) >= 0) {
            decoded += static_cast<char>(hex_digit(name[i + 1]) * 16 + hex_digit(name[i + 2]));
            i += 2;
        } else {
            decoded += name[i];
        }
    }
    return decoded;
}

/// A path, split at its slashes, and whether the path is absolute: it starts at the root of a disk, a drive
/// or a server.
struct SplitPath {
    std::vector<std::string> parts;
    bool is_absolute = false;
};

SplitPath split(std::string_view name)
{
    SplitPath split;
    if (name.starts_with("file:")) {
        name.remove_prefix(5);
    }
    if (name.size() > 1 && name[1] == ':') {
        name.remove_prefix(2);
        split.is_absolute = true;
    }
    std::string part;
    const auto end_part = [&] {
        if (!part.empty() && part != ".")
            split.parts.push_back(part);
        part.clear();
    };
    split.is_absolute = split.is_absolute || name.starts_with('/') || name.starts_with('\\');
    for (const char letter : name) {
        if (letter == '/' || letter == '\\')
            end_part();
        else
            part += letter;
    }
    end_part();
    return split;
}

} // namespace

bool FileFinder::is_usable_file(const std::filesystem::path& path) const
{
    // Within a limited scope the file is opened, so that nothing is learnt about files behind links.
    const int file = open_to_read(path, scope_, O_PATH);
    if (file < 0)
        return false;

    struct stat status {};

    const bool is_known = fstat(file, &status) == 0;
    close(file);
    return is_known && S_ISREG(status.st_mode) && status.st_size > 0;
}

FileFinder::FileFinder(const std::vector<std::filesystem::path>& folders, ReadScope scope)
    : scope_(std::move(scope))
{
    for (const std::filesystem::path& folder : folders)
        add_folder(folder);
}

void FileFinder::add_folder(const std::filesystem::path& folder)
{
    const std::filesystem::path named = folder.empty() ? std::filesystem::path(".") : folder;
    if (std::find(folders_.begin(), folders_.end(), named) == folders_.end())
        folders_.push_back(named);
}

std::optional<std::filesystem::path> FileFinder::find(std::string_view name)
{
    name = trimmed(name, " \t\r\n\"'");
    if (name.empty() || name.size() > longest_name || name.find('\0') != std::string_view::npos)
        return std::nullopt;
    if (std::optional<std::filesystem::path> found = find_spelled(name))
        return found;
    const std::string decoded = percent_decoded(name);
    if (decoded == name || decoded.find('\0') != std::string::npos)
        return std::nullopt;
    return find_spelled(decoded);
}

std::optional<std::filesystem::path> FileFinder::find_spelled(std::string_view name)
{
    const SplitPath path = split(name);
    if (scope_.is_limited() && leads_upwards(name))
        fail_outside(name, scope_, std::string(name));
    if (path.parts.empty() || path.parts.back() == "..")
        return std::nullopt;
    const size_t count = path.parts.size();
    // Searches every folder for the full path first, then for shorter and shorter ends of the path. A short
    // end may match a wrong file.
    for (size_t first = count > most_parts ? count - most_parts : 0; first < count; ++first) {
        // An end of an absolute path is searched for only below the folders.
        const auto end = path.parts.begin() + static_cast<std::ptrdiff_t>(first);
        if (path.is_absolute && std::find(end, path.parts.end(), "..") != path.parts.end())
            continue;
        for (const std::filesystem::path& folder : folders_)
            if (std::optional<std::filesystem::path> found = resolve(folder, path.parts, first))
                return found;
    }
    return std::nullopt;
}

std::optional<std::filesystem::path> FileFinder::resolve(const std::filesystem::path& folder,
                                                         const Names& parts, size_t first)
{
    std::filesystem::path exact = folder;
    for (size_t i = first; i < parts.size(); ++i)
        exact /= parts[i];
    if (is_usable_file(exact))
        return exact;
    std::filesystem::path found = folder;
    for (size_t i = first; i < parts.size(); ++i) {
        const std::optional<std::string> name = parts[i] == ".." ? parts[i] : actual_name(found, parts[i]);
        if (!name)
            return std::nullopt;
        found /= *name;
    }
    return is_usable_file(found) ? std::optional(found) : std::nullopt;
}

std::optional<std::string> FileFinder::actual_name(const std::filesystem::path& folder,
                                                   const std::string& name)
{
    const auto [listing, is_new] = listings_.try_emplace(folder);
    if (is_new) {
        std::error_code failed;
        // A folder behind a link is not listed, so that its names are not revealed.
        const int opened = open_to_read(folder, scope_, O_PATH | O_DIRECTORY);
        if (opened < 0)
            return std::nullopt;
        close(opened);
        std::filesystem::directory_iterator entries(folder, failed);
        for (size_t count = 0;
             !failed && entries != std::filesystem::directory_iterator() && count < most_listed; ++count) {
            const std::string entry = entries->path().filename().string();
            // If names differ only in case, the first name in byte order is used. The result then does not
            // depend on the order in which the disk lists files.
            const auto [known, is_first] = listing->second.try_emplace(lower_case(entry), entry);
            if (!is_first)
                known->second = std::min(known->second, entry);
            entries.increment(failed);
        }
    }
    std::error_code failed;
    if (std::filesystem::exists(folder / name, failed) && !failed)
        return name;
    const auto found = listing->second.find(lower_case(name));
    return found == listing->second.end() ? std::nullopt : std::optional(found->second);
}

namespace {

/// Finds a file. If it is missing, adds its name to the scene's missing files and throws Error.
std::filesystem::path found_file(const std::string& name, FileFinder& finder, Scene& scene)
{
    std::optional<std::filesystem::path> file = finder.find(name);
    if (!file) {
        scene.missing_files.push_back(name);
        throw Error("no such file", name, "put the picture beside the scene's file");
    }
    return *std::move(file);
}

} // namespace

void load_pictures(Scene& scene, const std::vector<ImageSource>& sources, FileFinder& finder)
{
    std::map<std::filesystem::path, size_t> texture_of_file;
    for (size_t i = 0; i < sources.size(); ++i) {
        Image& image = scene.textures[i].image;
        if (image.rgba.size() == size_t{4} * image.width * image.height && !image.empty())
            continue;
        try {
            if (!sources[i].bytes.empty()) {
                image = decode_image(sources[i].bytes, sources[i].file);
                continue;
            }
            const std::filesystem::path file = found_file(sources[i].file, finder, scene);
            const auto [known, is_new] = texture_of_file.emplace(file, i);
            if (is_new)
                scene.files.push_back(file);
            image = is_new ? read_image(file, finder.scope()) : scene.textures[known->second].image;
        } catch (const OutsideScope&) {
            throw;
        } catch (const Error& error) {
            scene.warnings.push_back(fmt::format("texture left white: {}", error.what()));
            image = {.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
        }
    }
}

} // namespace estampe
