#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/binary_numbers.hpp"
#include "io/ply.hpp"
#include "io/ply_data.hpp"
#include "io/rewriter.hpp"

namespace vspring {

/// The greatest whole number of a type.
inline std::int64_t greatest_of(PlyType type) {
  const std::size_t bits = 8 * size_of(type);
  const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  return (std::int64_t{1} << (is_signed ? bits - 1 : bits)) - 1;
}

/// The places and values of the rows of elements.
template <typename Data>
class PlyRows : private PlyElements<Data> {
 public:
  using PlyElements<Data>::PlyElements;

  /// Where each row of an element of the header begins, and where the last one ends.
  std::vector<std::size_t> of(const PlyElement& wanted) {
    std::vector<std::size_t> rows;
    for (const PlyElement& element : this->header_.elements) {
      if (&element != &wanted) {
        this->skip_elements(element);
        continue;
      }
      for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
        this->data_.align();
        rows.push_back(this->data_.offset());
        for (const PlyProperty& property : element.properties) this->skip_property(property, place);
      }
      break;
    }
    rows.push_back(this->data_.offset());
    return rows;
  }

  /// The numbers of the row here, in the order of the properties; NaN for lists.
  std::vector<double> numbers(const PlyElement& element) {
    std::vector<double> numbers;
    const PlyPlace place{&element, 0};
    for (const PlyProperty& property : element.properties) {
      if (property.count_type) {
        this->skip_property(property, place);
        numbers.push_back(std::numeric_limits<double>::quiet_NaN());
      } else {
        numbers.push_back(this->data_.number(property.type, place));
      }
    }
    return numbers;
  }

  /// The numbers of the list that is the given property of the row here.
  std::vector<double> list(const PlyElement& element, std::size_t wanted) {
    const PlyPlace place{&element, 0};
    for (std::size_t p = 0; p < wanted; ++p) this->skip_property(element.properties[p], place);
    const PlyProperty& property = element.properties[wanted];
    std::vector<double> numbers(this->list_length(property, place));
    for (double& number : numbers) number = this->data_.number(property.type, place);
    return numbers;
  }

  /// The values of the row here, a piece of the file for each property.
  std::vector<std::string> values(const PlyElement& element) {
    std::vector<std::string> values;
    const PlyPlace place{&element, 0};
    for (const PlyProperty& property : element.properties) {
      this->data_.align();
      const std::size_t begin = this->data_.offset();
      this->skip_property(property, place);
      values.push_back(this->file_.bytes.substr(begin, this->data_.offset() - begin));
    }
    return values;
  }
};

/// Makes rows of new elements from those of others.
template <typename Data>
class RowMaker {
 public:
  RowMaker(const InputFile& file, const PlyHeader& header, const PlyElement& element)
      : file_(file),
        header_(header),
        element_(element),
        swapped_(swapped_here(header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little)),
        rows_(PlyRows<Data>(file, header).of(element)) {}

  [[nodiscard]] std::size_t begin(Index row) const { return rows_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] std::size_t end() const { return rows_.back(); }
  /// Without what separates it from the next one.
  [[nodiscard]] std::size_t end_of(Index row) const {
    std::size_t end = rows_[static_cast<std::size_t>(row) + 1];
    while (is_text() && is_space(file_.bytes[end - 1])) --end;
    return end;
  }

  /// The row as it stands in the file.
  [[nodiscard]] std::string text(Index row) const { return file_.bytes.substr(begin(row), end_of(row) - begin(row)); }

  std::vector<std::string> like(Index row) const {
    const PlyHeader here = header_at(row);
    return PlyRows<Data>(file_, here).values(element_);
  }
  std::vector<double> numbers(Index row) const {
    const PlyHeader here = header_at(row);
    return PlyRows<Data>(file_, here).numbers(element_);
  }
  std::vector<double> list(Index row, std::size_t property) const {
    const PlyHeader here = header_at(row);
    return PlyRows<Data>(file_, here).list(element_, property);
  }
  [[nodiscard]] std::string number(PlyType type, double value, std::size_t node) const {
    std::string text;
    if (is_text()) {
      if (type == PlyType::float32)
        append_number(text, single(value, node));
      else
        append_number(text, value);
    } else if (type == PlyType::float32) {
      append_bytes(text, single(value, node), swapped_);
    } else {
      append_bytes(text, value, swapped_);
    }
    return text;
  }
  [[nodiscard]] std::string whole(PlyType type, std::int64_t value) const {
    if (value > greatest_of(type))
      file_.refuse(fmt::format(
          "its faces have no room for numbers of nodes up to {}; write it in another format, such as OBJ", value));
    if (is_text()) return std::to_string(value);
    std::string bytes;
    append_whole_number(bytes, type, value, swapped_);
    return bytes;
  }
  [[nodiscard]] std::string list(const PlyProperty& property, std::span<const Index> nodes) const {
    std::string text = whole(*property.count_type, static_cast<std::int64_t>(nodes.size()));
    for (const Index node : nodes) (text += is_text() ? " " : "") += whole(property.type, node);
    return text;
  }
  [[nodiscard]] std::string list(const PlyProperty& property, const std::vector<double>& numbers) const {
    std::string text = whole(*property.count_type, static_cast<std::int64_t>(numbers.size()));
    for (const double value : numbers) (text += is_text() ? " " : "") += number(property.type, value, 0);
    return text;
  }
  /// Between two rows.
  [[nodiscard]] std::string_view separator() const { return is_text() ? line_ending(file_.bytes) : ""; }
  [[nodiscard]] std::string row(const std::vector<std::string>& values) const {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k) (text += is_text() && k > 0 ? " " : "") += values[k];
    return text;
  }

 private:
  [[nodiscard]] PlyHeader header_at(Index row) const {
    PlyHeader here;
    here.encoding = header_.encoding;
    here.end = begin(row);
    return here;
  }
  [[nodiscard]] bool is_text() const { return header_.encoding == PlyEncoding::text; }

  const InputFile& file_;
  const PlyHeader& header_;
  const PlyElement& element_;
  bool swapped_;
  std::vector<std::size_t> rows_;
};

}  // namespace vspring
