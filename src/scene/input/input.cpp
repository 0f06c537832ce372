// SPDX-License-Identifier: MIT
#include "scene/input/input.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/long_jobs.hpp"
#include "core/read_scope.hpp"

namespace estampe {

double number_of_word(std::string_view word)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = nan;
    const char* const end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc::result_out_of_range && stopped == end) {
        const bool is_tiny = word.find("e-") != std::string_view::npos ||
                             word.find("E-") != std::string_view::npos ||
                             word.find_first_of("eE") == std::string_view::npos;
        return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
    }
    if (error == std::errc() && stopped == end)
        return value;
    // Programs with a localised number format may write a decimal comma.
    const size_t comma = word.find(',');
    if (comma == std::string_view::npos || comma + 1 == word.size() ||
        word.find('.') != std::string_view::npos)
        return nan;
    std::string with_point(word);
    with_point[comma] = '.';
    return with_point.find(',') == std::string::npos ? number_of_word(with_point) : nan;
}

namespace {

constexpr size_t block_bytes = size_t{1} << 18;
constexpr uint32_t replacement = 0xFFFD; ///< Unicode replacement character for invalid characters

} // namespace

Input::Input(const std::filesystem::path& path, const ReadScope& scope) : name_(path.string())
{
    descriptor_ = open_to_read(path, scope, O_RDONLY | O_NONBLOCK);
    if (descriptor_ < 0) {
        const int reason = errno;
        throw Error(reason == ENOENT
                        ? std::string("no such file")
                        : fmt::format("cannot open: {}", std::generic_category().message(reason)),
                    name_, "check the path");
    }

    struct stat status {};

    const bool is_file = fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
    if (!is_file || status.st_size == 0) {
        close(descriptor_);
        throw Error(is_file ? "is empty" : "is not a file", name_, "give the path of a scene file");
    }
    size_ = static_cast<uint64_t>(status.st_size);
}

Input::Input(std::span<const std::byte> bytes, std::string name)
    : name_(std::move(name)), size_(bytes.size()), memory_(bytes)
{
}

Input::~Input()
{
    if (descriptor_ >= 0)
        close(descriptor_);
}

size_t Input::read_raw(char* to, size_t count)
{
    count = static_cast<size_t>(std::min<uint64_t>(count, size_ - offset_));
    if (descriptor_ < 0) {
        if (count > 0)
            std::memcpy(to, memory_.data() + offset_, count);
    } else {
        size_t done = 0;
        while (done < count) {
            const ssize_t got = read(descriptor_, to + done, count - done);
            if (got < 0 && errno == EINTR)
                continue;
            if (got < 0)
                throw Error(fmt::format("cannot read: {}", std::generic_category().message(errno)), name_);
            if (got == 0) {
                size_ = offset_ + done; // the file was shortened by another program while it was read
                break;
            }
            done += static_cast<size_t>(got);
        }
        count = done;
    }
    offset_ += count;
    return count;
}

void Input::make_room(size_t count)
{
    if (first_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + first_, buffered());
        next_lf_ -= std::min(next_lf_, first_);
        next_cr_ -= std::min(next_cr_, first_);
        last_ -= first_;
        first_ = 0;
    }
    if (buffer_.size() < last_ + count)
        buffer_.resize(
            std::max(last_ + count, std::min(2 * buffer_.size(), buffer_.size() + (size_t{1} << 24))));
}

void Input::fill(size_t count)
{
    // Smallest file size in bytes for which progress is reported; smaller files, such as material libraries,
    // show no progress.
    constexpr uint64_t worth_telling = 1U << 20U;
    constexpr double share_of_load = 0.4;
    if (size_ >= worth_telling)
        report_progress(share_of_load * static_cast<double>(offset_) / static_cast<double>(size_));
    make_room(count);
    if (encoding_ == Encoding::bytes)
        last_ += read_raw(buffer_.data() + last_, count);
    else
        fill_from_utf16();
}

void Input::put_utf8(uint32_t code)
{
    const auto put = [this](uint32_t byte) { buffer_[last_++] = static_cast<char>(byte); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xC0 | code >> 6);
        put(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        put(0xE0 | code >> 12);
        put(0x80 | (code >> 6 & 0x3F));
        put(0x80 | (code & 0x3F));
    } else {
        put(0xF0 | code >> 18);
        put(0x80 | (code >> 12 & 0x3F));
        put(0x80 | (code >> 6 & 0x3F));
        put(0x80 | (code & 0x3F));
    }
}

void Input::fill_from_utf16()
{
    std::vector<char> raw(block_bytes);
    const size_t units = read_raw(raw.data(), raw.size()) / 2;
    // Room for the worst case: a UTF-16 unit becomes at most three bytes, plus three for a lone surrogate.
    make_room(6 * units + 3);
    for (size_t i = 0; i < units; ++i) {
        const uint32_t a = static_cast<uint8_t>(raw[2 * i]);
        const uint32_t b = static_cast<uint8_t>(raw[2 * i + 1]);
        const uint32_t unit = encoding_ == Encoding::utf16_le ? a | b << 8U : b | a << 8U;
        if (high_surrogate_ != 0) {
            const uint32_t high = high_surrogate_;
            high_surrogate_ = 0;
            if (unit >= 0xDC00 && unit < 0xE000) {
                put_utf8(0x10000 + ((high - 0xD800) << 10 | (unit - 0xDC00)));
                continue;
            }
            put_utf8(replacement);
        }
        if (unit >= 0xD800 && unit < 0xDC00)
            high_surrogate_ = unit;
        else
            put_utf8(unit >= 0xDC00 && unit < 0xE000 ? replacement : unit);
    }
}

