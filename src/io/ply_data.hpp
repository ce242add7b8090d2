#pragma once

#include <fmt/format.h>

#include "base/message_text.hpp"
#include "io/binary_numbers.hpp"
#include "io/ply.hpp"
#include "io/text_cursor.hpp"

namespace vspring {

/// Appends a whole number as a binary file has it.
inline void append_whole_number(std::string& out, PlyType type, std::int64_t number, bool swapped) {
  // Signed and unsigned types have the same bytes.
  switch (size_of(type)) {
    case 1:
      return append_bytes(out, static_cast<std::uint8_t>(number), swapped);
    case 2:
      return append_bytes(out, static_cast<std::uint16_t>(number), swapped);
    default:
      return append_bytes(out, static_cast<std::uint32_t>(number), swapped);
  }
}

/// Which element of which kind is being read, for messages.
struct PlyPlace {
  const PlyElement* element = nullptr;
  std::uint64_t number = 0;

  [[nodiscard]] std::string text() const { return fmt::format("{} {} of {}", element->name, number, element->count); }
};

/// Reads the numbers of a text PLY in turn. They may be on any lines.
class PlyText {
 public:
  PlyText(const InputFile& file, const PlyHeader& header) : cursor_(file, header.end) {}

  [[nodiscard]] std::size_t offset() const { return cursor_.offset(); }
  [[nodiscard]] std::size_t bytes_left() const { return cursor_.bytes_left() + 1; }
  /// Goes to where the next number begins.
  void align() { cursor_.skip_space(); }
  [[nodiscard]] double number(PlyType, const PlyPlace&) {
    cursor_.skip_space();
    return cursor_.number("a number");
  }
  [[nodiscard]] std::int64_t whole(PlyType, const PlyPlace&) {
    cursor_.skip_space();
    return cursor_.whole_word("a whole number");
  }
  void skip(PlyType type, std::uint64_t count, const PlyPlace& place) {
    for (; count > 0; --count) static_cast<void>(number(type, place));
  }
  /// Refuses a list that the rest of the file cannot hold.
  void check_room(PlyType, std::uint64_t count, const PlyPlace& place) const {
    if (count > bytes_left() / 2)
      refuse(fmt::format("{}: a list of {} numbers is longer than the file; correct it", place.text(), count));
  }
  [[nodiscard]] bool only_padding_left() {
    cursor_.skip_space();
    return cursor_.at_end();
  }
  [[noreturn]] void refuse(std::string_view what) const { cursor_.refuse(what); }
  [[noreturn]] void refuse_at(std::size_t offset, std::string_view what) const {
    cursor_.file().refuse_line(offset, what);
  }

 private:
  TextCursor cursor_;
};

/// Reads the numbers of a binary PLY in turn.
class PlyBinary {
 public:
  PlyBinary(const InputFile& file, const PlyHeader& header)
      : file_(file),
        at_(file.bytes.data() + header.end),
        end_(file.bytes.data() + file.bytes.size()),
        swapped_(swapped_here(header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little)) {}

  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(at_ - file_.bytes.data()); }
  [[nodiscard]] std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  void align() {}
  [[nodiscard]] double number(PlyType type, const PlyPlace& place) {
    switch (type) {
      case PlyType::float32:
        return static_cast<double>(take<float>(place));
      case PlyType::float64:
        return take<double>(place);
      default:
        return static_cast<double>(whole(type, place));
    }
  }
  [[nodiscard]] std::int64_t whole(PlyType type, const PlyPlace& place) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>(place);
      case PlyType::uint8:
        return take<std::uint8_t>(place);
      case PlyType::int16:
        return take<std::int16_t>(place);
      case PlyType::uint16:
        return take<std::uint16_t>(place);
      case PlyType::int32:
        return take<std::int32_t>(place);
      case PlyType::uint32:
        return take<std::uint32_t>(place);
      default:
        refuse("a whole number is of a floating-point type");
    }
  }
  void skip(PlyType type, std::uint64_t count, const PlyPlace& place) {
    if (count > bytes_left() / size_of(type)) refuse_end(place);
    at_ += count * size_of(type);
  }
  void check_room(PlyType type, std::uint64_t count, const PlyPlace& place) const {
    if (count > bytes_left() / size_of(type)) refuse_end(place);
  }
  /// Some writers end a binary file with a line end or zeros.
  [[nodiscard]] bool only_padding_left() const {
    for (const char* p = at_; p != end_; ++p) {
      if (*p != '\0' && !is_space(*p)) return false;
    }
    return true;
  }
  [[noreturn]] void refuse(std::string_view what) const { refuse_at(offset(), what); }
  [[noreturn]] void refuse_at(std::size_t offset, std::string_view what) const {
    file_.refuse(fmt::format("byte {}: {}", offset, what));
  }

 private:
  template <typename Number>
  Number take(const PlyPlace& place) {
    if (bytes_left() < sizeof(Number)) refuse_end(place);
    const Number number = load<Number>(at_, swapped_);
    at_ += sizeof(Number);
    return number;
  }
  [[noreturn]] void refuse_end(const PlyPlace& place) const {
    refuse(fmt::format("the file ends inside {}; it is cut off or a count is wrong", place.text()));
  }

  const InputFile& file_;
  const char* at_;
  const char* end_;
  bool swapped_;
};

/// Walks the elements of a PLY file. Data: PlyText or PlyBinary.
template <typename Data>
class PlyElements {
 public:
  PlyElements(const InputFile& file, const PlyHeader& header) : file_(file), header_(header), data_(file, header) {}

 protected:
  /// Refuses a count that the rest of the file cannot hold.
  void check_count(const PlyElement& element) const {
    const std::size_t size = element.least_size(header_.encoding);
    if (size > 0 && element.count > data_.bytes_left() / size)
      file_.refuse(
          fmt::format("the header counts {} elements {}, but the file is too short for them; correct the count or "
                      "restore what is missing",
                      element.count, in_quotes(element.name)));
  }

  std::uint64_t list_length(const PlyProperty& property, const PlyPlace& place) {
    const std::int64_t length = data_.whole(*property.count_type, place);
    if (length < 0) data_.refuse(fmt::format("{}: a list of {} numbers; correct it", place.text(), length));
    data_.check_room(property.type, static_cast<std::uint64_t>(length), place);
    return static_cast<std::uint64_t>(length);
  }

  void skip_property(const PlyProperty& property, const PlyPlace& place) {
    data_.skip(property.type, property.count_type ? list_length(property, place) : 1, place);
  }

  void skip_elements(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
      for (const PlyProperty& property : element.properties) skip_property(property, place);
    }
  }

  const InputFile& file_;
  const PlyHeader& header_;
  Data data_;
};

}  // namespace vspring
