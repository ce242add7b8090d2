// The keyword and the counts of an OFF file, and its words.
#include <fmt/format.h>

#include "base/message_text.hpp"
#include "io/face_list.hpp"
#include "io/off.hpp"

namespace vspring {
namespace {

void read_keyword(OffCursor& cursor, OffHeader& header) {
  cursor.skip_to_word();
  const std::size_t begin = cursor.offset();
  TextCursor ahead = cursor;
  const std::string_view word = ahead.word();
  const std::size_t end = word.find("OFF");
  // Without the keyword the counts come first.
  if (end == std::string_view::npos) return;
  std::string_view letters = word.substr(0, end);
  const auto take = [&](std::string_view prefix) {
    if (!letters.starts_with(prefix)) return false;
    letters.remove_prefix(prefix.size());
    return true;
  };
  while (!letters.empty()) {
    if (take("ST")) {
      header.textures = true;
    } else if (take("C")) {
      header.colours = true;
      header.colours_first = header.normals;
    } else if (take("N")) {
      header.normals = true;
    } else if (take("4") || take("n")) {
      cursor.refuse(
          fmt::format("{} has nodes in another space than three dimensions; convert it to OFF", in_quotes(word)));
    } else {
      cursor.refuse(fmt::format("{} is not a kind of OFF; correct the first line", in_quotes(word)));
    }
  }
  // Some files have the counts right after the keyword, without a blank.
  cursor.skip(end + 3);
  if (!cursor.at_word_end() && !(cursor.peek() >= '0' && cursor.peek() <= '9'))
    cursor.file().refuse_line(begin, fmt::format("{} is not a kind of OFF; correct the first line", in_quotes(word)));
  cursor.skip_blanks();
  ahead = cursor;
  if (ahead.word() == "BINARY") cursor.refuse("binary OFF is not read; convert it to text or to PLY");
}

void read_counts(OffCursor& cursor, OffHeader& header) {
  cursor.skip_to_word();
  header.nodes_begin = cursor.offset();
  header.nodes = cursor.count("the number of nodes");
  cursor.skip_to_word();
  header.faces_begin = cursor.offset();
  header.faces = cursor.count("the number of faces");
  header.edges = !cursor.skip_to_row_end();
  if (header.edges) static_cast<void>(cursor.count("the number of edges"));
  if (header.nodes == 0) cursor.file().refuse("it has no nodes; choose the file of a surface");
  // A node takes three digits and three blanks, a face two of each; the last blank may be missing.
  const auto left = static_cast<std::int64_t>(cursor.bytes_left()) + 1;
  if (header.nodes > most_nodes || header.nodes > left / 6)
    cursor.refuse(
        fmt::format("the header counts {} nodes, but the file is too short for them; correct the count or restore "
                    "what is missing",
                    header.nodes));
  if (header.faces > most_nodes || header.faces > left / 4)
    cursor.refuse(
        fmt::format("the header counts {} faces, but the file is too short for them; correct the count or restore "
                    "what is missing",
                    header.faces));
}

}  // namespace

void OffCursor::skip_to_word() {
  for (skip_space(); peek() == '#'; skip_space()) {
    saw_comments_ = true;
    skip_comment();
  }
}

int OffCursor::count_words() const {
  OffCursor ahead = *this;
  int words = 0;
  for (; !ahead.skip_to_row_end(); ++words) static_cast<void>(ahead.word());
  return words;
}

std::int64_t OffCursor::count(const char* what) {
  skip_to_word();
  const std::size_t where = offset();
  const std::int64_t number = whole_word(what);
  if (number < 0) file().refuse_line(where, fmt::format("{} stands where {} belongs; correct it", number, what));
  return number;
}

OffHeader read_off_header(OffCursor& cursor) {
  OffHeader header;
  read_keyword(cursor, header);
  read_counts(cursor, header);
  return header;
}

}  // namespace vspring
