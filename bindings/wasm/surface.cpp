// An open surface: its constraints and its fair shape.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "filling.hpp"
#include "points.hpp"
#include "region.hpp"
#include "values.hpp"

namespace vspring {

namespace {

// As a share of the size: a fifth of a pixel at 1,000 pixels.
constexpr double picture_tolerance = 2e-4;

val to_val(const SharpEdges& sharp) {
  std::vector<Index> begin = {0};
  std::vector<Index> nodes;
  std::vector<std::uint8_t> closed;
  for (const PolygonCurve::Chain& chain : sharp.chains.chains()) {
    nodes.insert(nodes.end(), chain.nodes.begin(), chain.nodes.end());
    begin.push_back(static_cast<Index>(nodes.size()));
    closed.push_back(chain.closed ? 1 : 0);
  }
  val result = val::object();
  result.set("edges", edges_array(sharp.edges));
  result.set("chainBegin", array_of("Int32Array", begin.size(), begin.data()));
  result.set("chainNodes", array_of("Int32Array", nodes.size(), nodes.data()));
  result.set("closed", array_of("Uint8Array", closed.size(), closed.data()));
  result.set("corners", array_of("Int32Array", sharp.corners.size(), sharp.corners.data()));
  return result;
}

/// An open surface.
class Surface {
 public:
  /// bytes: a Uint8Array. name: of the file, for its format and for messages.
  Surface(const val& bytes, const std::string& name) {
    forwarding_errors([&] { file_ = read_surface_bytes(bytes.as<std::string>(), name); });
    take_mesh();
  }

  [[nodiscard]] int node_count() const { return file_.mesh.node_count(); }
  [[nodiscard]] int face_count() const { return file_.mesh.face_count(); }
  [[nodiscard]] val positions() const { return positions_array(positions_); }
  [[nodiscard]] val face_begin() const {
    const std::vector<Index> begin = file_.mesh.face_begin();
    return array_of("Int32Array", begin.size(), begin.data());
  }
  [[nodiscard]] val corners() const {
    return array_of("Int32Array", file_.mesh.corners().size(), file_.mesh.corners().data());
  }
  /// 1 for every node of a boundary.
  [[nodiscard]] val boundary() const {
    const auto nodes = boundary_nodes(file_.mesh);
    return array_of("Uint8Array", nodes.size(), nodes.data());
  }
  [[nodiscard]] val warnings() const { return list_of(file_.warnings); }

  /// Takes the surface for one that is symmetric about a plane, as parse_plane() has it; empty: for any. Nothing holds
  /// it then. Returns what is found; null for none.
  val set_symmetry(const std::string& plane) {
    return forwarding_errors([&] {
      std::optional<Symmetric<PolygonMesh>> found;
      if (!plane.empty()) found = find_symmetry(file_.mesh, parse_plane(plane));
      symmetric_ = std::move(found);
      let_go();
      return symmetric_ ? to_val(*symmetric_) : val::null();
    });
  }

  /// Replaces the constraints by those of a constraints file, as for the command line.
  void set_rules(const std::string& json) {
    forwarding_errors([&] {
      Constraints constraints(whole().node_count());
      MeshEdges sharp =
          apply_rules(constraints, whole(), json,
                      {.groups = &file_.groups, .normals = &file_.normals, .named_nodes = file_.mesh.node_count()});
      constraints_ = std::move(constraints);
      sharp_by_rules_ = std::move(sharp);
      take_sharp_edges();
    });
  }
  void hold_position(Index node, double x, double y, double z) {
    forwarding_errors([&] { constraints_->fix_position(node, Vector3(x, y, z)); });
  }
  void free_position(Index node) {
    forwarding_errors([&] { constraints_->free_position(node); });
  }
  void hold_normal(Index node, double x, double y, double z) {
    forwarding_errors([&] { constraints_->fix_normal(node, Vector3(x, y, z)); });
  }
  void free_normal(Index node) {
    forwarding_errors([&] { constraints_->free_normal(node); });
  }

