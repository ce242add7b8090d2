#include "join/least_variation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "base/cancellation.hpp"
#include "linear/cholesky_solver.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"

namespace vspring {

namespace {

// Of polynomials: slopes, second and third degree.
constexpr Eigen::Index slopes = 2;
constexpr Eigen::Index seconds = 3;
constexpr Eigen::Index thirds = 4;
constexpr Eigen::Index most_terms = slopes + seconds + thirds;
// Nodes that they are fitted to: rings of faces are added until there are so many; with fewer than the others nothing
// is known.
constexpr std::size_t enough_nodes = 12;
constexpr std::size_t enough_nodes_of_rim = 5;
constexpr std::size_t fewest_more = 1;
constexpr int most_rings = 4;
// Of products of lengths in those of the nodes: what few nodes tell nothing of is nothing.
constexpr double ridge = 1e-9;
// Of the greatest on the diagonal.
constexpr double least_on_diagonal = 1e-13;
// Of the mean square of what heights are off the polynomials.
constexpr double share_of_rest = 1;
// Of rim nodes, beside others: what they have is to be met. More would follow the noise of the rim.
constexpr double weight_of_rim = 10;
constexpr int most_steps = 40;
constexpr int most_halvings = 4;
// By which the change of curvature may seem to grow in a step, as its derivative is that of polynomials that stay.
constexpr double most_growth = 1.05;
constexpr double most_rate = 0.9;
constexpr std::size_t centres_per_task = 64;

/// The normal curvature of a rim node in the direction in which a way leaves it.
double bend_along(const RimNode& rim, const Vector3& way) {
  const double square = way.squaredNorm() - std::pow(way.dot(rim.normal), 2);
  return square > 0 ? way.dot(*rim.form * way) / square : 0;
}

class Descent {
 public:
  Descent(const LeastVariationTask& task, ThreadTeam& team)
      : mesh_(*task.mesh),
        task_(task),
        team_(team),
        incidence_(mesh_),
        column_(mesh_.positions().size(), -1),
        rim_of_(mesh_.positions().size(), -1),
        normals_(mesh_.positions().size(), Vector3::Zero()),
        solver_(team) {
    for (std::size_t i = 0; i < column_.size(); ++i) {
      if (task.moves[i] != 0) column_[i] = columns_++;
    }
    for (std::size_t k = 0; k < task.rim.size(); ++k) rim_of_[place(task.rim[k].node)] = static_cast<Index>(k);
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      const bool is_rim = rim_of_[place(i)] >= 0 && !task.rim[place(rim_of_[place(i)])].normal.isZero(0);
      if (column_[place(i)] >= 0 || is_rim) add_centre(i);
    }
    result_.positions = mesh_.positions();
  }

  LeastVariation run() {
    double energy = look();
    double last = 0;
    while (result_.steps < most_steps) {
      end_if_cancelled();
      const std::vector<double> step = find_step();
      double size = 0;
      for (const double way : step) size = std::max(size, std::abs(way));
      if (!(size <= task_.most_step)) return std::move(result_);
      ++result_.steps;
      const std::vector<Vector3> before = result_.positions;
      const std::vector<Vector3> normals = normals_;
      double share = 1;
      double now = 0;
      for (int half = 0;; ++half, share /= 2) {
        if (half == most_halvings) {
          result_.positions = before;
          return std::move(result_);
        }
        for (std::size_t i = 0; i < column_.size(); ++i) {
          if (column_[i] >= 0) result_.positions[i] = before[i] + share * step[place(column_[i])] * normals[i];
        }
        now = look();
        if (now <= most_growth * energy) break;
      }
      energy = now;
      if (task_.on_step) task_.on_step(result_.steps);
      const double rate = last > 0 ? std::min(size / last, most_rate) : most_rate;
      result_.expected_error = share * size * rate / (1 - rate);
      result_.converged = share == 1 && result_.expected_error < task_.tolerance;
      if (result_.converged) break;
      last = size;
    }
    return std::move(result_);
  }

