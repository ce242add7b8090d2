// What holds of every shape, on shapes, constraints and motions that RapidCheck draws and, where one fails, makes
// small.
//   RC_PARAMS="max_success=5000" build/asan/claim_tests --gtest_filter='Properties.*'     tries more of them
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "support/methods.hpp"
#include "support/surfaces.hpp"

namespace vspring::properties_test {
namespace {

using namespace support;

double share() { return *rc::gen::inRange(0, 1001) / 1000.0; }

PolygonMesh drawn_surface() {
  const double jitter = 0.3 * share();
  const auto seed = static_cast<std::uint64_t>(*rc::gen::inRange(1, 1000));
  const auto nodes = *rc::gen::inRange<Index>(20, 300);
  generate::Grid grid{.columns = *rc::gen::inRange(3, 14),
                      .rows = *rc::gen::inRange(3, 14),
                      .faces = *rc::gen::elementOf(std::vector(std::begin(every_kind), std::end(every_kind))),
                      .jitter = jitter,
                      .seed = seed};
  const auto mesh = [&] {
    switch (*rc::gen::inRange(0, 6)) {
      case 0:
        return generate::cap({.nodes = nodes, .half_angle = 10 + 80 * share(), .jitter = jitter, .seed = seed});
      case 1:
        return generate::annulus({.nodes = nodes, .height = share(), .jitter = jitter, .seed = seed});
      case 2:
        return generate::saddle(grid, 1);
      case 3:
        grid.columns = 4 * (1 + grid.columns / 4);
        return generate::tube(grid, 0.5, 0.3 + share());
      case 4:
        return generate::polygon_patch({.sides = *rc::gen::inRange(3, 9), .rings = *rc::gen::inRange(1, 5)});
      default:
        return generate::plane(grid);
    }
  }();
  return generate::add_noise(mesh, 0.02 * share(), seed);
}

PolygonCurve drawn_curve() {
  std::vector<Vector3> nodes;
  const int count = *rc::gen::inRange(4, 60);
  const double bend = 3 * share();
  const double twist = *rc::gen::arbitrary<bool>() ? share() : 0;
  const double noise = 0.2 * share() / count;
  Draw draw(static_cast<std::uint64_t>(*rc::gen::inRange(1, 1000)));
  for (int k = 0; k < count; ++k) {
    const double at = static_cast<double>(k) / (count - 1);
    Vector3 offset = draw.in_cube(noise);
    if (twist == 0) offset.z() = 0;
    nodes.emplace_back(Vector3(std::cos(bend * at), std::sin(bend * at), twist * at) + offset);
  }
  return PolygonCurve(std::move(nodes));
}

/// Its boundary, sometimes with its directions, and a few nodes inside near where they are.
template <typename Shape>
Constraints drawn_constraints(const Shape& shape) {
  Constraints held(shape.node_count());
  fix_boundary_positions(held, shape);
  if (*rc::gen::arbitrary<bool>()) {
    if constexpr (std::is_same_v<Shape, PolygonMesh>)
      fix_boundary_normals(held, shape);
    else
      fix_boundary_tangents(held, shape);
  }
  for (int count = *rc::gen::inRange(0, 3); count > 0; --count) {
    const auto node = *rc::gen::inRange<Index>(0, shape.node_count());
    held.fix_position(node, shape.position(node) + 0.02 * Vector3(share(), share(), 0));
  }
  return held;
}

Motion drawn_motion() {
  const Vector3 axis(share() - 0.5, share() - 0.5, share() + 0.1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2 * std::numbers::pi * share(), axis.normalized()).toRotationMatrix();
  const double scale = std::pow(10, 12 * share() - 6);
  return {.turn = turn, .scale = scale, .shift = 3 * scale * Vector3(share(), share(), share())};
}

PolygonMesh at(const PolygonMesh& mesh, std::vector<Vector3> places) { return with_positions(mesh, std::move(places)); }
PolygonCurve at(const PolygonCurve& curve, std::vector<Vector3> places) {
  PolygonCurve moved = curve;
  moved.set_positions(std::move(places));
  return moved;
}

double greatest_distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
  return greatest;
}

bool same_bits(const Vector3& a, const Vector3& b) {
  for (int k = 0; k < 3; ++k)
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return false;
  return true;
}

bool same_bits(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return same_bits(x, y); });
}

/// Converged, and without a word of warning: where there is one, as of springs that had to be changed, several
/// equilibria may be near, and rounding decides between them.
bool plainly_converged(const FairResult& result) {
  return result.report.outcome == Outcome::converged && result.report.warnings.empty();
}

