// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/tree.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/text.hpp"

namespace estampe::fbx {
namespace {

constexpr std::string_view binary_magic("Kaydara FBX Binary  \0\x1a\0", 23);
constexpr size_t binary_head_bytes = 27;
constexpr uint32_t version_of_wide_offsets = 7500; ///< offsets have 64 bits from this version on
constexpr int deepest = 24;

[[noreturn]] void damaged(size_t at, const char* what)
{
    throw Error(fmt::format("is damaged at byte {}: {}", at, what));
}

/// Returns whether an element is stored in the tree. The result depends on the element's name, depth and
/// parent.
bool is_kept(int depth, std::string_view parent, std::string_view name)
{
    constexpr std::array<std::string_view, 5> sections{"FBXHeaderExtension", "GlobalSettings", "Definitions",
                                                       "Objects", "Connections"};
    constexpr std::array<std::string_view, 3> objects{"Model", "NodeAttribute", "AnimationStack"};
    if (depth == 0)
        return std::find(sections.begin(), sections.end(), name) != sections.end();
    if (depth == 1 && parent == "Objects")
        return std::find(objects.begin(), objects.end(), name) != objects.end();
    return true;
}

bool is_binary(std::span<const char> file)
{
    return file.size() >= binary_head_bytes &&
           std::string_view(file.data(), binary_magic.size()) == binary_magic;
}

template <typename Number>
Number little_endian(std::span<const char> file, size_t at)
{
    Number number{};
    std::memcpy(&number, file.data() + at, sizeof number);
    return number;
}

class BinaryReader {
public:
    explicit BinaryReader(std::span<const char> file)
        : file_(file), wide_(little_endian<uint32_t>(file, binary_magic.size()) >= version_of_wide_offsets)
    {
    }

    std::vector<Element> read() { return elements(binary_head_bytes, file_.size(), 0, "").first; }

private:
    struct Head {
        uint64_t end = 0;
        uint64_t values = 0;
        uint64_t value_bytes = 0;
        size_t name_bytes = 0;
        size_t bytes = 0;
    };

    void need(size_t at, uint64_t bytes, size_t end) const
    {
        if (at > end || bytes > end - at)
            damaged(at, "an element ends too early");
    }

    Head head(size_t at, size_t end) const
    {
        Head head;
        const size_t word = wide_ ? 8 : 4;
        head.bytes = 3 * word + 1;
        need(at, head.bytes, end);
        const auto number = [&](size_t index) -> uint64_t {
            return wide_ ? little_endian<uint64_t>(file_, at + 8 * index)
                         : little_endian<uint32_t>(file_, at + 4 * index);
        };
        head.end = number(0);
        head.values = number(1);
        head.value_bytes = number(2);
        head.name_bytes = static_cast<uint8_t>(file_[at + 3 * word]);
        return head;
    }

    /// Reads a list of elements from `at` on, up to the empty element that ends the list. Also returns the
    /// offset after the list.
    std::pair<std::vector<Element>, size_t> elements(size_t at, size_t end, int depth,
                                                     const std::string& parent) const
    {
        if (depth > deepest)
            damaged(at, "elements are nested too deeply");
        std::vector<Element> list;
        while (at < end) {
            const Head next = head(at, end);
            if (next.end == 0)
                return {std::move(list), at + next.bytes};
            const size_t values_at = at + next.bytes + next.name_bytes;
            if (next.end <= at || next.end > end)
                damaged(at, "an element ends outside of its parent");
            need(values_at, next.value_bytes, next.end);
            Element element;
            element.name.assign(file_.data() + at + next.bytes, next.name_bytes);
            if (is_kept(depth, parent, element.name)) {
                const size_t children_at = values_at + next.value_bytes;
                read_values(element, next.values, values_at, children_at);
                element.children = elements(children_at, next.end, depth + 1, element.name).first;
                list.push_back(std::move(element));
            }
            at = next.end;
        }
        return {std::move(list), at};
    }

    void read_values(Element& element, uint64_t count, size_t at, size_t end) const
    {
        for (uint64_t i = 0; i < count; ++i) {
            need(at, 1, end);
            at = read_value(element, file_[at], at + 1, end);
        }
    }

    template <typename Number, typename Kept>
    size_t take(Element& element, size_t at, size_t end) const
    {
        need(at, sizeof(Number), end);
        element.values.emplace_back(static_cast<Kept>(little_endian<Number>(file_, at)));
        return at + sizeof(Number);
    }

    size_t read_value(Element& element, char type, size_t at, size_t end) const
    {
        switch (type) {
        case 'C':
        case 'B':
            return take<int8_t, int64_t>(element, at, end);
        case 'Y':
            return take<int16_t, int64_t>(element, at, end);
        case 'I':
            return take<int32_t, int64_t>(element, at, end);
        case 'L':
            return take<int64_t, int64_t>(element, at, end);
        case 'F':
            return take<float, double>(element, at, end);
        case 'D':
            return take<double, double>(element, at, end);
        case 'S':
        case 'R': {
            need(at, 4, end);
            const auto bytes = little_endian<uint32_t>(file_, at);
            need(at + 4, bytes, end);
            if (type == 'S')
                keep_text(element, at + 4, bytes);
            return at + 4 + bytes;
        }
        default:
            return skip_array(type, at, end);
        }
    }

    void keep_text(Element& element, size_t at, size_t bytes) const
    {
        if (element.first_text_at == 0)
            element.first_text_at = at;
        element.values.emplace_back(std::string(file_.data() + at, bytes));
    }

