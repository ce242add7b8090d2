#pragma once

#include <fmt/format.h>

#include "base/message_text.hpp"
#include "io/ply_data.hpp"

namespace vspring {

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
          fmt::format("{} elements {} are promised, but the file is too short for them; correct the count or "
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