 private:
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }

  /// A node around which the surface is a polynomial.
  struct Centre {
    Index node;
    std::vector<Index> nodes;  ///< near it
    /// Half of the energy by what the nodes near go along their normals, and in the end what it goes itself.
    Eigen::MatrixXd second{};
    Eigen::VectorXd first{};
    double energy = 0;
  };

  [[nodiscard]] bool is_inside(Index i) const { return column_[place(i)] >= 0 || rim_of_[place(i)] >= 0; }

  void add_centre(Index node) {
    Centre centre{node, {}};
    const bool moves = column_[place(node)] >= 0;
    std::vector<Index> seen = {node};
    std::size_t done = 0;
    for (int ring = 0; ring < most_rings && centre.nodes.size() < (moves ? enough_nodes : enough_nodes_of_rim);
         ++ring) {
      for (const std::size_t end = seen.size(); done < end; ++done) {
        for (const Corner corner : incidence_.corners(seen[done])) {
          for (const Index j : mesh_.face(corner.face)) {
            if (!is_inside(j) || std::find(seen.begin(), seen.end(), j) != seen.end()) continue;
            seen.push_back(j);
            if (moves || column_[place(j)] >= 0) centre.nodes.push_back(j);
          }
        }
      }
    }
    if (centre.nodes.size() >= static_cast<std::size_t>(terms_at(node)) + fewest_more)
      centres_.push_back(std::move(centre));
  }

  [[nodiscard]] const RimNode* rim_at(Index node) const {
    const Index k = rim_of_[place(node)];
    return k < 0 ? nullptr : &task_.rim[place(k)];
  }
  [[nodiscard]] Eigen::Index terms_at(Index node) const {
    const RimNode* const rim = rim_at(node);
    return rim ? (rim->form ? thirds : seconds + thirds) : most_terms;
  }

  /// The normal of the faces around, and the node's share of these; of the rim of those inside.
  [[nodiscard]] std::pair<Vector3, double> around(Index node) const {
    Vector3 normal = Vector3::Zero();
    double share = 0;
    for (const Corner corner : incidence_.corners(node)) {
      const auto face = mesh_.face(corner.face);
      if (std::none_of(face.begin(), face.end(), [&](Index j) { return column_[place(j)] >= 0; })) continue;
      const Vector3 area = twice_vector_area(face, result_.positions) / 2;
      normal += area;
      share += area.norm() / static_cast<double>(face.size());
    }
    return {normal.normalized(), share};
  }

  /// At the present shape; returns the energy.
  double look() {
    std::vector<double> shares(column_.size(), 0);
    parallel_each(team_, column_.size(), centres_per_task, [&](std::size_t i) {
      const auto node = static_cast<Index>(i);
      if (!is_inside(node)) return;
      std::tie(normals_[i], shares[i]) = around(node);
      if (const RimNode* const rim = rim_at(node)) normals_[i] = rim->normal;
    });
    parallel_each(team_, centres_.size(), centres_per_task,
                  [&](std::size_t k) { look_at(centres_[k], shares[place(centres_[k].node)]); });
    double energy = 0;
    for (const Centre& centre : centres_) energy += centre.energy;
    return energy;
  }

