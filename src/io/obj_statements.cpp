#include "io/obj_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/message_text.hpp"

namespace vspring {

void ObjGroups::end_run(Index next_element) {
  const auto note = [&](const std::string& name) {
    auto& runs = elements_[name];
    if (next_element > run_begin_ && (runs.empty() || runs.back().first != run_begin_))
      runs.emplace_back(run_begin_, next_element);
  };
  for (const std::string& name : groups_) note(name);
  if (!object_.empty()) note(object_);
  run_begin_ = next_element;
}

void ObjGroups::start_groups(std::vector<std::string> names, Index next_element) {
  end_run(next_element);
  groups_ = std::move(names);
}

void ObjGroups::start_object(std::string name, Index next_element) {
  end_run(next_element);
  object_ = std::move(name);
}

std::map<std::string, std::vector<Index>> ObjGroups::take(std::span<const Index> element_begin,
                                                          std::span<const Index> nodes, Index node_count) {
  end_run(static_cast<Index>(element_begin.size()) - 1);
  std::map<std::string, std::vector<Index>> groups;
  std::vector<Index> seen_in(static_cast<std::size_t>(node_count), -1);
  Index number = 0;
  for (const auto& [name, runs] : elements_) {
    std::vector<Index>& members = groups[name];
    for (const auto& [first, last] : runs) {
      for (Index corner = element_begin[first]; corner < element_begin[last]; ++corner) {
        const Index node = nodes[corner];
        if (seen_in[node] == number) continue;
        seen_in[node] = number;
        members.push_back(node);
      }
    }
    std::sort(members.begin(), members.end());
    ++number;
  }
  return groups;
}

void ObjStatements::read() {
  for (cursor_.skip_space(); !cursor_.at_end(); cursor_.skip_space()) {
    const std::size_t where = cursor_.offset();
    if (cursor_.peek() == '#') {
      carried_.insert("comments");
      cursor_.skip_comment();
      continue;
    }
    const std::string_view keyword = cursor_.word();
    // A lone backslash at a line end is skipped as a blank, so a word is never empty here.
    if (keyword == "v") {
      read_node();
    } else if (keyword == "g") {
      read_groups();
    } else if (keyword == "o") {
      read_object();
    } else if (!read_element(keyword)) {
      read_other(keyword, where);
    }
    cursor_.skip_blanks();
    if (!cursor_.at_line_end() && cursor_.peek() != '#') cursor_.refuse_word("the end of the line");
    cursor_.skip_comment();
  }
}

void ObjStatements::skip_rest_of_numbers(int already) {
  int count = already;
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
    static_cast<void>(cursor_.number("a number"));
    ++count;
  }
  if (count == 4) carried_.insert("weights of nodes");
  if (count > 5) carried_.insert("colours");
}

void ObjStatements::read_node() {
  if (static_cast<std::int64_t>(positions_.size()) == most_nodes)
    cursor_.refuse("more than 2^30 nodes; split the file");
  Vector3 position;
  cursor_.skip_blanks();
  node_rows_.push_back(cursor_.offset());
  for (int k = 0; k < 3; ++k) {
    cursor_.skip_blanks();
    position[k] = cursor_.number("a coordinate");
  }
  positions_.push_back(position);
  cursor_.skip_blanks();
  if (!cursor_.at_line_end()) skip_rest_of_numbers(3);
}

void ObjStatements::read_node_number() {
  const std::size_t where = cursor_.offset();
  elements_.add_corner(number_of(cursor_.integer("the number of a node"), positions_.size(), where, "node"), where);
}

void ObjStatements::read_line() {
  if (elements_.full()) cursor_.refuse("too many lines; split the file");
  int nodes = 0;
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks(), ++nodes) {
    read_node_number();
    if (cursor_.peek() == '/') {
      cursor_.skip(1);
      carried_.insert("texture coordinates");
      if (!cursor_.at_word_end()) static_cast<void>(cursor_.integer("the number of a texture coordinate"));
    }
    if (!cursor_.at_word_end()) cursor_.refuse_word("the next node of the line");
  }
  if (nodes < 2) cursor_.refuse_word("the number of a node");
  elements_.end_face();
}

