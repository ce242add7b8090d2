// An open or drawn curve: its constraints and its fair shape.

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "points.hpp"
#include "region.hpp"
#include "spanning.hpp"
#include "values.hpp"

namespace vspring {

namespace {

/// An open curve. Members that Surface has, too, have the same names there.
class Curve {
 public:
  /// bytes: a Uint8Array. name: of the file, for its format and for messages.
  Curve(const val& bytes, const std::string& name)
      : Curve(forwarding_errors([&] { return read_curve_bytes(bytes.as<std::string>(), name); })) {}

  /// One chain through drawn places; of two columns if all have z = 0.
  static Curve through(const val& positions, bool closed) {
    CurveFile file;
    file.curve = forwarding_errors([&] { return PolygonCurve(vectors_of(positions), closed); });
    const auto& places = file.curve.positions();
    file.planar = std::all_of(places.begin(), places.end(), [](const Vector3& place) { return place.z() == 0; });
    return Curve(std::move(file));
  }

  [[nodiscard]] int node_count() const { return file_.curve.node_count(); }
  [[nodiscard]] val positions() const { return positions_array(positions_); }
  /// Where each chain begins in chain_nodes(), and the size of that.
  [[nodiscard]] val chain_begin() const {
    std::vector<Index> begin = {0};
    for (const auto& chain : file_.curve.chains())
      begin.push_back(begin.back() + static_cast<Index>(chain.nodes.size()));
    return array_of("Int32Array", begin.size(), begin.data());
  }
  [[nodiscard]] val chain_nodes() const {
    std::vector<Index> nodes;
    for (const auto& chain : file_.curve.chains()) nodes.insert(nodes.end(), chain.nodes.begin(), chain.nodes.end());
    return array_of("Int32Array", nodes.size(), nodes.data());
  }
  /// 1 for every closed chain.
  [[nodiscard]] val closed() const {
    std::vector<std::uint8_t> closed;
    for (const auto& chain : file_.curve.chains()) closed.push_back(chain.closed ? 1 : 0);
    return array_of("Uint8Array", closed.size(), closed.data());
  }
  /// 1 for every end of a chain.
  [[nodiscard]] val boundary() const {
    const auto nodes = boundary_nodes(file_.curve);
    return array_of("Uint8Array", nodes.size(), nodes.data());
  }
  /// Whether the file has two coordinates a node.
  [[nodiscard]] bool planar() const { return file_.planar; }
  [[nodiscard]] val warnings() const { return list_of(file_.warnings); }

  val set_symmetry(const std::string& plane) {
    return forwarding_errors([&] {
      std::optional<Symmetric<PolygonCurve>> found;
      if (!plane.empty()) found = find_symmetry(file_.curve, parse_plane(plane));
      symmetric_ = std::move(found);
      constraints_.emplace(whole().node_count());
      return symmetric_ ? to_val(*symmetric_) : val::null();
    });
  }
  void set_rules(const std::string& json) {
    forwarding_errors([&] {
      Constraints constraints(whole().node_count());
      apply_rules(constraints, whole(), json, {.groups = &file_.groups, .named_nodes = file_.curve.node_count()});
      constraints_ = std::move(constraints);
    });
  }
  void hold_position(Index node, double x, double y, double z) {
    forwarding_errors([&] { constraints_->fix_position(node, Vector3(x, y, z)); });
  }
  void free_position(Index node) {
    forwarding_errors([&] { constraints_->free_position(node); });
  }
  void hold_tangent(Index node, double x, double y, double z) {
    forwarding_errors([&] { constraints_->fix_tangent(node, Vector3(x, y, z)); });
  }
  void free_tangent(Index node) {
    forwarding_errors([&] { constraints_->free_tangent(node); });
  }

  /// `nodes` with a given tangent, and their `tangents`, three numbers each.
  [[nodiscard]] val held_tangents() const {
    std::vector<Index> nodes;
    std::vector<Vector3> tangents;
    for (Index node = 0; node < node_count(); ++node) {
      if (!constraints_->tangent_fixed(node)) continue;
      nodes.push_back(node);
      tangents.push_back(constraints_->tangent(node));
    }
    val result = val::object();
    result.set("nodes", array_of("Int32Array", nodes.size(), nodes.data()));
    result.set("tangents", positions_array(tangents));
    return result;
  }

  /// Further constraints so that only `nodes` move from a shape of these positions: `fixed`, nodes that stay, and `rim`
  /// with its `tangents`, three numbers each.
  [[nodiscard]] val region(const val& nodes, const val& positions) const {
    return region_of(*constraints_, file_.curve, nodes, positions,
                     {"tangents", &Constraints::tangent_fixed, &Constraints::tangent});
  }
  /// The estimated standard deviation of the nodes in each coordinate; 0 if unknown.
  [[nodiscard]] double noise() const {
    return forwarding_errors([&] { return estimate_noise(file_.curve).deviation; });
  }

  /// Spans the chains of the file, where its nodes are now, with a fair surface. The curve stays as it is.
  [[nodiscard]] val span(const val& settings, const val& progress) const {
    return forwarding_errors([&] {
      Context context;
      context.threads = threads();
      ask(context, progress);
      PolygonCurve curves = file_.curve;
      curves.set_positions(positions_);
      return to_val(span_curves(curves, span_options_of(settings), context));
    });
  }