/// A copy that is turned, scaled and moved has the result that is turned, scaled and moved, as far as each is told to
/// be from the equilibrium and rounding reaches.
template <typename Shape>
void expect_moved_result(const Shape& shape) {
  const Constraints held = drawn_constraints(shape);
  const Motion motion = drawn_motion();
  const FairOptions options = {.method = EquilibriumMethod{.tolerance = 1e-8}};
  const FairResult here = fair(shape, held, options);
  RC_PRE(plainly_converged(here));
  const FairResult there = fair(at(shape, motion.points(shape.positions())), motion.constraints(held), options);
  RC_ASSERT(there.report.outcome == Outcome::converged);
  const double error = 3 * (here.report.expected_error.value() + there.report.expected_error.value());
  const double size = diagonal(shape.positions());
  RC_ASSERT(greatest_distance(motion.points(here.positions), there.positions) < (error + 1e-10) * size * motion.scale);
}

RC_GTEST_PROP(Properties, AMovedSurfaceHasTheMovedResult, ()) { expect_moved_result(drawn_surface()); }
RC_GTEST_PROP(Properties, AMovedCurveHasTheMovedResult, ()) { expect_moved_result(drawn_curve()); }

/// Powers of two round nothing.
template <typename Shape>
void expect_scaled_bits(const Shape& shape) {
  const Constraints drawn = drawn_constraints(shape);
  const Motion none = {.turn = Eigen::Matrix3d::Identity(), .scale = 1, .shift = Vector3::Zero()};
  Motion motion = none;
  motion.scale = std::ldexp(1, *rc::gen::inRange(-200, 200));
  const FairResult here = fair(shape, none.constraints(drawn));
  const FairResult there = fair(at(shape, motion.points(shape.positions())), motion.constraints(drawn));
  RC_ASSERT(here.report.outcome == there.report.outcome);
  RC_ASSERT(here.report.history == there.report.history);
  RC_ASSERT(same_bits(motion.points(here.positions), there.positions));
}

RC_GTEST_PROP(Properties, ASurfaceScaledByAPowerOfTwoHasTheSameBits, ()) { expect_scaled_bits(drawn_surface()); }
RC_GTEST_PROP(Properties, ACurveScaledByAPowerOfTwoHasTheSameBits, ()) { expect_scaled_bits(drawn_curve()); }

RC_GTEST_PROP(Properties, ARenumberedSurfaceHasTheRenumberedResult, ()) {
  const PolygonMesh mesh = drawn_surface();
  const generate::Shuffled other = generate::shuffle(mesh, static_cast<std::uint64_t>(*rc::gen::inRange(1, 1000)));
  const FairOptions options = {.method = EquilibriumMethod{.tolerance = 1e-8}};
  const FairResult here = fair(mesh, clamped_boundary(mesh), options);
  RC_PRE(plainly_converged(here));
  const FairResult there = fair(other.mesh, clamped_boundary(other.mesh), options);
  RC_ASSERT(there.report.outcome == Outcome::converged);
  std::vector<Vector3> places = there.positions;
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = there.positions[static_cast<std::size_t>(other.new_number[i])];
  const double error = 3 * (here.report.expected_error.value() + there.report.expected_error.value());
  RC_ASSERT(greatest_distance(here.positions, places) < (error + 1e-10) * diagonal(mesh));
}

/// Wherever it ends, held nodes are where they are held to the bit, all others somewhere, and no level has gone on
/// longer than it was let.
template <typename Shape>
void expect_sound_end(const Shape& drawn) {
  Motion motion = drawn_motion();
  motion.shift *= 1e6 * share();
  const Shape shape = at(drawn, motion.points(drawn.positions()));
  Constraints held = drawn_constraints(drawn);
  held = motion.constraints(held);
  FairOptions options;
  options.method = *rc::gen::element<FairingMethod>(equilibrium_alone(), MultigridMethod{}, SweepMethod{});
  const int limit = *rc::gen::inRange(1, 30);
  std::visit([&](auto& method) { method.max_iterations = limit; }, options.method);
  const FairResult result = fair(shape, held, options);
  for (Index i = 0; i < shape.node_count(); ++i) {
    const Vector3& position = result.positions[static_cast<std::size_t>(i)];
    RC_ASSERT(position.allFinite());
    if (held.position_fixed(i)) RC_ASSERT(same_bits(position, held.position(i)));
  }
  const auto* const multigrid = std::get_if<MultigridMethod>(&options.method);
  const int most = limit + (multigrid ? multigrid->pre_smoothing : 0);
  for (const LevelReport& level : result.report.levels) RC_ASSERT(level.iterations <= most);
  if (result.report.method == Method::sweep) RC_ASSERT(result.report.iterations <= limit);
  for (const double residual : result.report.history) RC_ASSERT(residual >= 0);
}

