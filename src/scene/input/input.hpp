// SPDX-License-Identifier: MIT
#pragma once

// Input of the OBJ, PLY and STL readers: reading a file by lines or bytes, splitting a line into words, and
// choosing an origin for coordinates that are far from zero.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe {

/// Parses a number in any form that 3D files use. Accepts all forms of std::from_chars, and also numbers with
/// a leading plus, with a decimal comma, or beyond the range of doubles. Returns NaN for any other word.
[[nodiscard]] double number_of_word(std::string_view word);

/// Splits a line into words at blanks. Functions are inline for speed, because a file has millions of words.
class Scanner {
public:
    explicit Scanner(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

    /// Returns whether the rest of the line is empty or blank.
    [[nodiscard]] bool is_done()
    {
        skip_blanks();
        return at_ == end_;
    }

    /// Returns the next word of the line; empty at the end of the line.
    [[nodiscard]] std::string_view word()
    {
        skip_blanks();
        const char* const begin = at_;
        while (at_ != end_ && !is_blank(*at_))
            ++at_;
        return {begin, static_cast<size_t>(at_ - begin)};
    }

    /// Reads the next word as a number, or as NaN if it is not a number; returns false at the end of the
    /// line.
    [[nodiscard]] bool number(double& value)
    {
        skip_blanks();
        if (at_ == end_)
            return false;
        if (!plain_decimal(value))
            value = number_of_word(word());
        return true;
    }

    /// Returns the rest of the line, without blanks before and after it.
    [[nodiscard]] std::string_view rest()
    {
        skip_blanks();
        const char* last = end_;
        while (last != at_ && is_blank(last[-1]))
            --last;
        return {at_, static_cast<size_t>(last - at_)};
    }

    static bool is_blank(char letter)
    {
        return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
    }

private:
    void skip_blanks()
    {
        while (at_ != end_ && is_blank(*at_))
            ++at_;
    }

    /// Reads a decimal number of up to fifteen digits with an optional point. The digits and the power of ten
    /// are exact doubles. Their quotient is rounded only once, so it equals the result of std::from_chars
    /// (Clinger 1990). If the word has another form, the position in the line is not changed.
    bool plain_decimal(double& value)
    {
        static constexpr std::array<double, 16> powers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                       1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
        const char* at = at_;
        const bool is_negative = *at == '-';
        at += is_negative ? 1 : 0;
        uint64_t digits = 0;
        const char* const begin = at;
        const auto read_digits = [&] {
            for (; at != end_ && *at >= '0' && *at <= '9' && at - begin < 17; ++at)
                digits = 10 * digits + static_cast<uint64_t>(*at - '0');
        };
        read_digits();
        const std::ptrdiff_t before_point = at - begin;
        std::ptrdiff_t behind_point = 0;
        if (at != end_ && *at == '.') {
            ++at;
            const char* const point = at;
            read_digits();
            behind_point = at - point;
        }
        const std::ptrdiff_t count = before_point + behind_point;
        if (count == 0 || count > 15 || (at != end_ && !is_blank(*at)))
            return false;
        const double size = static_cast<double>(digits) / powers[static_cast<size_t>(behind_point)];
        value = is_negative ? -size : size;
        at_ = at;
        return true;
    }

    const char* at_;
    const char* end_;
};

/// Reads a file sequentially, by lines or by bytes. A buffer of a few hundred kilobytes is enough, so that
/// the whole file is never in memory.
///
/// Lines may end with LF, CR LF or CR, also mixed in one file. Text may be UTF-8 with or without a byte order
/// mark, or UTF-16, which is detected by its byte order mark or its content. next_line() always returns
/// UTF-8.
class Input {
public:
    /// Opens a regular file. Throws Error naming the file when it is missing, empty, a folder, a pipe or a
    /// device, or lies outside of `scope`.
    explicit Input(const std::filesystem::path& path, const ReadScope& scope = {});

    /// Reads from `bytes`, which must outlive this object. `name` is the name of the file in messages.
    Input(std::span<const std::byte> bytes, std::string name);

    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;
    ~Input();

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Returns the size of the whole file in bytes.
    [[nodiscard]] uint64_t size() const { return size_; }

    /// Returns the number of bytes from the current position to the end of the file. Not valid in UTF-16.
    [[nodiscard]] uint64_t bytes_left() const { return size_ - offset_ + buffered(); }

    /// Detects a byte order mark or UTF-16 in the first bytes. Call this before reading anything.
    void detect_encoding();

    /// Returns the bytes at the current position: at least `wanted` of them, unless the file ends earlier.
    /// The result is valid until the next call. The buffer grows to `wanted`, but never beyond the size of
    /// the file.
    [[nodiscard]] std::string_view peek(size_t wanted);

    /// Advances by `count` bytes that peek() has returned.
    void skip(size_t count) { first_ += count; }

    /// Reads the next line without its line end. Returns false at the end of the file. `line` is valid until
    /// the next call.
    [[nodiscard]] bool next_line(std::string_view& line);

    /// Returns the number of the line that next_line() returned last, counted from 1.
    [[nodiscard]] uint64_t line_number() const { return line_number_; }

    /// Returns whether the line that next_line() returned last had a line end. A line without a line end may
    /// be truncated.
    [[nodiscard]] bool line_was_ended() const { return line_was_ended_; }

    /// Returns the place of the line that next_line() returned last, for messages: "file:line".
    [[nodiscard]] std::string place() const;

private:
    enum class Encoding : uint8_t { bytes, utf16_le, utf16_be };

    [[nodiscard]] size_t buffered() const { return last_ - first_; }

    [[nodiscard]] size_t read_raw(char* to, size_t count);
    void make_room(size_t count);
    void fill(size_t count);
    void fill_from_utf16();
    void put_utf8(uint32_t code_point);
    [[nodiscard]] size_t end_of_line();

    std::string name_;
    uint64_t size_ = 0;
    uint64_t offset_ = 0; ///< offset in the file of the next byte to read into the buffer
    int descriptor_ = -1;
    std::span<const std::byte> memory_;
    Encoding encoding_ = Encoding::bytes;
    std::vector<char> buffer_;
    size_t first_ = 0; ///< offset in the buffer of the first byte that has not been read yet
    size_t last_ = 0;
    size_t next_lf_ = 0; ///< offset before which there is no LF after first_; next_cr_ is the same for CR
    size_t next_cr_ = 0;
    uint32_t high_surrogate_ = 0;
    uint64_t line_number_ = 0;
    bool line_was_ended_ = true;
};

/// Returns the origin that is subtracted from all coordinates of a file before they are rounded to floats. If
/// the distance of the coordinates from zero is more than sixteen times their extent, the origin is an
/// integer point near their centre. For coordinates nearer to zero, the origin is zero, because floats then
/// still resolve a millionth of the extent.
[[nodiscard]] glm::dvec3 file_origin(const Bounds& bounds);

/// Returns the origin that is subtracted from the coordinates of one object. The origin is that of the whole
/// file, `file`, unless the object is tiny compared with its distance from `file`.
[[nodiscard]] glm::dvec3 object_origin(const Bounds& bounds, const glm::dvec3& file);

/// Returns whether a position can be drawn: its coordinates are finite, and their squares fit into floats.
[[nodiscard]] bool is_usable(const glm::dvec3& position);

} // namespace estampe
