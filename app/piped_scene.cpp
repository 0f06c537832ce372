// SPDX-License-Identifier: MIT
#include "piped_scene.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/descriptor.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "scene/input/input.hpp"

namespace estampe::app {
namespace {

/// Number of bytes that suffice to detect a scene's format; comments at the beginning of a text file may be
/// long.
constexpr size_t sniffed_bytes = size_t{1} << 16U;

bool is_binary_stl(std::string_view beginning, uint64_t size_bytes)
{
    constexpr size_t head_bytes = 84;
    constexpr uint64_t triangle_bytes = 50;
    uint32_t triangles = 0;
    if (beginning.size() < head_bytes) {
        return false;
    }
    std::memcpy(&triangles, beginning.data() + head_bytes - sizeof(triangles), sizeof(triangles));
    return size_bytes == head_bytes + triangle_bytes * triangles;
}

/// Returns whether an OBJ file may begin with this statement. If other formats also begin with the line's
/// first word, the rest of the line must match OBJ too.
bool is_obj_statement(Scanner line)
{
    constexpr std::array<std::string_view, 6> with_numbers{"v", "vn", "vt", "vp", "f", "s"};
    constexpr std::array<std::string_view, 4> with_names{"mtllib", "usemtl", "o", "g"};
    const std::string_view word = line.word();
    if (std::ranges::find(with_names, word) != with_names.end()) {
        return true;
    }
    if (std::ranges::find(with_numbers, word) == with_numbers.end()) {
        return false;
    }
    const std::string_view first = line.word();
    const bool is_number = std::isfinite(number_of_word(first.substr(0, first.find('/'))));
    return is_number || (word == "s" && first == "off");
}

bool is_blank_or_comment(Scanner line)
{
    return line.is_done() || line.word().starts_with('#');
}

/// Returns whether the text after the first line is that of an STL text file. The word "solid" alone is not
/// enough, because many binary STL files also begin with "solid".
bool is_rest_of_stl(const std::string& text)
{
    constexpr std::array<std::string_view, 3> words{"facet", "vertex", "endsolid"};
    return text.find('\0') == std::string::npos && std::ranges::any_of(words, [&](std::string_view word) {
               return text.find(word) != std::string::npos;
           });
}

/// Detects the format of a scene in line-based text.
std::string_view text_format(std::string_view beginning)
{
    Input input(std::as_bytes(std::span(beginning)), {});
    input.detect_encoding();
    std::string_view line;
    do {
        if (!input.next_line(line)) {
            return {};
        }
    } while (is_blank_or_comment(Scanner(line)));
    const std::string first = lower_case(Scanner(line).word());
    if (first == "ply") {
        return "ply";
    }
    if (first.starts_with("solid") || first.starts_with("facet")) {
        return is_rest_of_stl(lower_case(input.peek(sniffed_bytes))) ? "stl" : "";
    }
    return is_obj_statement(Scanner(line)) ? "obj" : "";
}

} // namespace

std::string_view sniffed_format(std::string_view beginning, uint64_t size_bytes)
{
    const auto holds = [&](std::string_view word) { return beginning.find(word) != std::string_view::npos; };
    if (beginning.starts_with("glTF")) {
        return "glb";
    }
    if (beginning.starts_with("Kaydara FBX Binary") || beginning.starts_with("; FBX")) {
        return "fbx";
    }
    if (is_binary_stl(beginning, size_bytes)) {
        return "stl";
    }
    const size_t first = beginning.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    const std::string_view text = first == std::string_view::npos ? "" : beginning.substr(first);
    if (text.starts_with('{')) {
        return "gltf";
    }
    if (text.starts_with('<')) {
        return holds("<COLLADA") ? "dae" : "";
    }
    return text_format(beginning);
}

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> formats{"glb", "gltf", "obj", "ply", "stl", "fbx", "dae"};

std::string name_of(const std::string& scene)
{
    return scene == standard_input ? "standard input" : scene;
}

[[noreturn]] void fail(const std::string& what, const std::string& scene, const std::string& remedy = {})
{
    throw Error(what, name_of(scene), remedy);
}

/// Reads the next bytes of the pipe into `buffer` and returns their number; returns 0 at the end of the pipe.
size_t read_some(int from, std::span<char> buffer, const std::string& scene)
{
    for (;;) {
        const ssize_t count = read(from, buffer.data(), buffer.size());
        if (count >= 0) {
            return static_cast<size_t>(count);
        }
        if (errno != EINTR) {
            fail(fmt::format("cannot be read: {}", std::strerror(errno)), scene);
        }
    }
}

void write_all(int to, std::string_view bytes, const fs::path& file)
{
    while (!bytes.empty()) {
        const ssize_t count = write(to, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) {
            throw Error(fmt::format("cannot be written: {}", std::strerror(errno)), file.string(),
                        "TMPDIR names the folder for temporary files");
        }
        bytes.remove_prefix(count > 0 ? static_cast<size_t>(count) : 0);
    }
}

/// List of the temporary folders that currently exist.
struct Folders {
    std::mutex guard;
    std::set<fs::path> paths;
};

Folders& folders()
{
    static Folders folders;
    return folders;
}

/// A temporary folder for piped scenes, removed by the destructor.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string name = (fs::temp_directory_path() / "estampe-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw Error(fmt::format("cannot be made: {}", std::strerror(errno)), name,
                        "TMPDIR names the folder for temporary files");
        }
        path_ = name;
        const std::lock_guard lock(folders().guard);
        folders().paths.insert(path_);
    }

    ~TemporaryFolder()
    {
        const std::lock_guard lock(folders().guard);
        std::error_code problem;
        // Removes links that lie in the folder, not the files to which they point.
        fs::remove_all(path_, problem);
        folders().paths.erase(path_);
    }

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// A piped scene that was read to its end.
struct Received {
    TemporaryFolder folder;
    fs::path file;
};

