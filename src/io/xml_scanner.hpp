#pragma once

#include <string_view>
#include <vector>

#include "io/input_file.hpp"

namespace vspring {

/// Walks the elements of an XML file in UTF-8 or another superset of ASCII, and tells their offsets. It skips text,
/// comments, CDATA and processing instructions, and leaves references in values as they are.
///
/// Our own, as Debian's libraries (expat, pugixml, libxml2) are not available for WebAssembly and do not tell the
/// offset of an attribute's value, which is needed to change nothing else.
class XmlScanner {
 public:
  /// Every function throws Error(unusable_file), naming the line, if the file is not well-formed.
  explicit XmlScanner(const InputFile& file);

  enum class Event { element_begins, element_ends, file_ends };

  struct Attribute {
    std::string_view name;
    std::string_view value;  ///< a view of the file's bytes between the quotes
  };

  /// Goes on to the next begin or end of an element; <a/> is both, one after the other.
  Event next();

  /// The name of the element that begins or ends here, without its prefix.
  [[nodiscard]] std::string_view name() const;
  /// The parent of the element that begins or ends here; empty for the outermost.
  [[nodiscard]] std::string_view parent() const;
  /// The attributes of the element that begins here.
  [[nodiscard]] const std::vector<Attribute>& attributes() const { return attributes_; }
  /// The offset of the first byte of the element that begins or ends here.
  [[nodiscard]] std::size_t begin() const { return begin_; }
  /// The offset after what next() has read.
  [[nodiscard]] std::size_t end() const { return at_; }

 private:
  struct Element {
    std::string_view name;
    std::size_t begin;
  };

  [[nodiscard]] std::string_view rest() const { return std::string_view(file_.bytes).substr(at_); }
  [[nodiscard]] bool skip_space();
  /// Goes past the next `end`; what: the name, in messages, of what it ends.
  void skip_behind(std::string_view end, std::string_view what);
  void skip_document_type();
  void read_begin();
  void read_end();
  void read_attribute();
  std::string_view read_name(std::string_view what);
  [[noreturn]] void refuse_end(std::string_view what) const;

  const InputFile& file_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;
  std::vector<Element> open_;  ///< from the outermost on; the last one begins or ends here
  std::vector<Attribute> attributes_;
  bool is_empty_ = false;   ///< <a/>, whose end next() has yet to return
  bool has_ended_ = false;  ///< the last one of open_ has
  bool has_element_ = false;
};

}  // namespace vspring
