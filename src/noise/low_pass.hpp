#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/cancellation.hpp"
#include "base/threads.hpp"
#include "noise/scan_mesh.hpp"

namespace vspring {

/// A low pass 1/(1 + (e/half)^order), e the eigenvalue, from 0 to 2, of the difference between a node and the mean of
/// its neighbours.
struct Band {
  double half;
  double order;
};

/// Low passes of fields over the nodes of a surface: polynomials of the mean over neighbours in Chebyshev's basis (G.
/// Taubin, T. Zhang, G. Golub, "Optimal Surface Smoothing as Filter Design", ECCV 1996), all from one recurrence. They
/// are flat at eigenvalue 0, where windowed sinc functions deviate by 0.3 %, which would move large shapes by many
/// edges. Held nodes keep their values; constant fields stay.
class LowPass {
 public:
  explicit LowPass(std::span<const Band> bands);

  /// Returns the field filtered by each band. field: of all nodes; Value: double, Vector3 or an array. Cost: linear,
  /// about 150 means over neighbours; the same bits on any number of threads.
  template <typename Value>
  std::vector<std::vector<Value>> filter(const ScanMesh& mesh, const std::vector<Value>& field,
                                         ThreadTeam& team) const {
    std::vector<std::vector<Value>> results;
    results.reserve(coefficients_.size());
    while (results.size() < coefficients_.size()) {
      end_if_cancelled();
      results.push_back(field);
    }
    std::vector<Value> before = field;
    std::vector<Value> now = field;
    std::vector<Value> next = field;
    for (std::size_t degree = 1; degree < most_; ++degree) {
      parallel_ranges(team, mesh.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto neighbours = mesh.neighbours.of(i);
          if (neighbours.empty()) continue;
          Value sum = now[neighbours[0]];
          for (const std::uint32_t j : neighbours.subspan(1)) sum += now[j];
          sum *= (degree == 1 ? 1 : 2) / static_cast<double>(neighbours.size());
          next[i] = degree == 1 ? sum : Value(sum - before[i]);
          for (std::size_t k = 0; k < results.size(); ++k) {
            const std::vector<double>& c = coefficients_[k];
            if (degree == 1) results[k][i] *= c[0];
            if (degree < c.size()) results[k][i] += c[degree] * next[i];
          }
        }
      });
      before.swap(now);
      now.swap(next);
    }
    return results;
  }

 private:
  std::vector<std::vector<double>> coefficients_;
  std::size_t most_ = 0;
};

}  // namespace vspring