  /// Sets whether free boundary nodes are faired first, as curves.
  void set_fair_boundary(bool first) {
    if (first == options_.fair_boundary.has_value()) return;
    session_.reset();
    options_.fair_boundary.reset();
    if (first) options_.fair_boundary.emplace();
  }
  /// Sets whether it meets the curvature of what is around it, and not only tangent planes.
  void set_continuity(bool curvature) {
    const Continuity continuity = curvature ? Continuity::curvature : Continuity::tangent;
    if (std::exchange(options_.continuity, continuity) != continuity) session_.reset();
  }
  /// Edges that stay sharp besides those that rules name, two nodes each.
  void set_sharp_edges(const val& edges) {
    forwarding_errors([&] {
      sharp_edges_ = as_sharp_edges(whole(), edges_of(edges)).edges;
      take_sharp_edges();
    });
  }
  /// Those set and those that rules name.
  [[nodiscard]] val sharp_edges() const { return edges_array(options_.sharp_edges); }
  /// The sharp edges of the file's shape, two nodes each, their chains and corners. noise: of the nodes, as noise()
  /// tells; 0: none.
  [[nodiscard]] val find_sharp_edges(double angle, double noise) const {
    return forwarding_errors([&] {
      Context context;
      context.threads = threads();
      return to_val(vspring::find_sharp_edges(file_.mesh, angle, noise, context));
    });
  }
  /// The edges that the file marks and that can be sharp, two nodes each.
  [[nodiscard]] val marked_edges() const {
    return forwarding_errors([&] {
      std::vector<LeftOutEdge> left_out;
      return edges_array(as_sharp_edges(whole(), vspring::marked_edges(file_), left_out).edges);
    });
  }
  [[nodiscard]] val held_normals() const { return vspring::held_normals(*constraints_); }

  /// Fairs the file's shape. progress(fraction): returning true ends it soon with the best shape so far.
  val fair(const val& progress) {
    session_.reset();
    if (symmetric_) return to_val(fair_symmetric(progress, options_));
    return solve(progress, [&](Context& context) { return to_val(take(session_->fair(*constraints_, context))); });
  }
  /// Fairs from the last shape, if possible, to the accuracy of a picture.
  val update(const val& progress) {
    if (symmetric_) {
      FairOptions options = options_;
      options.method = EquilibriumMethod{.tolerance = picture_tolerance};
      return outcome_of(fair_symmetric(progress, options));
    }
    return solve(progress, [&](Context& context) {
      return outcome_of(take(session_->update(*constraints_, picture_tolerance, context)));
    });
  }

  /// Predicts the shape of update() in less time; null if there is no last shape to start from. Changes nothing.
  [[nodiscard]] val predict() {
    return forwarding_errors([&] {
      if (!session_) return val::null();
      const auto positions = session_->predict(*constraints_, picture_tolerance);
      return positions ? positions_array(*positions) : val::null();
    });
  }

  /// Fits the file's shape to points.
  val fit(const Points& points, const val& settings, const val& progress) {
    const auto fit_any = [&](const auto& shape) {
      return fit_to(points, settings, progress, shape, *constraints_, positions_, options_.sharp_edges);
    };
    val report = symmetric_ ? fit_any(*symmetric_) : fit_any(file_.mesh);
    session_.reset();
    return report;
  }

  /// Fills holes of the file's shape; nodes and faces of patches follow the others. Nothing holds it then.
  val fill(const val& settings, const val& progress) {
    return forwarding_errors([&] {
      Context context;
      context.threads = threads();
      ask(context, progress);
      const FilledHoles filled = fill_holes(file_.mesh, fill_options_of(settings), context);
      add_patches(file_, filled);
      take_mesh();
      return to_val(filled);
    });
  }
  [[nodiscard]] val patches() const { return patches_of(file_); }
  /// Replaces the patches by others; null: by none. Nothing holds it then.
  void set_patches(const val& patches) {
    forwarding_errors([&] {
      vspring::set_patches(file_, patches);
      take_mesh();
    });
  }

  /// Further constraints so that only `nodes` move from a shape of these positions: `fixed`, nodes that stay, and `rim`
  /// with its `normals`, three numbers each.
  [[nodiscard]] val region(const val& nodes, const val& positions) const {
    return region_of(*constraints_, file_.mesh, nodes, positions,
                     {"normals", &Constraints::normal_fixed, &Constraints::normal});
  }
  /// The estimated standard deviation of the nodes in each coordinate; 0 if unknown.
  [[nodiscard]] double noise() const {
    return forwarding_errors([&] { return estimate_noise(file_.mesh).deviation; });
  }
  /// The principal curvatures of the surface with these positions: `k1` and `k2`, k1 not less than k2.
  [[nodiscard]] val curvatures(const val& positions) const {
    return forwarding_errors([&] {
      PolygonMesh mesh = file_.mesh;
      mesh.set_positions(vectors_of(positions));
      Context context;
      context.threads = threads();
      std::vector<double> k1;
      std::vector<double> k2;
      for (const NodeCurvature& at : vspring::curvatures(mesh, context)) {
        k1.push_back(at.k1);
        k2.push_back(at.k2);
      }
      val result = val::object();
      result.set("k1", array_of("Float64Array", k1.size(), k1.data()));
      result.set("k2", array_of("Float64Array", k2.size(), k2.data()));
      return result;
    });
  }

