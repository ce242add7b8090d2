// Rows of numbers as points, with weights and normals or without.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/column_names.hpp"
#include "io/csv_layout.hpp"
#include "io/face_list.hpp"
#include "io/point_source.hpp"
#include "io/table_source.hpp"

namespace vspring {
namespace {

/// Where a row has what.
struct Columns {
  std::vector<std::size_t> coordinates;
  std::optional<std::size_t> weight;
  std::vector<std::size_t> normal = {};  ///< three or none
};

/// Reads the rows behind an offset. check(line, cells) may refuse one.
template <typename Check>
ScatteredPoints read_rows(const InputFile& file, CellCutter cutter, const Columns& columns, std::size_t behind,
                          const Check& check) {
  constexpr std::array names = {"x", "y", "z"};
  constexpr std::array normal_names = {"nx", "ny", "nz"};
  ScatteredPoints points;
  // Room that is not used is never touched.
  const auto lines =
      static_cast<std::size_t>(std::count(file.bytes.begin(), file.bytes.end(), line_end_of(file.bytes))) + 1;
  points.positions.reserve(lines);
  if (columns.weight) points.weights.reserve(lines);
  if (!columns.normal.empty()) points.normals.reserve(lines);
  walk_lines(file.bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row || line.offset < behind) return true;
    if (static_cast<std::int64_t>(points.positions.size()) == most_nodes)
      file.refuse_line(line.offset, "more than 2^30 points; split the file");
    const std::vector<std::string_view>& cells = cutter.cut(line.text);
    check(line, cells);
    const auto vector_in = [&](const std::vector<std::size_t>& of, const std::array<const char*, 3>& named) {
      Vector3 vector = Vector3::Zero();
      for (std::size_t k = 0; k < of.size(); ++k)
        vector[static_cast<Eigen::Index>(k)] = number_in(file, line, cells, of[k], named[k]);
      return vector;
    };
    points.positions.push_back(vector_in(columns.coordinates, names));
    if (!columns.normal.empty()) points.normals.push_back(vector_in(columns.normal, normal_names));
    if (!columns.weight) return true;
    const double weight = points.weights.emplace_back(number_in(file, line, cells, *columns.weight, "the weight"));
    if (!is_point_weight(weight))
      file.refuse_line(line.offset, fmt::format("the weight is {}; give 0 or more", weight));
    return true;
  });
  return points;
}

/// The numbers that a row begins with.
std::size_t count_leading_numbers(const std::vector<std::string_view>& cells) {
  const auto end = std::find_if(cells.begin(), cells.end(), [](std::string_view cell) { return !number_of(cell); });
  return static_cast<std::size_t>(end - cells.begin());
}

/// Whether numbers four to six are a normal, and not a colour.
bool is_unit_or_zero(const std::vector<std::string_view>& cells) {
  const Vector3 vector(*number_of(cells[3]), *number_of(cells[4]), *number_of(cells[5]));
  return is_point_normal(vector);
}

}  // namespace

ScatteredPoints read_csv_points(const InputFile& file, const ColumnChoice& choice) {
  const CsvLayout layout = find_csv_layout(file, choice);
  ScatteredPoints points = read_rows(file, layout.cutter, {layout.columns, layout.weight, layout.normal},
                                     layout.header ? *layout.header + 1 : 0, [](const TableLine&, const auto&) {});
  if (!layout.warning.empty()) points.warnings.push_back(layout.warning);
  return points;
}

ScatteredPoints read_xyz_points(const InputFile& file, const ColumnChoice& choice) {
  CellCutter cutter(' ', false);
  std::size_t numbers = 0;
  std::size_t cells_of_first = 0;
  bool faces = false;
  std::vector<std::size_t> chosen;
  walk_lines(file.bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row) return true;
    const std::vector<std::string_view>& cells = cutter.cut(line.text);
    numbers = count_leading_numbers(cells);
    cells_of_first = cells.size();
    if (!choice.empty()) {
      chosen = chosen_columns(file, cells, line.offset, choice);
      require_columns(file, cells, line.offset, chosen);
    }
    faces = (numbers == 6 || numbers == 7) && numbers == cells_of_first && is_unit_or_zero(cells);
    return false;
  });
  if (cells_of_first == 0) file.refuse("no row of two or three numbers is in it; choose another file");
  // Where a person says what is what, nothing is guessed.
  if (!choice.empty()) return read_rows(file, cutter, {chosen, std::nullopt}, 0, [](const TableLine&, const auto&) {});
  const bool planar = numbers < 3;
  Columns columns{{0, 1}, std::nullopt};
  if (!planar) columns.coordinates.push_back(2);
  if (numbers == cells_of_first && (numbers == 4 || numbers == 7)) columns.weight = numbers - 1;
  if (faces) columns.normal = {3, 4, 5};
  return read_rows(file, cutter, columns, 0, [&](const TableLine& line, const auto& cells) {
    // Of points in a plane and in space mixed, or with weights and without, some would be misread.
    if ((planar && count_leading_numbers(cells) > 2) || ((columns.weight || faces) && cells.size() != cells_of_first))
      file.refuse_line(line.offset, fmt::format("this row has {} numbers, the first row has {}; correct one of them",
                                                count_leading_numbers(cells), numbers));
  });
}

}  // namespace vspring
