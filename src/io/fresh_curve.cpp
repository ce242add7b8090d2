#include "io/fresh_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "io/text_rewriter.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

void append_row(std::string& text, const Vector3& position, int count, char between) {
  for (int k = 0; k < count; ++k) {
    if (k > 0) text += between;
    append_number(text, position[k]);
  }
  text += '\n';
}

std::string fresh_curve_obj(const FreshCurve& curve) {
  std::string text;
  text.reserve(70 * curve.positions.size());
  for (const Vector3& position : curve.positions) {
    text += "v ";
    append_row(text, position, 3, ' ');
  }
  for (const PolygonCurve::Chain& chain : curve.chains) {
    if (chain.nodes.size() < 2) continue;
    text += 'l';
    const auto append_node = [&](Index node) {
      text += ' ';
      text += fmt::format_int(node + 1).c_str();
    };
    for (const Index node : chain.nodes) append_node(node);
    if (chain.closed) append_node(chain.nodes.front());
    text += '\n';
  }
  return text;
}

/// Nodes one by one along the chains, with a blank row between two chains.
void append_chains(std::string& text, const FreshCurve& curve, char between) {
  text.reserve(text.size() + 60 * curve.positions.size());
  bool first = true;
  for (const PolygonCurve::Chain& chain : curve.chains) {
    if (chain.nodes.empty()) continue;
    if (!first) text += '\n';
    first = false;
    const auto append_node = [&](Index node) {
      append_row(text, curve.positions[static_cast<std::size_t>(node)], curve.planar ? 2 : 3, between);
    };
    for (const Index node : chain.nodes) append_node(node);
    if (chain.closed) append_node(chain.nodes.front());
  }
}

/// What rows without numbers do not tell.
void name_losses_of_rows(const FreshCurve& curve, std::vector<std::string>& losses) {
  std::vector<std::uint8_t> uses(curve.positions.size(), 0);
  bool shared = false;
  bool closed = false;
  for (const PolygonCurve::Chain& chain : curve.chains) {
    closed = closed || chain.closed;
    for (const Index node : chain.nodes) {
      std::uint8_t& use = uses[static_cast<std::size_t>(node)];
      shared = shared || use != 0;
      use = 1;
    }
  }
  if (closed) losses.emplace_back("that chains are closed: their first node is written again at their end");
  if (shared) losses.emplace_back("that chains share nodes: these are written once for each");
  if (std::find(uses.begin(), uses.end(), 0) != uses.end()) losses.emplace_back("nodes that no chain uses");
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

std::string fresh_curve(CurveFormat format, const FreshCurve& curve, std::vector<std::string>& losses) {
  if (format == CurveFormat::obj) return fresh_curve_obj(curve);
  if (format == CurveFormat::dat) check_aerofoil(curve);
  name_losses_of_rows(curve, losses);
  std::string text;
  if (format == CurveFormat::csv) text = curve.planar ? "x,y\n" : "x,y,z\n";
  if (format != CurveFormat::dat) {
    append_chains(text, curve, format == CurveFormat::csv ? ',' : ' ');
    return text;
  }
  text = (curve.name.empty() ? "curve" : curve.name) + "\n";
  append_chains(text, {curve.chains, curve.positions, true, ""}, ' ');
  return text;
}

std::size_t first_off_plane(std::span<const Vector3> positions) {
  const auto found = std::find_if(positions.begin(), positions.end(), [](const Vector3& p) { return p.z() != 0; });
  return static_cast<std::size_t>(found - positions.begin());
}

}  // namespace vspring
