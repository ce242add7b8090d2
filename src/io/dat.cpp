// DAT: coordinates of aerofoils as Selig and as Lednicer arranged them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/table.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

using Lines = std::span<const TableLine>;

bool is_row(const TableLine& line) { return line.kind == TableLine::Kind::row; }

class DatReader {
 public:
  explicit DatReader(const InputFile& file)
      : file_(file), lines_(table_lines(file.bytes)), rest_(lines_), reader_(file, cutter_, {0, 1}) {}

  void read();
  CurveFile take(InputFile file);

 private:
  void skip_to_row();
  bool is_place(const TableLine& line);
  bool is_name_of_numbers();
  void read_name();
  void read_more_words();
  void warn_at(const TableLine& line, const char* what);
  bool read_counts();
  void read_sides();
  void refuse_third_numbers();

  const InputFile& file_;
  std::vector<TableLine> lines_;
  Lines rest_;
  CellCutter cutter_ = CellCutter(' ', false);
  TableReader reader_;
  std::string name_;
  std::vector<std::string> warnings_;
  std::array<std::size_t, 2> counts_ = {0, 0};  ///< of nodes of the upper and lower side
};

void DatReader::skip_to_row() {
  for (; !rest_.empty() && !is_row(rest_.front()); rest_ = rest_.subspan(1)) {
    if (rest_.front().kind == TableLine::Kind::comment) reader_.carry("comments");
  }
}

bool DatReader::is_place(const TableLine& line) {
  const std::vector<std::string_view>& cells = cutter_.cut(line.text);
  return cells.size() > 1 && number_of(cells[0]) && number_of(cells[1]);
}

/// Whether the first row is two whole numbers, such as "0012 64", that are no place beside the rows below and do not
/// count them.
bool DatReader::is_name_of_numbers() {
  const std::vector<std::string_view> cells = cutter_.cut(rest_.front().text);
  constexpr const char* digits = "0123456789";
  const auto is_whole = [&](std::string_view cell) { return cell.find_first_not_of(digits) == std::string_view::npos; };
  if (cells.size() != 2 || !std::all_of(cells.begin(), cells.end(), is_whole)) return false;
  if (rest_.size() < 2 || !is_row(rest_[1])) return false;
  const double here = std::max(*number_of(cells[0]), *number_of(cells[1]));
  double greatest = 0;
  std::size_t rows = 0;
  for (const TableLine& line : rest_.subspan(1)) {
    if (!is_row(line)) continue;
    ++rows;
    for (const std::string_view cell : cutter_.cut(line.text))
      greatest = std::max(greatest, std::abs(number_of(cell).value_or(0)));
  }
  constexpr double far = 2;
  return here > far * greatest && *number_of(cells[0]) + *number_of(cells[1]) != static_cast<double>(rows);
}

/// The first row is the name unless it is a place.
void DatReader::read_name() {
  skip_to_row();
  if (rest_.empty()) return;
  const TableLine& first = rest_.front();
  if (is_place(first)) {
    if (!is_name_of_numbers()) return;
    warn_at(first, "these two numbers lie far from all others, and are taken for the name");
  }
  name_ = trimmed(first.text);
  reader_.carry(name_carried);
  rest_ = rest_.subspan(1);
  read_more_words();
}

/// Passes over lines of words below the name. A place that is misspelt has a number.
void DatReader::read_more_words() {
  const auto has_number = [&](const TableLine& line) {
    const std::vector<std::string_view>& cells = cutter_.cut(line.text);
    return std::any_of(cells.begin(), cells.begin() + std::min<std::ptrdiff_t>(2, std::ssize(cells)),
                       [](std::string_view cell) { return number_of(cell).has_value(); });
  };
  const auto next =
      std::find_if(rest_.begin(), rest_.end(), [&](const TableLine& line) { return is_row(line) && has_number(line); });
  if (next == rest_.end() || !is_place(*next)) return;
  const auto words = std::find_if(rest_.begin(), next, is_row);
  if (words == next) return;
  warn_at(*words, "this line of words is taken for a part of the name");
  reader_.carry("words below the name");
  rest_ = rest_.subspan(static_cast<std::size_t>(next - rest_.begin()));
}

