#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/curve_file.hpp"

namespace vspring {

/// The bytes of a file and, in the formats that derive from it, where its coordinates are.
class CurveSource {
 public:
  CurveSource() = default;
  virtual ~CurveSource() = default;
  CurveSource(const CurveSource&) = delete;
  CurveSource& operator=(const CurveSource&) = delete;

  /// What to change in the file.
  struct Rewriting {
    const std::vector<Vector3>& places;
    const std::vector<std::uint8_t>& moved;  ///< 1 for nodes that get new coordinates
    const std::vector<Index>& row_order;     ///< see CurveFile

    /// The node whose row takes the place of that of `slot`.
    [[nodiscard]] std::size_t node_in(std::size_t slot) const {
      return row_order.empty() ? slot : static_cast<std::size_t>(row_order[slot]);
    }
  };

  /// The bytes with new coordinates of moved nodes, and rows in their new order, if any. Cost: linear.
  [[nodiscard]] virtual std::string rewritten(const Rewriting& what) const = 0;

  InputFile file;
  std::vector<Vector3> positions;    ///< as the file gives them
  bool has_rows = false;             ///< each node has its own row, and only rows give the order
  std::vector<std::string> carried;  ///< what is lost in other formats, one line each
};

/// The entry of CurveSource::carried for the curve's name, which DAT can hold.
inline constexpr const char* name_carried = "the name";
/// That for the header of a table, which CSV can hold.
inline constexpr const char* column_names_carried = "names of columns";

/// Each reads a whole file of its format. They throw Error(unusable_file), and Error(invalid_argument) for an invalid
/// choice of columns.
CurveFile read_obj_curve(InputFile file);
CurveFile read_csv_curve(InputFile file, const ColumnChoice& choice, const std::optional<LocalPlane>& plane);
CurveFile read_dat_curve(InputFile file);
CurveFile read_xyz_curve(InputFile file, const ColumnChoice& choice, const std::optional<LocalPlane>& plane);
CurveFile read_gpx_curve(InputFile file, const ColumnChoice& choice, const std::optional<LocalPlane>& plane);

/// A curve to make a new file from.
struct FreshCurve {
  const std::vector<PolygonCurve::Chain>& chains;
  std::span<const Vector3> positions;
  bool planar;  ///< two coordinates
  std::string name;
  const LocalPlane* plane = nullptr;  ///< set if its positions come from degrees
};

/// Makes a file, not SVG, from a curve alone. losses: gets what the format cannot hold. Throws Error(invalid_argument)
/// for DAT of several chains or of a curve in space, and for GPX without a plane.
std::string fresh_curve(CurveFormat format, const FreshCurve& curve, std::vector<std::string>& losses);

/// Make such files of one format each. Numbers in rows are separated by commas in CSV, else by blanks. CSV and GPX get
/// degrees if there is a plane.
std::string fresh_curve_obj(const FreshCurve& curve);
std::string fresh_csv(const FreshCurve& curve, std::vector<std::string>& losses);
std::string fresh_dat(const FreshCurve& curve, std::vector<std::string>& losses);
std::string fresh_xyz(const FreshCurve& curve, std::vector<std::string>& losses);
std::string fresh_gpx(const FreshCurve& curve, std::vector<std::string>& losses);

/// The first node that does not lie in the plane z = 0, or the number of nodes.
std::size_t first_off_plane(std::span<const Vector3> positions);

}  // namespace vspring
