#include "solve/carried.hpp"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/cancellation.hpp"
#include "linear/cholesky_solver.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"

namespace vspring {

namespace {

// Of the mean edge there: what goes less far takes nothing along, what goes further than the other all.
constexpr double edges_for_none = 1;
constexpr double edges_for_all = 2;
// Nodes that are some eighty edges away go along no more.
constexpr std::size_t most_nodes = 20'000;

std::size_t place(Index node) { return static_cast<std::size_t>(node); }

bool is_put_elsewhere(const PolygonMesh& mesh, const Constraints& constraints, Index node) {
  return constraints.position_fixed(node) && mesh.position(node).allFinite() &&
         constraints.position(node).allFinite() && constraints.position(node) != mesh.position(node);
}

/// Neighbours by edges, each once.
std::vector<Index> neighbours(const NodeGraph& graph, Index node) {
  std::vector<Index> result;
  graph.for_each_neighbour(node, [&](Index other) { result.push_back(other); });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

std::vector<Vector3> carrying_moves(const PolygonMesh& mesh, const Constraints& constraints) {
  std::vector<Vector3> moves;
  std::vector<std::uint8_t> elsewhere(mesh.positions().size(), 0);
  bool any = false;
  for (Index i = 0; i < mesh.node_count() && i < constraints.node_count(); ++i) {
    elsewhere[place(i)] = is_put_elsewhere(mesh, constraints, i) ? 1 : 0;
    any = any || elsewhere[place(i)] != 0;
  }
  if (!any) return moves;
  std::vector<double> edges(elsewhere.size(), 0);
  std::vector<double> counts(elsewhere.size(), 0);
  std::vector<Vector3> normals(elsewhere.size(), Vector3::Zero());
  // All next nodes less all before, round the node: none where faces go all around.
  std::vector<std::int64_t> open(elsewhere.size(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::none_of(face.begin(), face.end(), [&](Index node) { return elsewhere[place(node)] != 0; })) continue;
    const Vector3 area = twice_vector_area(face, mesh.positions());
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      const double length = (mesh.position(b) - mesh.position(a)).norm();
      for (const Index node : {a, b}) {
        edges[place(node)] += length;
        ++counts[place(node)];
      }
      normals[place(a)] += area;
      open[place(a)] += b;
      open[place(b)] -= a;
    }
  }
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (elsewhere[place(i)] == 0 || open[place(i)] != 0 || !(counts[place(i)] > 0)) continue;
    const Vector3 way = constraints.position(i) - mesh.position(i);
    const Vector3 normal = normals[place(i)].stableNormalized();
    const Vector3 aside = way - way.dot(normal) * normal;
    const double edge = edges[place(i)] / counts[place(i)];
    const double share = std::min(1.0, (aside.norm() / edge - edges_for_none) / (edges_for_all - edges_for_none));
    if (!(share > 0)) continue;
    moves.resize(elsewhere.size(), Vector3::Zero());
    moves[place(i)] = share * aside;
  }
  return moves;
}

CarriedNodes::CarriedNodes(const PolygonMesh& mesh, const Constraints& constraints, const std::vector<Vector3>& moves,
                           ThreadTeam& team)
    : incidence_(mesh), graph_(mesh, incidence_), positions_(mesh.positions()), solver_(team) {
  for (const Vector3& move : moves) moved_.push_back(move.isZero(0) ? 0 : 1);
  find_free(constraints, moves);
}

bool CarriedNodes::are_for(const std::vector<Vector3>& moves) const {
  return std::equal(moves.begin(), moves.end(), moved_.begin(), moved_.end(),
                    [](const Vector3& move, std::uint8_t moved) { return move.isZero(0) == (moved == 0); });
}

/// The nearest of those that hang together with what moves, and where the plate bends: they and their neighbours.
void CarriedNodes::find_free(const Constraints& constraints, const std::vector<Vector3>& moves) {
  column_of_.assign(positions_.size(), -1);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (!moves[i].isZero(0)) rows_.push_back(static_cast<Index>(i));
  }
  const std::size_t moved = rows_.size();
  for (std::size_t k = 0; k < moved + free_.size(); ++k) {
    end_if_cancelled_at(k);
    graph_.for_each_neighbour(k < moved ? rows_[k] : free_[k - moved], [&](Index other) {
      std::int32_t& column = column_of_[place(other)];
      if (column >= 0 || free_.size() == most_nodes || constraints.position_fixed(other) ||
          !positions_[place(other)].allFinite())
        return;
      column = static_cast<std::int32_t>(free_.size());
      free_.push_back(other);
    });
  }
  std::vector<std::uint8_t> bends(moved_);
  const auto add_row = [&](Index node) {
    if (std::exchange(bends[place(node)], std::uint8_t{1}) == 0) rows_.push_back(node);
  };
  for (const Index node : free_) {
    add_row(node);
    graph_.for_each_neighbour(node, add_row);
  }
}