void DatReader::warn_at(const TableLine& line, const char* what) {
  warnings_.push_back(fmt::format("{}:{}: {}", file_.name, file_.line_of(line.offset), what));
}

/// Lednicer's files give the number of nodes of each side: two whole numbers above 1, which cannot be a place on an
/// aerofoil.
bool DatReader::read_counts() {
  skip_to_row();
  if (rest_.empty()) return false;
  const std::vector<std::string_view>& cells = cutter_.cut(rest_.front().text);
  if (cells.size() != 2) return false;
  for (std::size_t side = 0; side < 2; ++side) {
    const double count = number_of(cells[side]).value_or(0);
    if (!(count > 1 && count < 1e9 && count == std::floor(count))) return false;
    counts_[side] = static_cast<std::size_t>(count);
  }
  const auto rows = static_cast<std::size_t>(std::count_if(rest_.begin(), rest_.end(), is_row)) - 1;
  if (rows == counts_[0] + counts_[1]) return true;
  // A Selig file in millimetres may begin with such numbers, too, but goes on in the next line.
  const bool apart = rest_.size() < 2 || !is_row(rest_[1]);
  if (apart)
    file_.refuse_line(
        rest_.front().offset,
        fmt::format("this line counts {} and {} points, but {} follow; correct the counts or restore what is "
                    "missing",
                    counts_[0], counts_[1], rows));
  return false;
}

void DatReader::read_sides() {
  std::array<std::vector<Index>, 2> sides;
  std::size_t row = 0;
  for (rest_ = rest_.subspan(1), skip_to_row(); !rest_.empty(); rest_ = rest_.subspan(1), skip_to_row(), ++row) {
    const TableLine& line = rest_.front();
    const Vector3 position = reader_.position_in(line);
    const bool lower = row >= counts_[0];
    // The leading edge begins both sides, and is one node.
    if (row == counts_[0] && position == reader_.positions().front()) {
      reader_.add_row(line, 0);
      continue;
    }
    sides[lower ? 1 : 0].push_back(static_cast<Index>(reader_.positions().size()));
    reader_.add_node(line, position);
  }
  PolygonCurve::Chain& chain = reader_.chains.emplace_back();
  chain.nodes.assign(sides[0].rbegin(), sides[0].rend());
  chain.nodes.insert(chain.nodes.end(), sides[1].begin(), sides[1].end());
  reader_.carry("the order of nodes by sides");
}

void DatReader::refuse_third_numbers() {
  for (const TableLine& line : rest_) {
    if (!is_row(line)) continue;
    const std::vector<std::string_view>& cells = cutter_.cut(line.text);
    if (cells.size() > 2 && number_of(cells[2]))
      file_.refuse_line(line.offset, "a third number, where an aerofoil has x and y; name another format, such as xyz");
  }
}

void DatReader::read() {
  read_name();
  refuse_third_numbers();
  if (read_counts())
    read_sides();
  else
    reader_.read(rest_);
}

CurveFile DatReader::take(InputFile file) {
  CurveFile curve = reader_.take(std::move(file), CurveFormat::dat);
  curve.name = std::move(name_);
  curve.warnings.insert(curve.warnings.begin(), warnings_.begin(), warnings_.end());
  return curve;
}

void check_aerofoil(const FreshCurve& curve) {
  if (curve.chains.size() != 1)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("DAT holds one chain, and the curve has {}; write another format", curve.chains.size()));
  if (const std::size_t node = first_off_plane(curve.positions); node < curve.positions.size())
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("node {}: it is not in the plane z = 0, where DAT has its nodes; write another format", node));
}

}  // namespace

CurveFile read_dat_curve(InputFile file) {
  DatReader reader(file);
  reader.read();
  return reader.take(std::move(file));
}

std::string fresh_dat(const FreshCurve& curve, std::vector<std::string>& losses) {
  check_aerofoil(curve);
  name_losses_of_rows(curve, losses);
  std::string text = (curve.name.empty() ? "curve" : curve.name) + "\n";
  append_rows(text, {curve.chains, curve.positions, true, ""}, ' ');
  return text;
}

}  // namespace vspring
