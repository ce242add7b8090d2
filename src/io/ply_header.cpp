// Reads the elements and properties that a PLY header declares.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "base/message_text.hpp"
#include "io/face_list.hpp"
#include "io/ply.hpp"
#include "io/text_cursor.hpp"

namespace vspring {
namespace {

std::optional<PlyType> type_of(std::string_view name) {
  static constexpr std::string_view names[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                                  {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                                  {"float", "float32"}, {"double", "float64"}};
  for (std::size_t k = 0; k < std::size(names); ++k) {
    if (name == names[k][0] || name == names[k][1]) return static_cast<PlyType>(k);
  }
  return std::nullopt;
}

/// A line of the header as words.
struct Line {
  std::size_t begin = 0;
  std::vector<std::string_view> words;

  [[nodiscard]] std::string_view word(std::size_t k) const { return k < words.size() ? words[k] : std::string_view(); }
};

class HeaderReader {
 public:
  explicit HeaderReader(const InputFile& file);
  PlyHeader read();

 private:
  bool next_line();
  PlyType type_word(std::size_t k) const;
  void read_format();
  void read_element();
  void read_property();
  [[noreturn]] void refuse(std::string_view what) const { file_.refuse_line(line_.begin, what); }

  const InputFile& file_;
  std::string_view line_end_;
  std::size_t at_ = 0;
  Line line_;
  PlyHeader header_;
  bool format_known_ = false;
};

/// The first line, `ply`, shows how lines end; binary data right after the header may begin with any byte.
HeaderReader::HeaderReader(const InputFile& file) : file_(file) {
  const std::string_view bytes = file.bytes;
  if (!bytes.starts_with("ply")) file.refuse_line(0, "a PLY file begins with a line 'ply'; choose one");
  line_end_ = bytes.substr(3, 2) == "\r\n" ? "\r\n" : bytes.substr(3, 1) == "\r" ? "\r" : "\n";
}

bool HeaderReader::next_line() {
  const std::string_view bytes = file_.bytes;
  const std::size_t end = bytes.find(line_end_, at_);
  if (end == std::string_view::npos) return false;
  line_.begin = at_;
  line_.words.clear();
  const std::string_view text = bytes.substr(at_, end - at_);
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t begin = k;
    while (k < text.size() && !is_space(text[k])) ++k;
    if (k > begin)
      line_.words.push_back(text.substr(begin, k - begin));
    else
      ++k;
  }
  at_ = end + line_end_.size();
  return true;
}

PlyType HeaderReader::type_word(std::size_t k) const {
  const std::optional<PlyType> type = type_of(line_.word(k));
  if (!type)
    refuse(fmt::format("{} is not a type of PLY; use char, short, int, float or double", in_quotes(line_.word(k))));
  return *type;
}

void HeaderReader::read_format() {
  const std::string_view name = line_.word(1);
  if (name == "ascii")
    header_.encoding = PlyEncoding::text;
  else if (name == "binary_little_endian")
    header_.encoding = PlyEncoding::little_endian;
  else if (name == "binary_big_endian")
    header_.encoding = PlyEncoding::big_endian;
  else
    refuse(
        fmt::format("{} is not a format of PLY; convert the file to ascii or binary_little_endian", in_quotes(name)));
  if (line_.word(2) != "1.0")
    refuse(fmt::format("PLY of version {} is not read; convert it to 1.0", in_quotes(line_.word(2))));
  format_known_ = true;
}

void HeaderReader::read_element() {
  PlyElement element;
  element.name = line_.word(1);
  const std::string_view count = line_.word(2);
  const auto [stop, fault] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (line_.words.size() != 3 || fault != std::errc() || stop != count.data() + count.size())
    refuse(fmt::format("{} stands where the number of elements belongs; correct the line", in_quotes(count)));
  if (header_.find(element.name) != nullptr)
    refuse(fmt::format("a second element {}; rename or remove it", in_quotes(element.name)));
  element.count_begin = static_cast<std::size_t>(count.data() - file_.bytes.data());
  element.count_end = element.count_begin + count.size();
  header_.elements.push_back(std::move(element));
}

void HeaderReader::read_property() {
  if (header_.elements.empty()) refuse("a property before the first element; correct the header");
  PlyProperty property;
  const bool list = line_.word(1) == "list";
  if (line_.words.size() != (list ? 5 : 3)) refuse("a property needs a type and a name; correct the line");
  if (list) {
    property.count_type = type_word(2);
    if (!is_whole(*property.count_type)) refuse("the length of a list has to be of a whole-number type; correct it");
  }
  const std::string_view type = line_.word(list ? 3 : 1);
  property.type = type_word(list ? 3 : 1);
  property.type_begin = static_cast<std::size_t>(type.data() - file_.bytes.data());
  property.type_end = property.type_begin + type.size();
  property.name = line_.words.back();
  PlyElement& element = header_.elements.back();
  if (element.find(property.name) >= 0)
    refuse(fmt::format("a second property {}; rename or remove it", in_quotes(property.name)));
  element.properties.push_back(std::move(property));
}

PlyHeader HeaderReader::read() {
  if (!next_line() || line_.word(0) != "ply") file_.refuse_line(0, "a PLY file begins with a line 'ply'; choose one");
  while (next_line()) {
    const std::string_view keyword = line_.word(0);
    if (keyword == "end_header") {
      if (!format_known_) refuse("the header has no line 'format'; add it");
      header_.end = at_;
      return std::move(header_);
    }
    if (keyword == "format") {
      read_format();
    } else if (keyword == "element") {
      read_element();
    } else if (keyword == "property") {
      read_property();
    } else if (keyword == "comment" || keyword == "obj_info") {
      header_.comments = true;
    } else if (!keyword.empty()) {
      refuse(fmt::format("{} is not a line of a PLY header; correct it", in_quotes(keyword)));
    }
  }
  file_.refuse_line(file_.bytes.size(), "the file ends inside its header; it is cut off");
}

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const auto& p) { return p.count_type.has_value(); });
}

std::size_t PlyElement::least_size(PlyEncoding encoding) const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
    size += encoding == PlyEncoding::text ? 2 : size_of(property.count_type.value_or(property.type));
  return size;
}

int PlyElement::find(std::string_view property) const {
  for (std::size_t k = 0; k < properties.size(); ++k) {
    if (properties[k].name == property) return static_cast<int>(k);
  }
  return -1;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  for (const PlyElement& candidate : elements) {
    if (candidate.name == element) return &candidate;
  }
  return nullptr;
}

int find_number(const PlyElement& element, std::string_view property) {
  const int found = element.find(property);
  return found >= 0 && element.properties[static_cast<std::size_t>(found)].count_type ? -1 : found;
}

const PlyElement& ply_nodes(const InputFile& file, const PlyHeader& header) {
  const PlyElement* element = header.find("vertex");
  if (element == nullptr) file.refuse("its header has no element 'vertex'; choose another file");
  if (element->count == 0) file.refuse("it has no nodes; choose another file");
  if (element->count > static_cast<std::uint64_t>(most_nodes)) file.refuse("more than 2^30 nodes; split the file");
  for (const char* name : {"x", "y", "z"}) {
    if (find_number(*element, name) < 0)
      file.refuse(fmt::format("its nodes have no property {}; export it again", name));
  }
  return *element;
}

PlyHeader read_ply_header(const InputFile& file) { return HeaderReader(file).read(); }

}  // namespace vspring
