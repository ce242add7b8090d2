#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/face_list.hpp"
#include "io/text_cursor.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// The elements (faces or lines) of the named groups (`g`) and objects (`o`) of an OBJ file, gathered while it is read.
class ObjGroups {
 public:
  /// The names of a `g` line: the elements that follow belong to all of them.
  void start_groups(std::vector<std::string> names, Index next_element);
  /// The name of an `o` line.
  void start_object(std::string name, Index next_element);

  /// element_begin: where each element's nodes begin, and where the last one's end. Ends open groups and returns the
  /// nodes of every group, ascending. Cost: linear in the elements of all groups.
  [[nodiscard]] std::map<std::string, std::vector<Index>> take(std::span<const Index> element_begin,
                                                               std::span<const Index> nodes, Index node_count);

 private:
  void end_run(Index next_element);

  std::vector<std::string> groups_;
  std::string object_;
  Index run_begin_ = 0;
  /// Runs of elements [first, second) of each name.
  std::map<std::string, std::vector<std::pair<Index, Index>>> elements_;
};

/// Reads the statements of an OBJ file: nodes and groups here, elements (faces or lines) in a derived class. Other
/// statements are kept as they stand, and listed as carried.
class ObjStatements {
 public:
  explicit ObjStatements(const InputFile& file)
      : file_(file), cursor_(file, byte_order_mark_length(file.bytes), /*continued=*/true) {}
  virtual ~ObjStatements() = default;
  ObjStatements(const ObjStatements&) = delete;
  ObjStatements& operator=(const ObjStatements&) = delete;

  void read();

 protected:
  /// Reads what follows the keyword of an element; false if it is none.
  virtual bool read_element(std::string_view keyword) = 0;

  /// Reads a node of an element: its number only.
  void read_node_number();
  /// Reads the nodes of a line (`l`) as an element.
  void read_line();
  /// The segments of the elements, which are lines.
  [[nodiscard]] std::vector<std::pair<Index, Index>> segments_of_lines() const;
  /// The index of a number that counts from 1 or, if negative, back from the latest. kind: what it counts, for the
  /// message.
  Index number_of(std::int64_t number, std::size_t count, std::size_t where, const char* kind) const;
  /// Refuses elements of nodes that do not exist.
  void check_node_numbers() const;
  /// file: the one that was read, which may have been moved since.
  [[nodiscard]] std::vector<std::string> take_warnings(const InputFile& file);

  const InputFile& file_;
  TextCursor cursor_;
  std::vector<Vector3> positions_;
  std::vector<std::size_t> node_rows_;  ///< offset of the first coordinate of each node
  FaceList elements_;
  ObjGroups groups_;
  std::set<std::string> carried_;
  std::vector<std::string> warnings_;

 private:
  void skip_rest_of_numbers(int already);
  void read_node();
  void read_groups();
  void read_object();
  void read_other(std::string_view keyword, std::size_t where);

  std::size_t unknown_count_ = 0;
  std::size_t unknown_where_ = 0;
  std::string unknown_word_;
};

/// Where a line with its end is over, also one that is joined to the next. row: a place in the line.
std::size_t behind_line(std::string_view bytes, std::size_t row);

}  // namespace vspring
