#pragma once

#include <memory>
#include <set>
#include <span>

#include "io/curve_source.hpp"
#include "io/table_rows.hpp"

namespace vspring {

/// A file of rows that give the position of one node each.
class TableSource : public CurveSource {
 public:
  [[nodiscard]] std::string rewritten(const std::vector<Vector3>& places,
                                      const std::vector<std::uint8_t>& moved) const override;

  struct Row {
    std::size_t offset;
    Index node;  ///< two rows may give the same node
  };
  std::vector<Row> rows;  ///< ascending
  CellCutter cutter = CellCutter(' ', false);
  std::vector<std::size_t> columns = {0, 1};  ///< of x, y and, in space, z
};

/// The number in a column of a row. Throws Error(unusable_file) naming the line and what is missing or is no number;
/// name: of the column.
double number_in(const InputFile& file, const TableLine& line, std::span<const std::string_view> cells,
                 std::size_t column, std::string_view name);

/// Gathers the nodes of a table. Blank lines end chains.
class TableReader {
 public:
  TableReader(const InputFile& file, CellCutter cutter, std::vector<std::size_t> columns);

  /// Reads every row of the lines.
  void read(std::span<const TableLine> lines);
  /// The position that a row gives. Throws as number_in().
  [[nodiscard]] Vector3 position_in(const TableLine& line);
  /// Adds a node, or another row of the one before all others.
  void add_node(const TableLine& line, const Vector3& position);
  void add_row(const TableLine& line, Index node) { source_->rows.push_back({line.offset, node}); }
  void carry(const char* what) { carried_.insert(what); }

  [[nodiscard]] const std::vector<Vector3>& positions() const { return source_->positions; }
  std::vector<PolygonCurve::Chain> chains;

  /// Hands over what was read; file becomes the source's. Throws Error(unusable_file) where it is no curve.
  CurveFile take(InputFile file, CurveFormat format);

 private:
  const InputFile& file_;
  std::shared_ptr<TableSource> source_ = std::make_shared<TableSource>();
  std::set<std::string> carried_;
};

}  // namespace vspring
