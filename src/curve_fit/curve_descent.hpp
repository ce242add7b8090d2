#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "curve_fit/curve_fitter.hpp"
#include "curve_fit/curve_program.hpp"
#include "curve_fit/polyline_bounds.hpp"

namespace vspring {

/// Goes in steps from a curve to the fairest one that its points and bounds allow, on fixed nodes. Each step is a
/// convex program about the present curve.
template <int K>
class CurveDescent {
 public:
  /// task: must outlive this object.
  explicit CurveDescent(const CurveFitTask& task);

  double data_weight = 0;
  double nothing_left = 0;  ///< energy of sides that count as straight
  bool has_sides = false;   ///< between corners, within a tolerance: sides minimise bending
  CurveFound found;

  /// Call it when the curve has new nodes.
  void begin_grid();
  [[nodiscard]] bool is_out_of_work() const { return spent_ >= task_.most_work; }
  /// Work: the number of nodes, summed over all steps.
  [[nodiscard]] std::size_t spent() const { return spent_; }

  /// Steps to the fairest curve for the present weight of points.
  void go(int most_steps = most_steps_on_grid);

  /// Whether corners move: across the edge after and the edge before in turns.
  [[nodiscard]] bool has_corners() const;
  [[nodiscard]] double merit() const;
  /// The greatest distance, as a share of the allowed one, of a place from the polyline or of a point from the curve.
  [[nodiscard]] double measured_excess();

  static constexpr int most_steps_on_grid = 30;
  /// The weight of bending beside change of curvature.
  static constexpr double tie_break = 1e-6;
  /// A bound that is exceeded is set to this multiple of the present distance.
  static constexpr double loosened = 1.02;

 private:
  struct Step {
    std::vector<Vector3> moves;
    double greatest = 0;
    double turn = 0;  ///< the greatest turn of an edge
  };

  /// Points, with places, that show the way of the curve, by chains, in order.
  [[nodiscard]] std::span<const CurvePoint> way() const { return task_.in_order ? found.points : found.way; }
  void find_places_between();
  [[nodiscard]] double reach() const;
  CurveProgram<K> program(double left, double price);
  std::optional<Step> find_step();
  [[nodiscard]] Step measured(const CurveProgram<K>& program, const BallSolution& solution) const;
  double take(const Step& step);
  void loosen_bounds(const BallSolution& solution);
  void loosen_bounds();
  [[nodiscard]] bool is_settled(double share, double last_energy) const;
  [[nodiscard]] double bending() const;
  [[nodiscard]] double excess() const;
  [[nodiscard]] double greatest_bend() const;

  struct Bounded {
    double* bound;
    std::size_t row;  ///< of the program
    double along;     ///< the distance along the curve, which no step changes
  };

  const CurveFitTask& task_;
  Vector3 plane_;
  std::vector<double> weights_;
  std::vector<PolylineBound> between_;
  /// What places on each edge were away from the polyline at first, where no tolerance bounds that: arcs rise.
  std::vector<double> spare_;
  std::vector<Bounded> bounded_;
  std::size_t spent_ = 0;
  // Of the present curve.
  double energy_ = 0;
  double excess_ = 0;
  double bent_ = 0;
  double last_step_ = std::numeric_limits<double>::infinity();
  const double* left_ = nullptr;  ///< the share of excessive curvature that a step may leave
  bool springs_;                  ///< the equilibrium of springs, instead of least change of curvature
  bool gives_way_ = false;        ///< whether some bound may be exceeded
  bool ahead_ = true;             ///< whether corners move across the edges after them
  bool found_ = false;            ///< whether the last program had a solution
};

extern template class CurveDescent<1>;
extern template class CurveDescent<2>;

}  // namespace vspring
