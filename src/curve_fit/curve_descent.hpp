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

/// Goes in steps from a curve to the fairest one that its points and bounds allow, on the nodes that it has. Each step
/// is a convex program about the curve as it is.
template <int K>
class CurveDescent {
 public:
  /// task: has to outlive it.
  explicit CurveDescent(const CurveFitTask& task);

  double data_weight = 0;
  double nothing_left = 0;  ///< energy of sides that are as good as straight
  bool has_sides = false;   ///< between corners, within a tolerance: these bend least
  CurveFound found;

  /// To be called when the curve has got new nodes. grid: how often that was before.
  void begin_grid(int grid);
  [[nodiscard]] bool is_out_of_work() const { return work_ >= most_work_ || spent_ >= task_.most_work; }
  /// Nodes, each for every step in which programs were solved.
  [[nodiscard]] std::size_t spent() const { return spent_; }

  /// Steps to the fairest curve for the weight of points as it is.
  void go(int most_steps = most_steps_on_grid);

  /// Whether corners move: across the edge after and that before in turns.
  [[nodiscard]] bool has_corners() const;
  [[nodiscard]] double merit() const;
  /// The greatest share of how far it may be from the polyline that any place is away, or from its bound any point.
  [[nodiscard]] double measured_excess();

  static constexpr int most_steps_on_grid = 30;
  /// What least bending weighs beside least change of curvature.
  static constexpr double tie_break = 1e-6;
  /// Bounds that a curve is beyond, of where it is.
  static constexpr double loosened = 1.02;

 private:
  struct Step {
    std::vector<Vector3> moves;
    double greatest = 0;
    double turn = 0;           ///< the greatest one of an edge
    double squared_turns = 0;  ///< times lengths
  };

  /// Points with their places that say which way the curve goes, by chains, in order.
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
  [[nodiscard]] double settled_step() const;
  [[nodiscard]] double bending() const;
  [[nodiscard]] double excess() const;
  [[nodiscard]] double greatest_bend() const;

  struct Bounded {
    double* bound;
    std::size_t row;  ///< of the program
    double along;     ///< how far away along the curve, which no step changes
  };

  const CurveFitTask& task_;
  Vector3 plane_;
  std::vector<double> weights_;
  std::vector<PolylineBound> between_;
  std::vector<Bounded> bounded_;
  double damping_ = 0;
  std::size_t work_ = 0;  ///< nodes, each for every step
  std::size_t most_work_ = 0;
  std::size_t spent_ = 0;
  // Of the curve as it is.
  double energy_ = 0;
  double excess_ = 0;
  double bent_ = 0;
  double last_step_ = std::numeric_limits<double>::infinity();
  const double* left_ = nullptr;  ///< of what is bent too much, so much may stay in a step
  bool springs_;                  ///< and no least change of curvature
  bool gives_way_ = false;        ///< whether a bound does
  bool ahead_ = true;             ///< corners go across the edges after them
  bool found_ = false;            ///< whether the last program had a solution
};

extern template class CurveDescent<1>;
extern template class CurveDescent<2>;

}  // namespace vspring
