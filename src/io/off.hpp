#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"
#include "io/text_cursor.hpp"

namespace vspring {

/// Walks the words of an OFF file, over comments.
class OffCursor : public TextCursor {
 public:
  explicit OffCursor(const InputFile& file) : TextCursor(file, 0, /*continued=*/false, /*commented=*/true) {}

  /// To the next word, over line ends and comments.
  void skip_to_word();
  /// To the next word of this line, or to its end or a comment.
  bool skip_to_row_end() {
    skip_blanks();
    return at_line_end() || peek() == '#';
  }
  /// The words from here to the end of the line or to a comment.
  [[nodiscard]] int count_words() const;
  /// The next whole number, not negative.
  [[nodiscard]] std::int64_t count(const char* what);

  [[nodiscard]] bool saw_comments() const { return saw_comments_; }

 private:
  bool saw_comments_ = false;
};

/// What comes before the nodes of an OFF file.
struct OffHeader {
  bool normals = false;
  bool colours = false;
  bool textures = false;
  bool colours_first = false;  ///< MeshLab's NCOFF has them before the normals, CNOFF after
  bool edges = false;          ///< the number of edges follows that of faces
  std::int64_t nodes = 0;
  std::int64_t faces = 0;
  std::size_t nodes_begin = 0;  ///< where their numbers stand
  std::size_t faces_begin = 0;
};

/// Reads the keyword, if there is one, and the counts up to the end of their line.
OffHeader read_off_header(OffCursor& cursor);

/// An OFF file: where its nodes are. Throws Error(unusable_file) if the file is read as a stream and new numbers would
/// make it readable by lines.
class OffSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;
  [[nodiscard]] SurfaceFile refined(const RefinedMesh& refined) const override;

  std::vector<std::size_t> rows;  ///< offset of the first coordinate of each node
  bool in_stream = false;         ///< read as a stream: nodes may begin anywhere
  int normal_column = 0;          ///< of the normal's first component among the words of a node; 0: no normals
  std::size_t nodes_begin = 0;    ///< where the numbers of nodes and of faces stand
  std::size_t faces_begin = 0;

 private:
  [[nodiscard]] std::string added_nodes(const Rewrite& rewrite) const;
  /// The whole number that stands at `begin` becomes another one.
  void replace_count(TextRewriter& out, std::size_t begin, Index count) const;
  [[nodiscard]] std::string new_nodes(const RefinedMesh& refined) const;
  void divide_faces(TextRewriter& out, const RefinedMesh& refined) const;
};

}  // namespace vspring
