#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/curve_formats.hpp"
#include "io/point_formats.hpp"
#include "io/text_cursor.hpp"
#include "vspring/local_plane.hpp"

namespace vspring {

/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// A line of a file of rows.
struct TableLine {
  enum class Kind { blank, comment, row };

  std::string_view text;  ///< without line end and trailing blanks
  std::size_t offset;
  Kind kind;
};

/// The line that begins at an offset, and the offset after it. A comment begins with #; a row of blanks and delimiters
/// only, as spreadsheets write it, is blank, and so is the end that DOS marked. Lines end with LF, CR LF, or CR if that
/// is `line_end`.
TableLine line_at(std::string_view bytes, std::size_t offset, char line_end);

/// LF, or CR in files that have no LF.
char line_end_of(std::string_view bytes);

/// Calls use(line) for the lines of a file, without a byte order mark, until it returns false.
template <typename Use>
void walk_lines(std::string_view bytes, const Use& use) {
  const char line_end = line_end_of(bytes);
  for (std::size_t at = byte_order_mark_length(bytes); at < bytes.size();) {
    if (!use(line_at(bytes, at, line_end))) return;
    at = std::min(bytes.find(line_end, at), bytes.size() - 1) + 1;
  }
}

/// All lines of a file, without a byte order mark.
std::vector<TableLine> table_lines(std::string_view bytes);

/// Cuts rows into cells, and says how numbers are written in them.
class CellCutter {
 public:
  /// delimiter: between two cells; a blank means any run of blanks. quotes: cells may be quoted, with delimiters
  /// inside. decimal_mark: a point or a comma.
  CellCutter(char delimiter, bool quotes, char decimal_mark = '.')
      : delimiter_(delimiter), quotes_(quotes), decimal_mark_(decimal_mark) {}

  /// The cells of a row, without the blanks and quotes around them; valid until the next call.
  const std::vector<std::string_view>& cut(std::string_view row);
  [[nodiscard]] bool cuts_at_blanks() const { return delimiter_ == ' '; }
  [[nodiscard]] bool cuts_at_commas() const { return delimiter_ == ','; }
  [[nodiscard]] char decimal_mark() const { return decimal_mark_; }

 private:
  [[nodiscard]] std::size_t cell_end(std::string_view row, std::size_t begin) const;
  [[nodiscard]] bool is_delimiter(char c) const;

  char delimiter_;
  bool quotes_;
  char decimal_mark_;
  std::vector<std::string_view> cells_;
};

/// The value of a cell, if it is a number; "nan" and "inf" are.
std::optional<double> number_of(std::string_view cell, char decimal_mark = '.');

/// Whether a cell is a number with a decimal comma.
bool has_decimal_comma(std::string_view cell);

/// A file of rows that give the position of one node each.
class TableSource : public CurveSource {
 public:
  [[nodiscard]] std::string rewritten(const Rewriting& what) const override;

  struct Row {
    std::size_t offset;
    Index node;  ///< two rows may be of the same node
  };
  std::vector<Row> rows;  ///< ascending
  CellCutter cutter = CellCutter(' ', false);
  std::vector<std::size_t> columns = {0, 1};  ///< of x, y and, in space, z
  /// Set if x and y come from columns of longitude and latitude.
  std::optional<LocalPlane> plane;
  bool counts_to_360 = false;  ///< longitudes go to 360, not from -180 to 180

 private:
  /// The numbers to write in the columns.
  [[nodiscard]] Vector3 numbers_at(const Vector3& position) const;
  [[nodiscard]] std::string_view text_of(const Row& row) const;
  /// A row with new numbers in the columns whose value changed. by_place: which column comes first, second and third in
  /// a row.
  [[nodiscard]] std::string with_numbers(std::string_view row, std::size_t node, const Vector3& place,
                                         const std::vector<std::size_t>& by_place) const;
};

/// The number in a column of a row. name: of the column. Throws Error(unusable_file) naming the line and a cell that is
/// missing or no number.
double number_in(const InputFile& file, const TableLine& line, std::span<const std::string_view> cells,
                 std::size_t column, std::string_view name, char decimal_mark);

/// Gathers the nodes of a table. Blank lines end chains.
class TableReader {
 public:
  /// degrees: the first two columns are longitude and latitude, which are the positions until take().
  TableReader(const InputFile& file, CellCutter cutter, std::vector<std::size_t> columns, bool degrees = false);

  /// Reads every row of the lines.
  void read(std::span<const TableLine> lines);
  /// The position that a row gives. Throws what number_in() throws.
  [[nodiscard]] Vector3 position_in(const TableLine& line);
  /// Adds a node, or another row of the first one.
  void add_node(const TableLine& line, const Vector3& position);
  void add_row(const TableLine& line, Index node) { source_->rows.push_back({line.offset, node}); }
  void carry(const char* what) { carried_.insert(what); }

  [[nodiscard]] const std::vector<Vector3>& positions() const { return source_->positions; }
  std::vector<PolygonCurve::Chain> chains;

  /// Returns the curve, with a warning of rows that repeat the one above; `file` becomes the source's. plane: of
  /// degrees, see take_to_plane(). Throws Error(unusable_file) if the rows are no curve.
  CurveFile take(InputFile file, CurveFormat format, const std::optional<LocalPlane>& plane = std::nullopt);

 private:
  const InputFile& file_;
  bool degrees_;
  std::shared_ptr<TableSource> source_ = std::make_shared<TableSource>();
  std::set<std::string> carried_;
  std::vector<std::size_t> repeats_;  ///< offsets of rows with the position of the row above
};

/// The columns of a table of points.
struct PointColumns {
  std::vector<std::size_t> coordinates;
  std::optional<std::size_t> weight = std::nullopt;
  std::vector<std::size_t> normal = {};  ///< three or none
  bool degrees = false;                  ///< the first two coordinates are longitude and latitude
};

/// Checks the cells of a row; throws to refuse it.
using RowCheck = std::function<void(const TableLine&, std::span<const std::string_view>)>;

/// Reads the points of the rows from the offset `behind` on. Throws what number_in() throws, and for an invalid weight.
/// plane: of degrees, see take_to_plane().
ScatteredPoints read_point_rows(const InputFile& file, CellCutter cutter, const PointColumns& columns,
                                std::size_t behind, const RowCheck& check = {},
                                const std::optional<LocalPlane>& plane = std::nullopt);

/// Calls use(position) for each node along the chains, for the first one of a closed chain once more at its end, and
/// begin_next() between two chains.
template <typename Use, typename BeginNext>
void walk_rows(const FreshCurve& curve, const Use& use, const BeginNext& begin_next) {
  bool first = true;
  for (const PolygonCurve::Chain& chain : curve.chains) {
    if (chain.nodes.empty()) continue;
    if (!first) begin_next();
    first = false;
    for (const Index node : chain.nodes) use(curve.positions[static_cast<std::size_t>(node)]);
    if (chain.closed) use(curve.positions[static_cast<std::size_t>(chain.nodes.front())]);
  }
}

/// Appends a row for each node along the chains, with a blank row between two chains.
void append_rows(std::string& text, const FreshCurve& curve, char between);

/// Adds what rows without node numbers lose.
void name_losses_of_rows(const FreshCurve& curve, std::vector<std::string>& losses);

}  // namespace vspring