  void look_at(Centre& centre, double share) const {
    const std::vector<Index>& nodes = centre.nodes;
    const auto count = static_cast<Eigen::Index>(nodes.size());
    const RimNode* const rim = rim_at(centre.node);
    const Vector3& origin = result_.positions[place(centre.node)];
    const Vector3& normal = normals_[place(centre.node)];
    const Vector3 aside = normal.unitOrthogonal();
    const Vector3 ahead = normal.cross(aside);
    double squares = 0;
    for (const Index j : nodes) squares += (result_.positions[place(j)] - origin).squaredNorm();
    const double unit = std::sqrt(squares / static_cast<double>(count));
    const Eigen::Index terms = terms_at(centre.node);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_terms> rows(terms, count);
    Eigen::VectorXd bends(count);
    Eigen::VectorXd scales(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector3 d = (result_.positions[place(nodes[place(static_cast<Index>(k))])] - origin) / unit;
      const double u = d.dot(aside);
      const double v = d.dot(ahead);
      const double scale = 2 / d.squaredNorm();
      scales[k] = scale / unit;
      bends[k] = scale * d.dot(normal);
      Eigen::Matrix<double, most_terms, 1> all;
      all << scale * u, scale * v, 1, scale * (u * u - v * v) / 2, scale * u * v, scale * u * u * u, scale * u * u * v,
          scale * u * v * v, scale * v * v * v;
      rows.col(k) = all.tail(terms);
      if (rim && rim->form) bends[k] -= unit * bend_along(*rim, d);
    }
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_terms, most_terms> products =
        rows * rows.transpose();
    products.diagonal().array() += ridge;
    const Eigen::MatrixXd fit = products.ldlt().solve(rows);
    Eigen::Matrix<double, 2, Eigen::Dynamic> change(2, count);
    change.row(0) = 3 * fit.row(terms - 4) + fit.row(terms - 2);
    change.row(1) = fit.row(terms - 3) + 3 * fit.row(terms - 1);
    Eigen::MatrixXd form = change.transpose() * change;
    form +=
        share_of_rest / static_cast<double>(count) * (Eigen::MatrixXd::Identity(count, count) - rows.transpose() * fit);
    form *= (rim && rim->form ? weight_of_rim : 1) * share / std::pow(unit, 4);
    const Eigen::VectorXd slope = form * bends;
    centre.energy = bends.dot(slope);
    // Where a node goes along its normal its height grows; where the one in the middle does, all others fall.
    Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(count, count + 1);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Index j = nodes[place(static_cast<Index>(k))];
      if (column_[place(j)] >= 0) heights(k, k) = scales[k] * normals_[place(j)].dot(normal);
      if (!rim) heights(k, count) = -scales[k];
    }
    centre.first = heights.transpose() * slope;
    centre.second = heights.transpose() * form * heights;
  }

  /// What each moving node is to go along its normal.
  std::vector<double> find_step() {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> step(place(columns_), 0);
    for (const Centre& centre : centres_) {
      const auto column = [&](Eigen::Index k) {
        const auto at = static_cast<std::size_t>(k);
        return column_[place(at < centre.nodes.size() ? centre.nodes[at] : centre.node)];
      };
      for (Eigen::Index k = 0; k < centre.first.size(); ++k) {
        const Index row = column(k);
        if (row < 0) continue;
        step[place(row)] -= centre.first[k];
        for (Eigen::Index m = 0; m < centre.first.size(); ++m) {
          const Index other = column(m);
          if (other >= 0 && other <= row) entries.emplace_back(row, other, centre.second(k, m));
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(columns_, columns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    entries = {};
    const double least = least_on_diagonal * matrix.diagonal().maxCoeff();
    for (Eigen::Index i = 0; i < columns_; ++i) matrix.coeffRef(i, i) += least;
    solver_.build(matrix);
    solver_.solve(step, {});
    return step;
  }

  const PolygonMesh& mesh_;
  const LeastVariationTask& task_;
  ThreadTeam& team_;
  Incidence incidence_;
  std::vector<Index> column_;  ///< per node that of the matrix; −1: it does not move
  std::vector<Index> rim_of_;  ///< per node its number in the rim; −1: it is not of it
  Index columns_ = 0;
  std::vector<Centre> centres_;
  std::vector<Vector3> normals_;
  CholeskySolver solver_;
  LeastVariation result_;
};

}  // namespace

LeastVariation least_variation(const LeastVariationTask& task, ThreadTeam& team) { return Descent(task, team).run(); }

}  // namespace vspring