/// Creates links to all files of the current folder in `folder`, so that textures beside the piped scene are
/// found.
void link_current_folder(const fs::path& folder)
{
    constexpr size_t most_links = 20000;
    std::error_code problem;
    size_t count = 0;
    const fs::path current = fs::current_path(problem);
    for (fs::directory_iterator entry(current, problem); !problem && entry != fs::directory_iterator();
         entry.increment(problem)) {
        std::error_code taken;
        fs::create_symlink(entry->path(), folder / entry->path().filename(), taken);
        if (++count == most_links) {
            return;
        }
    }
}

/// The beginning of a piped scene, long enough to detect its format.
struct Beginning {
    std::string text;
    uint64_t size_bytes = 0; ///< Size of the whole scene in bytes
};

Beginning copy_to(int from, const fs::path& file, const std::string& scene, uint64_t most_bytes)
{
    constexpr mode_t for_owner = 0600;
    const Descriptor to(open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, for_owner));
    std::vector<char> buffer(size_t{1} << 20U);
    Beginning beginning;
    for (size_t count = read_some(from, buffer, scene); count > 0; count = read_some(from, buffer, scene)) {
        beginning.size_bytes += count;
        if (beginning.size_bytes > most_bytes) {
            fail(fmt::format("is longer than {} MiB", most_bytes >> 20U), scene,
                 "save the scene as a file, and give its name");
        }
        const std::string_view bytes(buffer.data(), count);
        beginning.text += bytes.substr(0, sniffed_bytes - std::min(sniffed_bytes, beginning.text.size()));
        write_all(to.number(), bytes, file);
    }
    return beginning;
}

/// Returns the format that the file name of a named pipe suggests; empty if it suggests none.
std::string format_of_name(const std::string& scene)
{
    const std::string extension = lower_extension(scene);
    const bool is_known =
        !extension.empty() && std::ranges::find(formats, extension.substr(1)) != formats.end();
    return is_known ? extension.substr(1) : std::string();
}

