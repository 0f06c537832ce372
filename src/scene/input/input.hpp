// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace estampe {

/// A file that is read from front to back, by lines or by bytes, through a buffer of a few hundred kilobytes,
/// so that a reader never holds the whole file.
///
/// Lines end with LF, CR LF or CR, mixed at will. Text may be UTF-8, with or without a byte order mark, or
/// UTF-16 with one (or plainly of it), which arrives as UTF-8.
class Input {
public:
    /// Opens a regular file. Throws Error naming it when it is missing, empty, a folder, a pipe or a device.
    explicit Input(const std::filesystem::path& path);

    /// Reads from memory, which must outlive the input; `name` is for messages.
    Input(std::span<const std::byte> bytes, std::string name);

    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;
    ~Input();

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Bytes of the whole file.
    [[nodiscard]] uint64_t size() const { return size_; }

    /// Bytes of the file behind the current place; not valid in UTF-16.
    [[nodiscard]] uint64_t bytes_left() const { return size_ - offset_ + buffered(); }

    /// Looks at the first bytes for a byte order mark or UTF-16. Call it before anything is read.
    void detect_encoding();

    /// The bytes at the current place: at least `wanted` of them, unless the file ends before. Valid until
    /// the next call. The buffer grows to what is wanted, and no further than the file.
    [[nodiscard]] std::string_view peek(size_t wanted);

    /// Goes on by `count` bytes that peek() has shown.
    void skip(size_t count) { first_ += count; }

    /// The next line without its end; false when there is none. Valid until the next call.
    [[nodiscard]] bool next_line(std::string_view& line);

    /// Number of the line that next_line() gave last, from 1.
    [[nodiscard]] uint64_t line_number() const { return line_number_; }

    /// Whether the line that next_line() gave last had a line end: it may be cut off otherwise.
    [[nodiscard]] bool line_was_ended() const { return line_was_ended_; }

    /// "file:line" of the line that next_line() gave last.
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
    uint64_t offset_ = 0; ///< of the next byte that comes into the buffer
    int descriptor_ = -1;
    std::span<const std::byte> memory_;
    Encoding encoding_ = Encoding::bytes;
    std::vector<char> buffer_;
    size_t first_ = 0; ///< of what is not consumed yet
    size_t last_ = 0;
    size_t next_lf_ = 0; ///< no LF lies between first_ and here; so for CR
    size_t next_cr_ = 0;
    uint32_t high_surrogate_ = 0;
    uint64_t line_number_ = 0;
    bool line_was_ended_ = true;
};

} // namespace estampe
