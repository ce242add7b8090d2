// What a page sees of the library: one surface, what holds it, and its fair shape. Bytes and typed arrays in and out.

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring {

namespace {

using emscripten::val;

/// A copy of its own, to be handed to another thread.
template <typename Number>
val array_of(const char* type, std::size_t count, const Number* numbers) {
  const val view(emscripten::typed_memory_view(count, numbers));
  return val::global(type).new_(view);
}

val positions_array(const std::vector<Vector3>& positions) {
  static_assert(sizeof(Vector3) == 3 * sizeof(double));
  return array_of("Float64Array", 3 * positions.size(), positions.empty() ? nullptr : positions.front().data());
}

std::vector<Vector3> vectors_of(const val& array) {
  const auto numbers = emscripten::convertJSArrayToNumberVector<double>(array);
  std::vector<Vector3> vectors(numbers.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = Vector3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  return vectors;
}

val list_of(const std::vector<std::string>& lines) {
  val list = val::array();
  for (const std::string& line : lines) list.call<void>("push", val(line));
  return list;
}

/// Library errors become JavaScript ones with the same text.
template <typename Call>
auto forwarding_errors(const Call& call) {
  try {
    return call();
  } catch (const std::exception& error) {
    val::global("Error").new_(std::string(error.what())).throw_();
  }
}

/// A file in memory for as long as something is read from it or written to it.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& name) : path_("/" + name) {}
  ~MemoryFile() { (void)std::remove(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

val to_val(const FairReport& report) {
  val result = val::object();
  result.set("outcome", std::string(name(report.outcome)));
  result.set("iterations", report.iterations);
  result.set("seconds", report.seconds);
  result.set("expectedError", report.expected_error ? val(*report.expected_error) : val::null());
  result.set("movingNodes", report.moving_nodes);
  result.set("energyBefore", report.before.vspring_energy);
  result.set("energyAfter", report.after.vspring_energy);
  result.set("greatestTurnAfter", report.after.greatest_turn);
  result.set("greatestMove", report.greatest_move);
  result.set("warnings", list_of(report.warnings));
  return result;
}

/// One surface that is open.
class Surface {
 public:
  /// bytes: a Uint8Array. name: of the file, for its format and for messages.
  Surface(const val& bytes, const std::string& name) {
    forwarding_errors([&] {
      const MemoryFile memory(name);
      write_file(memory.path(), bytes.as<std::string>());
      file_ = read_surface(memory.path());
    });
    constraints_.emplace(file_.mesh.node_count());
    positions_ = file_.mesh.positions();
  }

  [[nodiscard]] int node_count() const { return file_.mesh.node_count(); }
  [[nodiscard]] int face_count() const { return file_.mesh.face_count(); }
  [[nodiscard]] val positions() const { return positions_array(positions_); }
  [[nodiscard]] val face_begin() const {
    return array_of("Int32Array", file_.mesh.face_begin().size(), file_.mesh.face_begin().data());
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

  /// Holds as the constraints file says that the command line takes, and nothing else.
  void set_rules(const std::string& json) {
    forwarding_errors([&] {
      Constraints constraints(file_.mesh.node_count());
      apply_rules(constraints, file_.mesh, json, {.groups = &file_.groups, .normals = &file_.normals});
      constraints_ = std::move(constraints);
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

  /// From the file's shape. progress(fraction): true ends it soon with the best shape so far.
  val fair(const val& progress) {
    session_.reset();
    return solve(progress);
  }
  /// From the last shape, where that leads somewhere.
  val follow(const val& progress) { return solve(progress); }

  /// What must hold besides for only those nodes to move: `fixed`, nodes that stay where the file has them, and `rim`
  /// with its `normals`, three numbers each.
  [[nodiscard]] val region(const val& nodes) const {
    return forwarding_errors([&] {
      Constraints restricted = *constraints_;
      restrict_to_region(restricted, file_.mesh, emscripten::convertJSArrayToNumberVector<Index>(nodes));
      std::vector<Index> fixed;
      std::vector<Index> rim;
      std::vector<Vector3> normals;
      for (Index node = 0; node < node_count(); ++node) {
        if (restricted.position_fixed(node) && !constraints_->position_fixed(node)) fixed.push_back(node);
        if (!restricted.normal_fixed(node) || constraints_->normal_fixed(node)) continue;
        rim.push_back(node);
        normals.push_back(restricted.normal(node));
      }
      val result = val::object();
      result.set("fixed", array_of("Int32Array", fixed.size(), fixed.data()));
      result.set("rim", array_of("Int32Array", rim.size(), rim.data()));
      result.set("normals", positions_array(normals));
      return result;
    });
  }
  /// The principal curvatures of a shape of these nodes: `k1` and `k2`, k1 not less than k2.
  [[nodiscard]] val curvatures(const val& positions) const {
    return forwarding_errors([&] {
      PolygonMesh mesh = file_.mesh;
      mesh.set_positions(vectors_of(positions));
      Context context;
      context.threads = 1;
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
    return forwarding_errors([&] {
      const MemoryFile memory(name);
      (void)write_surface(memory.path(), file_, positions_);
      std::string bytes;
      std::FILE* stream = std::fopen(memory.path().c_str(), "rb");
      char part[65536];
      for (std::size_t size = 1; size > 0;) {
        size = std::fread(part, 1, sizeof part, stream);
        bytes.append(part, size);
      }
      std::fclose(stream);
      return array_of("Uint8Array", bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    });
  }
  /// Another shape of the same nodes, such as an earlier one.
  void set_positions(const val& positions) {
    forwarding_errors([&] {
      PolygonMesh mesh = file_.mesh;
      mesh.set_positions(vectors_of(positions));
      positions_ = mesh.positions();
    });
  }

 private:
  val solve(const val& progress) {
    return forwarding_errors([&] {
      if (!session_) session_.emplace(file_.mesh, FairOptions{}, 1);
      Context context;
      context.threads = 1;
      if (!progress.isNull() && !progress.isUndefined())
        context.on_progress = [&](const Progress& now) {
          if (progress(now.fraction).as<bool>()) context.cancel();
        };
      FairResult result = session_->fair(*constraints_, context);
      positions_ = std::move(result.positions);
      return to_val(result.report);
    });
  }

  SurfaceFile file_;
  std::vector<Vector3> positions_;
  std::optional<Constraints> constraints_;
  std::optional<FairingSession> session_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(vspring) {
  emscripten::class_<Surface>("Surface")
      .constructor<val, std::string>()
      .function("nodeCount", &Surface::node_count)
      .function("faceCount", &Surface::face_count)
      .function("positions", &Surface::positions)
      .function("faceBegin", &Surface::face_begin)
      .function("corners", &Surface::corners)
      .function("boundary", &Surface::boundary)
      .function("warnings", &Surface::warnings)
      .function("setRules", &Surface::set_rules)
      .function("holdPosition", &Surface::hold_position)
      .function("freePosition", &Surface::free_position)
      .function("holdNormal", &Surface::hold_normal)
      .function("freeNormal", &Surface::free_normal)
      .function("fair", &Surface::fair)
      .function("follow", &Surface::follow)
      .function("region", &Surface::region)
      .function("curvatures", &Surface::curvatures)
      .function("write", &Surface::write)
      .function("setPositions", &Surface::set_positions);
  emscripten::function(
      "version", +[]() -> std::string { return version(); });
}

}  // namespace vspring