std::unique_ptr<Received> receive(const std::string& scene, const std::string& format, uint64_t most_bytes,
                                  BesidePipe beside)
{
    const Descriptor from(scene == standard_input ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                                                  : open(scene.c_str(), O_RDONLY | O_CLOEXEC));
    if (from.number() < 0) {
        fail(fmt::format("cannot be read: {}", std::strerror(errno)), scene);
    }
    if (isatty(from.number()) == 1) {
        fail("is a terminal", scene, "send a scene into it, such as estampe render - -o a.png <scene.glb");
    }
    auto received = std::make_unique<Received>();
    const fs::path raw = received->folder.path() / "piped";
    const Beginning beginning = copy_to(from.number(), raw, scene, most_bytes);
    if (beginning.size_bytes == 0) {
        fail("is empty", scene, "what sends the scene has failed, or sent nothing");
    }
    std::string chosen = format.empty() ? format_of_name(scene) : format;
    if (chosen.empty()) {
        chosen = sniffed_format(beginning.text, beginning.size_bytes);
    }
    if (chosen.empty()) {
        fail("does not tell its format", scene,
             fmt::format("give --input-format, one of {}", fmt::join(formats, ", ")));
    }
    received->file = received->folder.path() / ("piped." + chosen);
    fs::rename(raw, received->file);
    if (beside == BesidePipe::current_folder) {
        link_current_folder(received->folder.path());
    }
    return received;
}

/// All piped scenes that this run has received, by the name that the user typed.
struct Memory {
    std::mutex guard;
    std::map<std::string, std::unique_ptr<Received>> scenes;
};

Memory& memory()
{
    folders(); // Constructed first, so that the folders are destroyed after the memory that depends on them
    static Memory memory;
    return memory;
}

} // namespace

std::span<const std::string_view> input_formats()
{
    return formats;
}

bool is_piped(const std::string& scene)
{
    // Names such as /dev/stdin count as pipes, whatever they refer to.
    if (scene == standard_input || scene.starts_with("/dev/")) {
        return true;
    }
    struct stat facts = {};
    return stat(scene.c_str(), &facts) == 0 &&
           (S_ISFIFO(facts.st_mode) || S_ISCHR(facts.st_mode) || S_ISSOCK(facts.st_mode));
}

fs::path scene_file(const std::string& scene, const std::string& format, uint64_t most_bytes,
                    BesidePipe beside)
{
    if (!is_piped(scene)) {
        if (!format.empty() && !scene.empty() && fs::exists(scene)) {
            throw Error("--input-format is for scenes that come through a pipe", scene,
                        "the extension of a file's name tells its format");
        }
        return scene;
    }
    const std::lock_guard lock(memory().guard);
    std::unique_ptr<Received>& received = memory().scenes[scene];
    if (!received) {
        received = receive(scene, format, most_bytes, beside);
    }
    return received->file;
}

std::string with_typed_name(std::string text, const std::string& scene, const fs::path& file)
{
    if (file.empty() || file == scene) {
        return text;
    }
    replace_all(text, file.string(), name_of(scene));
    // Messages show file names as the scene writes them.
    replace_all(text, file.parent_path().string() + '/', "");
    replace_all(text, "beside the scene's file", "into the current folder");
    return text;
}

std::string missing_beside_pipe(const std::vector<std::string>& files, const std::string& scene)
{
    return fmt::format(
        "{}: a scene from a pipe has no folder of its own: {}{} looked for in the current folder",
        name_of(scene), shortened(files.front()),
        files.size() == 1 ? " was" : fmt::format(" and {} more were", files.size() - 1));
}

void remove_piped_scenes()
{
    // The function does not lock the list of received scenes. Another thread may hold the lock for as long as
    // the other thread waits for a pipe.
    const std::lock_guard lock(folders().guard);
    for (const fs::path& path : folders().paths) {
        std::error_code problem;
        fs::remove_all(path, problem);
    }
}

} // namespace estampe::app