    size_t skip_array(char type, size_t at, size_t end) const
    {
        const uint64_t each = type == 'd' || type == 'l'                  ? 8
                              : type == 'f' || type == 'i'                ? 4
                              : type == 'b' || type == 'c' || type == 'h' ? 1
                                                                          : 0;
        if (each == 0)
            damaged(at, "a value has an unknown type");
        need(at, 12, end);
        const auto count = little_endian<uint32_t>(file_, at);
        const auto encoding = little_endian<uint32_t>(file_, at + 4);
        const uint64_t bytes = encoding == 0 ? each * count : little_endian<uint32_t>(file_, at + 8);
        need(at + 12, bytes, end);
        return at + 12 + bytes;
    }

    std::span<const char> file_;
    bool wide_;
};

bool is_blank(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

Value value_of_word(std::string_view word)
{
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    if (const auto whole = number_from<int64_t>(digits))
        return *whole;
    if (const auto number = number_from<double>(digits))
        return *number;
    return std::string(word);
}

class TextReader {
public:
    explicit TextReader(std::span<const char> file) : text_(file.data(), file.size()) {}

    std::vector<Element> read() { return elements(0, "", true); }

private:
    [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }

    /// Skips blanks and comments: within the current line, or also across line ends if `across_lines` is set.
    void skip(bool across_lines)
    {
        while (!at_end()) {
            const char letter = text_[at_];
            if (letter == ';')
                at_ = std::min(text_.find('\n', at_), text_.size());
            else if (is_blank(letter) && (across_lines || letter != '\n'))
                ++at_;
            else
                return;
        }
    }

    std::vector<Element> elements(int depth, const std::string& parent, bool kept)
    {
        if (depth > deepest)
            damaged(at_, "elements are nested too deeply");
        std::vector<Element> list;
        while (true) {
            skip(true);
            if (at_end()) {
                if (depth > 0)
                    damaged(at_, "a brace is not closed");
                return list;
            }
            if (text_[at_] == '}') {
                ++at_;
                return list;
            }
            Element element;
            element.name = name();
            const bool keep = kept && is_kept(depth, parent, element.name);
            values(element, keep);
            if (!at_end() && text_[at_] == '{') {
                ++at_;
                element.children = elements(depth + 1, element.name, keep);
            }
            if (keep)
                list.push_back(std::move(element));
        }
    }

    std::string name()
    {
        const size_t first = at_;
        at_ = std::min(text_.find_first_of(":\n{}\"", at_), text_.size());
        if (at_end() || text_[at_] != ':')
            damaged(first, "an element has no name");
        ++at_;
        return std::string(text_.substr(first, at_ - 1 - first));
    }

    void values(Element& element, bool keep)
    {
        bool goes_on = false;
        while (true) {
            skip(goes_on);
            if (at_end() || text_[at_] == '\n' || text_[at_] == '{' || text_[at_] == '}')
                return;
            if (text_[at_] == ',') {
                ++at_;
                goes_on = true;
                continue;
            }
            goes_on = false;
            if (text_[at_] == '"')
                text(element, keep);
            else
                word(element, keep);
        }
    }

    void text(Element& element, bool keep)
    {
        const size_t first = at_ + 1;
        const size_t last = text_.find('"', first);
        if (last == std::string_view::npos)
            damaged(at_, "a text is not closed");
        at_ = last + 1;
        if (!keep)
            return;
        if (element.first_text_at == 0)
            element.first_text_at = first;
        element.values.emplace_back(std::string(text_.substr(first, last - first)));
    }

    void word(Element& element, bool keep)
    {
        const size_t first = at_;
        at_ = std::min(text_.find_first_of(" \t\r\n,;{}\"", at_), text_.size());
        const std::string_view found = text_.substr(first, at_ - first);
        if (keep && !found.starts_with('*')) // a star precedes the length of an array
            element.values.push_back(value_of_word(found));
    }

    std::string_view text_;
    size_t at_ = 0;
};

} // namespace

uint32_t file_version(std::span<const char> head)
{
    if (is_binary(head))
        return little_endian<uint32_t>(head, binary_magic.size());
    const std::string_view text(head.data(), head.size());
    constexpr std::string_view key = "FBXVersion:";
    if (const size_t found = text.find(key); found != std::string_view::npos) {
        const size_t digits = std::min(text.find_first_not_of(" \t", found + key.size()), text.size());
        uint32_t version = 0;
        if (std::from_chars(text.data() + digits, text.data() + text.size(), version).ec == std::errc{})
            return version;
    }
    // A text file may begin with a comment line such as "; FBX 6.1.0 project file".
    constexpr std::string_view comment = "; FBX ";
    if (const size_t found = text.find(comment);
        found != std::string_view::npos && text.size() >= found + 9) {
        const char major = text[found + 6];
        const char minor = text[found + 8];
        if (major >= '1' && major <= '9' && text[found + 7] == '.' && minor >= '0' && minor <= '9')
            return static_cast<uint32_t>(major - '0') * 1000 + static_cast<uint32_t>(minor - '0') * 100;
    }
    return 0;
}

Tree read_tree(std::span<const char> file)
{
    Tree tree;
    tree.version = file_version(file.first(std::min<size_t>(file.size(), 8192)));
    tree.elements = is_binary(file) ? BinaryReader(file).read() : TextReader(file).read();
    return tree;
}

void check_version(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint32_t oldest = 7100;
    constexpr uint64_t head_bytes = 8192;
    const std::vector<std::byte> head = read_file_start(path, head_bytes, scope);
    const uint32_t version = file_version({reinterpret_cast<const char*>(head.data()), head.size()});
    if (version == 0 || version >= oldest)
        return;
    throw Error(fmt::format("is FBX {}.{}, a version of 2010 or before; FBX 7.1 (2011) and later are read",
                            version / 1000, version / 100 % 10),
                path.string(),
                "convert it with Autodesk's FBX Converter, or export it again from its program");
}

} // namespace estampe::fbx