double CarriedNodes::mean_square_edge(Index node) const {
  double sum = 0;
  double count = 0;
  graph_.for_each_neighbour(node, [&](Index other) {
    sum += (positions_[place(other)] - positions_[place(node)]).squaredNorm();
    ++count;
  });
  return count > 0 ? sum / count : 0;
}

/// ∑ over nodes of (∑ over edges (ℓ_i² + ℓ_j²)/2 · (u_i − u_j)/|e|²)² / ℓ_i², ℓ_i² the mean square of the edges of node
/// i, is to be least for the moves u of free nodes.
void CarriedNodes::factorise() {
  std::vector<Eigen::Triplet<double>> free;
  std::vector<Eigen::Triplet<double>> held;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    end_if_cancelled_at(r);
    const Index node = rows_[r];
    const double own = mean_square_edge(node);
    if (!(own > 0)) continue;
    double sum = 0;
    const auto add = [&](Index at, double value) {
      const std::int32_t column = column_of_[place(at)];
      (column >= 0 ? free : held).emplace_back(static_cast<int>(r), column >= 0 ? column : at, value);
    };
    for (const Index other : neighbours(graph_, node)) {
      const double squared = (positions_[place(other)] - positions_[place(node)]).squaredNorm();
      if (!(squared > 0)) continue;
      const double weight = (own + mean_square_edge(other)) / 2 / squared / std::sqrt(own);
      sum += weight;
      add(other, -weight);
    }
    add(node, sum);
  }
  const auto rows = static_cast<Eigen::Index>(rows_.size());
  of_free_.resize(rows, static_cast<Eigen::Index>(free_.size()));
  of_free_.setFromTriplets(free.begin(), free.end());
  of_held_.resize(rows, static_cast<Eigen::Index>(positions_.size()));
  of_held_.setFromTriplets(held.begin(), held.end());
  const Eigen::SparseMatrix<double> plate = of_free_.transpose() * of_free_;
  solver_.build(plate.triangularView<Eigen::Lower>());
  is_ready_ = true;
}

std::optional<std::vector<Vector3>> CarriedNodes::positions_with(const std::vector<Vector3>& moves) {
  if (free_.empty()) return std::nullopt;
  if (!is_ready_) factorise();
  Eigen::MatrixX3d given(static_cast<Eigen::Index>(moves.size()), 3);
  for (std::size_t i = 0; i < moves.size(); ++i) given.row(static_cast<Eigen::Index>(i)) = moves[i].transpose();
  const Eigen::MatrixX3d load = -(of_free_.transpose() * (of_held_ * given));
  std::vector<Vector3> values(free_.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = load.row(static_cast<Eigen::Index>(k)).transpose();
  solver_.solve(values, {});
  std::vector<Vector3> positions = positions_;
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += moves[i];
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!values[k].allFinite()) return std::nullopt;
    positions[place(free_[k])] += values[k];
  }
  return positions;
}

}  // namespace vspring