std::vector<std::pair<Index, Index>> ObjStatements::segments_of_lines() const {
  std::vector<std::pair<Index, Index>> segments;
  segments.reserve(elements_.corner_count());
  for (Index line = 0; line < elements_.face_count(); ++line) {
    for (Index k = elements_.face_begin()[line] + 1; k < elements_.face_begin()[line + 1]; ++k)
      segments.emplace_back(elements_.corners()[k - 1], elements_.corners()[k]);
  }
  return segments;
}

Index ObjStatements::number_of(std::int64_t number, std::size_t count, std::size_t where, const char* kind) const {
  if (number == 0) file_.refuse_line(where, fmt::format("{} 0 does not exist; OBJ counts from 1", kind));
  if (number > 0) return static_cast<Index>(std::min(number - 1, most_nodes));
  const std::int64_t back = static_cast<std::int64_t>(count) + number;
  if (back < 0)
    file_.refuse_line(where, fmt::format("{} {} does not exist, {} stand above; correct it", kind, number, count));
  return static_cast<Index>(back);
}

void ObjStatements::read_groups() {
  carried_.insert("groups");
  std::vector<std::string> names;
  for (cursor_.skip_blanks(); !cursor_.at_line_end(); cursor_.skip_blanks()) names.emplace_back(cursor_.word());
  groups_.start_groups(std::move(names), elements_.face_count());
}

void ObjStatements::read_object() {
  carried_.insert("groups");
  cursor_.skip_blanks();
  const std::size_t begin = cursor_.offset();
  cursor_.skip_to_line_end();
  std::size_t end = cursor_.offset();
  while (end > begin && is_space(file_.bytes[end - 1])) --end;
  groups_.start_object(file_.bytes.substr(begin, end - begin), elements_.face_count());
}

void ObjStatements::read_other(std::string_view keyword, std::size_t where) {
  static const std::set<std::string_view> free_form = {
      "vp", "cstype", "deg", "bmat",  "step",  "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
      "sp", "end",    "con", "ctech", "stech", "mg",   "bzp",   "bsp",  "cdc",  "cdp",  "res"};
  static const std::set<std::string_view> appearance = {"bevel",  "c_interp",   "d_interp",  "lod",  "maplib",
                                                        "usemap", "shadow_obj", "trace_obj", "call", "csh"};
  static const std::map<std::string_view, const char*> others = {{"f", "faces"},          {"l", "lines"},
                                                                 {"p", "points"},         {"s", "smoothing groups"},
                                                                 {"vn", "normals"},       {"vt", "texture coordinates"},
                                                                 {"mtllib", "materials"}, {"usemtl", "materials"}};
  if (const auto other = others.find(keyword); other != others.end()) {
    carried_.insert(other->second);
  } else if (free_form.count(keyword) > 0) {
    if (carried_.insert("free-form curves and surfaces").second)
      warnings_.push_back(fmt::format("{}:{}: free-form curves and surfaces are kept as they are, not made fair",
                                      file_.name, file_.line_of(where)));
  } else if (appearance.count(keyword) > 0) {
    carried_.insert("display attributes");
  } else {
    carried_.insert("statements that are not known");
    if (unknown_count_++ == 0) {
      unknown_where_ = where;
      unknown_word_ = in_quotes(keyword);
    }
  }
  cursor_.skip_to_line_end();
}

void ObjStatements::check_node_numbers() const {
  if (elements_.highest() < static_cast<std::int64_t>(positions_.size())) return;
  file_.refuse_line(elements_.highest_where(),
                    fmt::format("node {} does not exist, the file has {}; correct it or restore what is missing",
                                elements_.highest() + 1, positions_.size()));
}

std::vector<std::string> ObjStatements::take_warnings(const InputFile& file) {
  if (unknown_count_ > 0)
    warnings_.push_back(unknown_count_ == 1
                            ? fmt::format("{}:{}: {} is not a known statement; it is kept as it is", file.name,
                                          file.line_of(unknown_where_), unknown_word_)
                            : fmt::format("{}:{}: {} and {} more are not known statements; they are kept as they are",
                                          file.name, file.line_of(unknown_where_), unknown_word_, unknown_count_ - 1));
  return std::move(warnings_);
}

std::size_t behind_line(std::string_view bytes, std::size_t row) {
  for (std::size_t end = row;; ++end) {
    end = bytes.find_first_of("\r\n", end);
    if (end == std::string_view::npos) return bytes.size();
    const bool is_joined = bytes[end - 1] == '\\';
    if (bytes.substr(end, 2) == "\r\n") ++end;
    if (!is_joined) return end + 1;
  }
}

}  // namespace vspring
