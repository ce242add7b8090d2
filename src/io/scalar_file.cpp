#include "vspring/scalar_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "io/formats.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"

namespace vspring {
namespace {

constexpr std::array scalar_format_names = {"vtp", "ply"};
constexpr Formats<ScalarFormat> scalar_formats(scalar_format_names);

void check(const std::vector<Vector3>& positions, std::span<const NodeScalar> scalars) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  for (std::size_t node = 0; node < positions.size(); ++node) {
    if (!positions[node].allFinite())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("node {}: its position is not finite, which these files cannot hold", node));
  }
  for (const NodeScalar& scalar : scalars) {
    if (scalar.name.empty() || !std::all_of(scalar.name.begin(), scalar.name.end(), plain))
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("\"{}\": name what is written by letters, digits and underscores", scalar.name));
    if (scalar.values.size() != positions.size())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}: {} values given for {} nodes", scalar.name, scalar.values.size(), positions.size()));
    const auto odd =
        std::find_if(scalar.values.begin(), scalar.values.end(), [](double v) { return !std::isfinite(v); });
    if (odd != scalar.values.end())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}: the value of node {} is not finite", scalar.name, odd - scalar.values.begin()));
  }
}

/// Writes data arrays of VTK's XML.
class VtpWriter {
 public:
  VtpWriter(const std::vector<Vector3>& positions, std::span<const NodeScalar> scalars, const char* cells,
            std::size_t cell_count)
      : cells_(cells) {
    const bool lines = cells_ == std::string_view("Lines");
    text_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        positions.size(), lines ? cell_count : 0, lines ? 0 : cell_count);
    text_.reserve(text_.size() + (60 + 20 * scalars.size()) * positions.size() + 40 * cell_count);
    text_ += "<PointData>\n";
    for (const NodeScalar& scalar : scalars) {
      array("Float64", scalar.name, "", [&] {
        for (const double value : scalar.values) number(value, '\n');
      });
    }
    text_ += "</PointData>\n<Points>\n";
    array("Float64", "Points", " NumberOfComponents=\"3\"", [&] {
      for (const Vector3& position : positions) {
        number(position.x(), ' ');
        number(position.y(), ' ');
        number(position.z(), '\n');
      }
    });
    text_ += fmt::format("</Points>\n<{}>\n", cells_);
  }

  /// for_each(action) calls action with the nodes of every cell, in order.
  template <typename ForEach>
  std::string finish(const ForEach& for_each) {
    array("Int64", "connectivity", "", [&] {
      for_each([&](std::span<const Index> nodes) {
        for (const Index node : nodes) whole(static_cast<std::size_t>(node), ' ');
        text_.back() = '\n';
      });
    });
    array("Int64", "offsets", "", [&] {
      std::size_t end = 0;
      for_each([&](std::span<const Index> nodes) { whole(end += nodes.size(), '\n'); });
    });
    text_ += fmt::format("</{}>\n</Piece>\n</PolyData>\n</VTKFile>\n", cells_);
    return std::move(text_);
  }

 private:
  template <typename Content>
  void array(const char* type, const std::string& name, const char* more, const Content& content) {
    text_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"ascii\">\n", type, name, more);
    content();
    text_ += "</DataArray>\n";
  }
  void number(double value, char end) {
    append_number(text_, value);
    text_ += end;
  }
  void whole(std::size_t value, char end) { (text_ += fmt::format_int(value).c_str()) += end; }

  const char* cells_;
  std::string text_;
};

std::string vtp(const PolygonMesh& mesh, std::span<const NodeScalar> scalars) {
  VtpWriter writer(mesh.positions(), scalars, "Polys", static_cast<std::size_t>(mesh.face_count()));
  return writer.finish([&](const auto& action) {
    for (Index f = 0; f < mesh.face_count(); ++f) action(mesh.face(f));
  });
}

std::string vtp(const PolygonCurve& curve, std::span<const NodeScalar> scalars) {
  VtpWriter writer(curve.positions(), scalars, "Lines", curve.chains().size());
  return writer.finish([&](const auto& action) {
    for (const PolygonCurve::Chain& chain : curve.chains()) {
      std::vector<Index> nodes = chain.nodes;
      if (chain.closed && !nodes.empty()) nodes.push_back(nodes.front());
      action(std::span<const Index>(nodes));
    }
  });
}

}  // namespace

std::optional<ScalarFormat> scalar_format(std::string_view extension) { return scalar_formats.of_extension(extension); }

FileBytes scalar_bytes(const std::string& name, const PolygonMesh& mesh, std::span<const NodeScalar> scalars) {
  const ScalarFormat format = scalar_formats.to_write(name, std::nullopt, std::nullopt);
  check(mesh.positions(), scalars);
  return {format == ScalarFormat::vtp ? vtp(mesh, scalars) : fresh_ply(mesh, mesh.positions(), {}, scalars)};
}

FileBytes scalar_bytes(const std::string& name, const PolygonCurve& curve, std::span<const NodeScalar> scalars) {
  if (scalar_formats.to_write(name, std::nullopt, std::nullopt) == ScalarFormat::ply)
    throw Error(ErrorCode::invalid_argument, name + ": PLY holds surfaces; write the numbers of a curve as .vtp");
  check(curve.positions(), scalars);
  return {vtp(curve, scalars)};
}

void write_scalars(const std::string& path, const PolygonMesh& mesh, std::span<const NodeScalar> scalars) {
  write_file(path, scalar_bytes(path, mesh, scalars).bytes);
}

void write_scalars(const std::string& path, const PolygonCurve& curve, std::span<const NodeScalar> scalars) {
  write_file(path, scalar_bytes(path, curve, scalars).bytes);
}

}  // namespace vspring