  /// The bytes of a file of that name, with the last shape.
  [[nodiscard]] val write(const std::string& name) const {
    return forwarding_errors([&] { return bytes_array(surface_bytes(name, file_, positions_)); });
  }
  /// Sets the positions of another shape, such as an earlier one.
  void set_positions(const val& positions) {
    forwarding_errors([&] {
      PolygonMesh mesh = file_.mesh;
      mesh.set_positions(vectors_of(positions));
      positions_ = mesh.positions();
    });
  }

 private:
  template <typename Solve>
  val solve(const val& progress, const Solve& with) {
    return forwarding_errors([&] {
      if (!session_) session_.emplace(file_.mesh, options_, threads());
      Context context;
      context.threads = threads();
      ask(context, progress);
      return with(context);
    });
  }
  void take_sharp_edges() {
    MeshEdges all = sharp_edges_;
    all.insert(all.end(), sharp_by_rules_.begin(), sharp_by_rules_.end());
    all = as_sharp_edges(whole(), all).edges;
    if (all == options_.sharp_edges) return;
    options_.sharp_edges = std::move(all);
    session_.reset();
  }
  FairReport fair_symmetric(const val& progress, const FairOptions& options) {
    return forwarding_errors([&] {
      Context context;
      context.threads = threads();
      ask(context, progress);
      return take(vspring::fair(*symmetric_, *constraints_, options, context));
    });
  }
  /// What constraints are for; its first nodes are those of the file.
  [[nodiscard]] const PolygonMesh& whole() const { return symmetric_ ? symmetric_->whole : file_.mesh; }
  /// Nothing holds it, and no edge is sharp.
  void let_go() {
    sharp_edges_.clear();
    sharp_by_rules_.clear();
    options_.sharp_edges.clear();
    constraints_.emplace(whole().node_count());
    session_.reset();
  }
  /// The mesh of the file has other nodes.
  void take_mesh() {
    symmetric_.reset();
    let_go();
    positions_ = file_.mesh.positions();
  }
  FairReport take(FairResult result) {
    positions_ = std::move(result.positions);
    return std::move(result.report);
  }

  SurfaceFile file_;
  std::vector<Vector3> positions_;
  std::optional<Symmetric<PolygonMesh>> symmetric_;
  std::optional<Constraints> constraints_;
  MeshEdges sharp_edges_;
  MeshEdges sharp_by_rules_;
  FairOptions options_;  ///< with all sharp edges
  std::optional<FairingSession> session_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(vspring_surface) {
  emscripten::class_<Surface>("Surface")
      .constructor<val, std::string>()
      .function("nodeCount", &Surface::node_count)
      .function("faceCount", &Surface::face_count)
      .function("positions", &Surface::positions)
      .function("faceBegin", &Surface::face_begin)
      .function("corners", &Surface::corners)
      .function("boundary", &Surface::boundary)
      .function("warnings", &Surface::warnings)
      .function("setSymmetry", &Surface::set_symmetry)
      .function("setRules", &Surface::set_rules)
      .function("holdPosition", &Surface::hold_position)
      .function("freePosition", &Surface::free_position)
      .function("holdNormal", &Surface::hold_normal)
      .function("freeNormal", &Surface::free_normal)
      .function("setFairBoundary", &Surface::set_fair_boundary)
      .function("setContinuity", &Surface::set_continuity)
      .function("setSharpEdges", &Surface::set_sharp_edges)
      .function("sharpEdges", &Surface::sharp_edges)
      .function("findSharpEdges", &Surface::find_sharp_edges)
      .function("markedEdges", &Surface::marked_edges)
      .function("heldNormals", &Surface::held_normals)
      .function("fair", &Surface::fair)
      .function("update", &Surface::update)
      .function("predict", &Surface::predict)
      .function("fit", &Surface::fit)
      .function("fill", &Surface::fill)
      .function("patches", &Surface::patches)
      .function("setPatches", &Surface::set_patches)
      .function("region", &Surface::region)
      .function("noise", &Surface::noise)
      .function("curvatures", &Surface::curvatures)
      .function("write", &Surface::write)
      .function("setPositions", &Surface::set_positions);
}

}  // namespace vspring