RC_GTEST_PROP(Properties, ASurfaceEndsWithinItsLimitsWithHeldNodesInPlace, ()) { expect_sound_end(drawn_surface()); }
RC_GTEST_PROP(Properties, ACurveEndsWithinItsLimitsWithHeldNodesInPlace, ()) { expect_sound_end(drawn_curve()); }

/// What converged to a coarse tolerance lies no further from the equilibrium than it says, up to a factor of 4.
template <typename Shape>
void expect_honest_error(const Shape& shape) {
  const Constraints held = drawn_constraints(shape);
  const FairResult rough = fair(shape, held, {.method = EquilibriumMethod{.tolerance = 1e-3}});
  RC_PRE(plainly_converged(rough) && rough.report.moving_nodes > 0);
  const FairResult exact = fair(shape, held, {.method = EquilibriumMethod{.tolerance = 1e-10}});
  RC_PRE(plainly_converged(exact));
  const double distance = greatest_distance(rough.positions, exact.positions);
  RC_ASSERT(distance <= (4 * rough.report.expected_error.value() + 1e-9) * diagonal(shape.positions()));
}

RC_GTEST_PROP(Properties, TheExpectedErrorOfASurfaceIsHonest, ()) { expect_honest_error(drawn_surface()); }
RC_GTEST_PROP(Properties, TheExpectedErrorOfACurveIsHonest, ()) { expect_honest_error(drawn_curve()); }

/// Any finite number there is: of every size, of few digits and of many, subnormal ones too.
double drawn_number() {
  const auto word = *rc::gen::arbitrary<std::uint64_t>();
  const double any = std::bit_cast<double>(word * 0x9e3779b97f4a7c15U);
  if (*rc::gen::arbitrary<bool>() && std::isfinite(any)) return any;
  return *rc::gen::elementOf(std::vector<double>{0.0, -0.0, 0.1, 1.0 / 3, -1e22, 123456789.0, 5e-324,
                                                 std::numeric_limits<double>::min(),
                                                 std::numeric_limits<double>::max()});
}

std::vector<Vector3> drawn_places(std::size_t count, bool planar) {
  std::vector<Vector3> places(count);
  for (Vector3& place : places) place = Vector3(drawn_number(), drawn_number(), planar ? 0 : drawn_number());
  return places;
}

/// A path that nobody else has, removed at the end.
class OwnFile {
 public:
  explicit OwnFile(const std::string& ending)
      : path_((std::filesystem::temp_directory_path() / ("vspring-properties-" + std::to_string(::getpid()) + ending))
                  .string()) {}
  ~OwnFile() { std::filesystem::remove(path_); }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

RC_GTEST_PROP(Properties, ASurfaceReadsAsItWasWrittenToTheBit, ()) {
  const PolygonMesh drawn = generate::plane({.columns = 2, .rows = *rc::gen::inRange(1, 5)});
  const PolygonMesh mesh = at(drawn, drawn_places(drawn.positions().size(), false));
  const OwnFile file(*rc::gen::elementOf(std::vector<std::string>{".obj", ".off", ".ply"}));
  write_surface(file.path(), mesh);
  const SurfaceFile read = read_surface(file.path());
  RC_ASSERT(same_bits(read.mesh.positions(), mesh.positions()));
  RC_ASSERT(read.mesh.corners() == mesh.corners());
  // And once more, into a file that keeps what that one carried.
  const std::vector<Vector3> places = drawn_places(mesh.positions().size(), false);
  write_surface(file.path(), read, places);
  RC_ASSERT(same_bits(read_surface(file.path()).mesh.positions(), places));
}

RC_GTEST_PROP(Properties, ACurveReadsAsItWasWrittenToTheBit, ()) {
  const std::string ending = *rc::gen::elementOf(std::vector<std::string>{".obj", ".csv", ".xyz"});
  const PolygonCurve curve(drawn_places(*rc::gen::inRange<std::size_t>(2, 9), false));
  const OwnFile file(ending);
  write_curve(file.path(), curve);
  RC_ASSERT(same_bits(read_curve(file.path()).curve.positions(), curve.positions()));
}

}  // namespace
}  // namespace vspring::properties_test