void Input::detect_encoding()
{
    const std::string_view start = peek(64);
    const auto byte = [&start](size_t i) { return i < start.size() ? static_cast<uint8_t>(start[i]) : 256; };
    if (byte(0) == 0xEF && byte(1) == 0xBB && byte(2) == 0xBF) {
        skip(3);
        return;
    }
    // In UTF-16, ASCII text has a zero in every second byte. No other encoding does.
    const auto zeros = [&](size_t from) {
        for (size_t i = from; i < start.size(); i += 2)
            if (start[i] != '\0' || start[i ^ 1U] == '\0')
                return false;
        return start.size() >= 4 && start.size() % 2 == 0;
    };
    if ((byte(0) == 0xFF && byte(1) == 0xFE) || zeros(1))
        encoding_ = Encoding::utf16_le;
    else if ((byte(0) == 0xFE && byte(1) == 0xFF) || zeros(0))
        encoding_ = Encoding::utf16_be;
    if (encoding_ == Encoding::bytes)
        return;
    const uint64_t begin = byte(0) == 0xFF || byte(0) == 0xFE ? 2 : 0;
    offset_ = begin;
    if (descriptor_ >= 0 && lseek(descriptor_, static_cast<off_t>(begin), SEEK_SET) < 0)
        throw Error(fmt::format("cannot read: {}", std::generic_category().message(errno)), name_);
    first_ = last_ = next_lf_ = next_cr_ = 0;
}

std::string_view Input::peek(size_t wanted)
{
    while (buffered() < wanted && offset_ < size_)
        fill(static_cast<size_t>(
            std::max<uint64_t>(std::min<uint64_t>(wanted - buffered(), size_ - offset_), block_bytes)));
    return {buffer_.data() + first_, buffered()};
}

/// Finds the end of the line that starts at first_. The end is the position of the next LF or CR, or the end
/// of the file.
size_t Input::end_of_line()
{
    const auto search = [this](size_t from, char end) {
        from = std::max(from, first_);
        const void* const found =
            from < last_ ? std::memchr(buffer_.data() + from, end, last_ - from) : nullptr;
        return found == nullptr ? last_
                                : static_cast<size_t>(static_cast<const char*>(found) - buffer_.data());
    };
    // The positions of the next LF and CR are cached, so that each byte is searched only once.
    while (true) {
        if (next_lf_ < first_ || next_lf_ >= last_ || buffer_[next_lf_] != '\n')
            next_lf_ = search(next_lf_, '\n');
        if (next_cr_ < first_ || next_cr_ >= last_ || buffer_[next_cr_] != '\r')
            next_cr_ = search(next_cr_, '\r');
        const size_t end = std::min(next_lf_, next_cr_);
        // The LF of a line end CR LF may be beyond the end of the buffer. In this case more bytes must be
        // read.
        if ((end + 1 < last_ || (end < last_ && buffer_[end] == '\n')) || offset_ >= size_)
            return end;
        fill(block_bytes);
    }
}

bool Input::next_line(std::string_view& line)
{
    const size_t end = end_of_line();
    if (first_ == last_)
        return false;
    ++line_number_;
    line_was_ended_ = end < last_;
    line = {buffer_.data() + first_, end - first_};
    first_ = std::min(end + 1, last_);
    if (line_was_ended_ && buffer_[end] == '\r' && first_ < last_ && buffer_[first_] == '\n')
        ++first_;
    return true;
}

std::string Input::place() const
{
    return fmt::format("{}:{}", name_, line_number_);
}

namespace {

/// Limit for coordinates; mend_primitive() drops vertices that are farther out.
constexpr double most_m = 1e15;
/// Largest distance of coordinates from zero, divided by their extent, for which the origin stays at zero.
constexpr double furthest_of_file = 16.0;
constexpr double furthest_of_object = 1024.0;

double largest(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Returns `origin`, if the distance from it to the centre of `bounds` is at most `furthest` times the extent
/// of `bounds`. If the distance is larger, returns a rounded position near the centre of `bounds`.
glm::dvec3 origin_of(const Bounds& bounds, const glm::dvec3& origin, double furthest)
{
    if (bounds.empty())
        return origin;
    const glm::dvec3 center = bounds.center();
    if (!(largest(center - origin) > furthest * largest(bounds.max - bounds.min)))
        return origin;
    // Coordinates are rounded to integers. For extents below one unit, they are rounded to a multiple of a
    // power of two below the extent.
    const double extent = largest(bounds.max - bounds.min);
    const double step = extent > 0.0 && extent < 1.0 ? std::exp2(std::floor(std::log2(extent))) : 1.0;
    return glm::round(center / step) * step;
}

} // namespace

glm::dvec3 file_origin(const Bounds& bounds)
{
    return origin_of(bounds, glm::dvec3(0.0), furthest_of_file);
}

glm::dvec3 object_origin(const Bounds& bounds, const glm::dvec3& file)
{
    return origin_of(bounds, file, furthest_of_object);
}

bool is_usable(const glm::dvec3& position)
{
    // The comparison is written with `<`, so that the result is false for NaN.
    return largest(position) < most_m && position.x == position.x && position.y == position.y &&
           position.z == position.z;
}

} // namespace estampe