  /// Replaces the nodes between held ones by evenly spaced ones, `nodes` in all. Returns for every node its number
  /// before, -1 for new ones.
  val resample(Index nodes) {
    return forwarding_errors([&] {
      if (symmetric_)
        throw Error(ErrorCode::invalid_argument,
                    "symmetry keeps the nodes of the curve; take it away, or resample before");
      Resampled even = vspring::resample(file_.curve, *constraints_, {.nodes = nodes});
      // Other data of the file belong to nodes that no longer exist.
      file_.source = nullptr;
      file_.groups.clear();
      file_.curve = std::move(even.curve);
      constraints_ = std::move(even.constraints);
      positions_ = file_.curve.positions();
      return array_of("Int32Array", even.from.size(), even.from.data());
    });
  }

  /// Replaces nodes and chains, as when some are inserted or deleted. from: for every node its number before, −1 for
  /// new ones. Groups keep remaining nodes; constraints are dropped.
  void set_nodes(const val& positions, const val& chain_begin, const val& chain_nodes, const val& closed,
                 const val& from) {
    forwarding_errors([&] {
      const auto numbers = [](const val& array) { return emscripten::convertJSArrayToNumberVector<Index>(array); };
      const std::vector<Index> begin = numbers(chain_begin);
      const std::vector<Index> nodes = numbers(chain_nodes);
      const std::vector<Index> loops = numbers(closed);
      std::vector<PolygonCurve::Chain> chains(loops.size());
      for (std::size_t c = 0; c < chains.size(); ++c)
        chains[c] = {.nodes = {nodes.begin() + begin[c], nodes.begin() + begin[c + 1]}, .closed = loops[c] != 0};
      PolygonCurve curve(vectors_of(positions), std::move(chains));
      std::map<Index, Index> now;
      const std::vector<Index> before = numbers(from);
      for (std::size_t node = 0; node < before.size(); ++node) now[before[node]] = static_cast<Index>(node);
      for (auto& [name, members] : file_.groups) {
        std::vector<Index> kept;
        for (const Index member : members)
          if (const auto found = now.find(member); found != now.end()) kept.push_back(found->second);
        std::sort(kept.begin(), kept.end());
        members = std::move(kept);
      }
      file_.source = nullptr;
      file_.curve = std::move(curve);
      symmetric_.reset();
      constraints_.emplace(file_.curve.node_count());
      positions_ = file_.curve.positions();
    });
  }

  /// Sets whether it meets the curvature of what is held beside it, and not only tangents.
  void set_continuity(bool curvature) { options_.continuity = curvature ? Continuity::curvature : Continuity::tangent; }

  /// Always from the file's shape, as curves take little time.
  val fair(const val& progress) {
    return forwarding_errors([&] {
      Context context;
      context.threads = threads();
      ask(context, progress);
      FairResult result = symmetric_ ? vspring::fair(*symmetric_, *constraints_, options_, context)
                                     : vspring::fair(file_.curve, *constraints_, options_, context);
      positions_ = std::move(result.positions);
      return to_val(result.report);
    });
  }

  /// Fits the file's shape to points.
  val fit(const Points& points, const val& settings, const val& progress) {
    const auto fit_any = [&](const auto& shape) {
      return fit_to(points, settings, progress, shape, *constraints_, positions_);
    };
    return symmetric_ ? fit_any(*symmetric_) : fit_any(file_.curve);
  }

  /// The bytes of a file of that name, with the last shape; a picture has the first one behind it.
  [[nodiscard]] val write(const std::string& name) const {
    return forwarding_errors(
        [&] { return bytes_array(curve_bytes(name, file_, positions_, std::nullopt, {.before = &file_.curve})); });
  }
  void set_positions(const val& positions) {
    forwarding_errors([&] {
      PolygonCurve curve = file_.curve;
      curve.set_positions(vectors_of(positions));
      positions_ = curve.positions();
    });
  }

 private:
  /// What constraints are for; its first nodes are those of the file.
  [[nodiscard]] const PolygonCurve& whole() const { return symmetric_ ? symmetric_->whole : file_.curve; }

  explicit Curve(CurveFile file)
      : file_(std::move(file)), positions_(file_.curve.positions()), constraints_(file_.curve.node_count()) {}

  CurveFile file_;
  std::vector<Vector3> positions_;
  std::optional<Symmetric<PolygonCurve>> symmetric_;
  std::optional<Constraints> constraints_;
  FairOptions options_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(vspring_curve) {
  emscripten::class_<Curve>("Curve")
      .constructor<val, std::string>()
      .class_function("through", &Curve::through)
      .function("nodeCount", &Curve::node_count)
      .function("positions", &Curve::positions)
      .function("chainBegin", &Curve::chain_begin)
      .function("chainNodes", &Curve::chain_nodes)
      .function("closed", &Curve::closed)
      .function("boundary", &Curve::boundary)
      .function("planar", &Curve::planar)
      .function("warnings", &Curve::warnings)
      .function("setSymmetry", &Curve::set_symmetry)
      .function("setRules", &Curve::set_rules)
      .function("holdPosition", &Curve::hold_position)
      .function("freePosition", &Curve::free_position)
      .function("holdTangent", &Curve::hold_tangent)
      .function("freeTangent", &Curve::free_tangent)
      .function("heldTangents", &Curve::held_tangents)
      .function("region", &Curve::region)
      .function("noise", &Curve::noise)
      .function("resample", &Curve::resample)
      .function("setNodes", &Curve::set_nodes)
      .function("setContinuity", &Curve::set_continuity)
      .function("fair", &Curve::fair)
      .function("update", &Curve::fair)
      .function("fit", &Curve::fit)
      .function("span", &Curve::span)
      .function("write", &Curve::write)
      .function("setPositions", &Curve::set_positions);
}

}  // namespace vspring
