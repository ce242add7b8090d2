#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/threads.hpp"
#include "constraints/active_submesh.hpp"
#include "fairness/measure.hpp"
#include "fit/fit_start.hpp"
#include "spring/curve_net.hpp"
#include "vspring/distance.hpp"
#include "vspring/fairness.hpp"

namespace vspring {

// What is fitted: a surface or a curve, each with its own words for messages. Shape, constraints and points must
// outlive it; positions are those of all nodes of the shape.

class FitSurface {
 public:
  using Shape = PolygonMesh;
  /// measuring: for distances.
  FitSurface(const PolygonMesh& mesh, const Constraints& constraints, std::span<const Vector3> points,
             const Context& measuring, ThreadTeam& team);

  [[nodiscard]] const PolygonMesh& shape() const { return *whole_; }
  [[nodiscard]] const Constraints& constraints() const { return *constraints_; }
  [[nodiscard]] Index faces() const { return whole_->face_count(); }
  [[nodiscard]] std::vector<Warning> check(std::span<const std::uint8_t> pulled) const;
  /// for_spheres: as for gather_net().
  [[nodiscard]] Net gather(bool for_spheres = false) const;
  [[nodiscard]] Fairness fairness(const std::vector<Vector3>& positions);
  /// Of the points. Held nodes must be where they are held.
  [[nodiscard]] std::vector<double> distances(const std::vector<Vector3>& positions);
  [[nodiscard]] const std::vector<double>& distances_before();
  /// The distances of the points from held faces and edges, at their held places; infinite where there are none. If the
  /// points are the nodes: 0 for those held where they are, else infinite.
  [[nodiscard]] std::vector<double> distances_from_held();
  /// 1 for nodes of a face.
  [[nodiscard]] std::vector<std::uint8_t> usable() const;
  [[nodiscard]] SurfaceSides sides() const;
  /// As new_crossings().
  [[nodiscard]] std::string crossings(const std::vector<Vector3>& positions, const Context& context) const;

 private:
  /// From the faces of which no node moves.
  const std::vector<double>& distances_from_rest();

  const PolygonMesh* whole_;
  const Constraints* constraints_;
  std::span<const Vector3> points_;
  const Context* measuring_;
  ThreadTeam* team_;
  std::optional<ActiveSubmesh> part_;
  // From the first figure on.
  std::optional<FairnessMeter> meter_;
  // From the first time on that they are asked for.
  std::vector<double> from_rest_;
  std::vector<double> before_;
};

class FitCurve {
 public:
  using Shape = PolygonCurve;
  FitCurve(const PolygonCurve& curve, const Constraints& constraints, std::span<const Vector3> points,
           const Context& measuring, ThreadTeam& team);

  [[nodiscard]] const PolygonCurve& shape() const { return *curve_; }
  [[nodiscard]] const Constraints& constraints() const { return *constraints_; }
  [[nodiscard]] static Index faces() { return 0; }
  [[nodiscard]] std::vector<Warning> check(std::span<const std::uint8_t> pulled) const;
  [[nodiscard]] Net gather() const;
  [[nodiscard]] Fairness fairness(const std::vector<Vector3>& positions) const;
  [[nodiscard]] std::vector<double> distances(const std::vector<Vector3>& positions) const;
  [[nodiscard]] std::vector<double> distances_before() const;
  /// The distances of the points from held nodes and the edges between them, at their held places. Empty where nothing
  /// is held, or where the points are the nodes: then all count.
  [[nodiscard]] std::vector<double> distances_from_held() const;
  [[nodiscard]] std::vector<std::uint8_t> usable() const;
  /// None: curves face nowhere.
  [[nodiscard]] static SurfaceSides sides() { return {}; }
  /// None are looked for.
  [[nodiscard]] static std::string crossings(const std::vector<Vector3>& /*positions*/, const Context& /*context*/) {
    return {};
  }

 private:
  [[nodiscard]] PolygonCurve with(const std::vector<Vector3>& positions) const;

  const PolygonCurve* curve_;
  const Constraints* constraints_;
  std::span<const Vector3> points_;
  const Context* measuring_;
};

}  // namespace vspring
