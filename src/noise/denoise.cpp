#include "noise/denoise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/cancellation.hpp"
#include "base/random.hpp"
#include "noise/flat_faces.hpp"
#include "noise/low_pass.hpp"
#include "shape/direction.hpp"

namespace vspring {

namespace {

// From waves of two edges to about thirty.
constexpr Band low_passes[] = {{1.6, 4},   {0.8, 4},   {0.4, 4},   {0.2, 4},   {0.1, 4},   {0.05, 4},
                               {0.035, 5}, {0.025, 6}, {0.018, 6}, {0.013, 6}, {0.009, 6}, {1.2, 2},
                               {0.6, 2},   {0.3, 2},   {0.15, 2},  {0.075, 2}};
// The band whose normals noise is measured along.
constexpr std::size_t band_of_normals = 1;
// Small features need averages over few nodes, much noise and smooth shapes over many; the last choice is the same
// everywhere.
constexpr Choice choices_of_bands[] = {{6, 0, 5}, {12, 0, 8}, {30, 0, 20}, {120, 0.2, 60}, {120, 1, 1e4}};
constexpr Choice last_choice[] = {{300, 0.3, 100}};
// Which of these get flat faces, and after how many rounds.
constexpr std::size_t sharpest = 0;
constexpr std::size_t middle = 2;
constexpr std::size_t whole = 4;
constexpr std::array turns_of_sharpest = {6, 15};
constexpr std::array turns_of_middle = {12};
constexpr std::array turns_of_whole = {10};

// Numbers of random fields that measure how much a node's place follows its own noise, for low passes and for choices;
// the latter are disturbed by this share of the noise (S. Ramani, T. Blu, M. Unser, "Monte-Carlo SURE", IEEE TIP 17,
// 2008).
constexpr int fields_of_bands = 2;
using Four = Eigen::Array4d;
constexpr int fields_of_choices = 3;
constexpr double disturbed = 0.05;

// Steps to the neighbours' mean for nodes of unknown place.
constexpr int steps_of_unknown = 20;

// Edges that turn by more than 115° are folds: those of blocks turn by about 90°.
constexpr double folded = -0.42;
constexpr int most_rounds = 20;
constexpr int steps_of_round = 3;
// In standard deviations of the noise: how far noise folds nodes.
constexpr double most_unfolding = 1;

/// Pairs of faces at an edge whose normals have less than this cosine.
std::vector<std::pair<std::uint32_t, std::uint32_t>> turned_pairs(const ScanMesh& mesh, const Places& places,
                                                                  double cosine, ThreadTeam& team) {
  std::vector<Vector3> normals = face_areas(mesh, places, team);
  for (std::size_t f = 0; f < normals.size(); ++f) {
    end_if_cancelled_at(f);
    normals[f].stableNormalize();
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    end_if_cancelled_at(f);
    for (const std::uint32_t g : mesh.around.of(f)) {
      if (g <= f || normals[f].dot(normals[g]) > cosine) continue;
      const auto corners = mesh.faces.of(g);
      const auto shares = [&](std::uint32_t i) {
        return std::find(corners.begin(), corners.end(), i) != corners.end();
      };
      const auto own = mesh.faces.of(f);
      if (std::count_if(own.begin(), own.end(), shares) >= 2) pairs.emplace_back(f, g);
    }
  }
  return pairs;
}

/// 1 for each moving node of two faces that are folded onto each other.
std::vector<std::uint8_t> nodes_at_folds(const ScanMesh& mesh, const Places& places, ThreadTeam& team) {
  std::vector<std::uint8_t> found(mesh.moving, 0);
  for (const auto& [f, g] : turned_pairs(mesh, places, folded, team)) {
    for (const std::uint32_t face : {f, g}) {
      for (const std::uint32_t i : mesh.faces.of(face)) {
        if (i < mesh.moving) found[i] = 1;
      }
    }
  }
  return found;
}

/// Where more edges fold than in the noisy mesh, as inside close lips and ears, nodes at newly folded edges return to
/// their places.
void take_back_new_folds(const ScanMesh& mesh, Places& places, const Places& noisy, ThreadTeam& team) {
  const auto before = turned_pairs(mesh, noisy, beyond_right, team);
  for (int round = 0; round < most_rounds; ++round) {
    const auto now = turned_pairs(mesh, places, beyond_right, team);
    if (now.size() <= before.size()) return;
    for (const auto& pair : now) {
      if (std::binary_search(before.begin(), before.end(), pair)) continue;
      for (const std::uint32_t face : {pair.first, pair.second}) {
        for (const std::uint32_t i : mesh.faces.of(face)) {
          if (i < mesh.moving) places[i] = noisy[i];
        }
      }
    }
  }
}

/// Moves folded nodes towards their neighbours' mean, no further than noise explains, as tips and blades would shrink.
/// If half of them stay folded, the shape itself is so, and nothing changes.
void unfold(const ScanMesh& mesh, Places& places, double deviation, ThreadTeam& team) {
  const double furthest = most_unfolding * deviation;
  const Places start = places;
  std::vector<std::uint8_t> found = nodes_at_folds(mesh, places, team);
  const auto at_first = std::count(found.begin(), found.end(), 1);
  auto left = at_first;
  for (int round = 0; round < most_rounds && left > 0; ++round) {
    for (int step = 0; step < steps_of_round; ++step) {
      const Places before = places;
      for (std::size_t i = 0; i < mesh.moving; ++i) {
        end_if_cancelled_at(i);
        const auto neighbours = mesh.neighbours.of(i);
        if (found[i] == 0 || neighbours.empty()) continue;
        Vector3 mean = Vector3::Zero();
        for (const std::uint32_t j : neighbours) mean += before[j] / static_cast<double>(neighbours.size());
        places[i] = (before[i] + mean) / 2;
        const Vector3 move = places[i] - start[i];
        if (move.norm() > furthest) places[i] = start[i] + furthest / move.norm() * move;
      }
    }
    found = nodes_at_folds(mesh, places, team);
    left = std::count(found.begin(), found.end(), 1);
  }
  if (2 * left > at_first) places = start;
}

std::vector<const Places*> pointers(const std::vector<Places>& shapes) {
  std::vector<const Places*> result;
  result.reserve(shapes.size());
  for (const Places& shape : shapes) result.push_back(&shape);
  return result;
}

void append(std::vector<Places>& shapes, std::vector<Places> more) {
  shapes.insert(shapes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

class Denoiser {
 public:
  Denoiser(const ScanMesh& mesh, Places noisy, const std::vector<std::uint8_t>& known, double deviation,
           ThreadTeam& team)
      : mesh_(mesh),
        noisy_(std::move(noisy)),
        known_(known),
        deviation_(deviation),
        low_pass_(low_passes),
        team_(team) {
    place_unknown();
  }

  Places run(const std::function<bool()>& ended) {
    find_followed();
    low_ = low_pass_.filter(mesh_, noisy_, team_);
    normals_ = node_normals(mesh_, low_[band_of_normals], team_);
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (known_[i] == 0) normals_[i].setZero();
    }
    const std::vector<Places> shapes = shapes_of(noisy_, low_);
    std::vector<double> followed(mesh_.moving * shapes.size(), 0);
    for (int field = 0; field < fields_of_choices; ++field) {
      if (ended()) return noisy_;
      add_followed(shapes, followed);
    }
    const Risks risks = risks_of(mesh_, pointers(shapes), noisy_, normals_, followed, deviation_, team_);
    Places result = choose(mesh_, pointers(shapes), risks, last_choice, deviation_, team_).front();
    unfold(mesh_, result, deviation_, team_);
    take_back_new_folds(mesh_, result, noisy_, team_);
    return result;
  }

 private:
  void place_unknown() {
    for (int step = 0; step < steps_of_unknown; ++step) {
      for (std::size_t i = 0; i < known_.size(); ++i) {
        end_if_cancelled_at(i);
        const auto neighbours = mesh_.neighbours.of(i);
        if (known_[i] != 0 || neighbours.empty()) continue;
        noisy_[i].setZero();
        for (const std::uint32_t j : neighbours) noisy_[i] += noisy_[j] / static_cast<double>(neighbours.size());
      }
    }
  }

  /// Estimates the diagonals of the low passes.
  void find_followed() {
    const std::size_t width = std::size(low_passes) + 1;
    followed_.assign(mesh_.moving * width, 0);
    for (int k = 0; k < fields_of_bands; ++k) {
      std::vector<Four> signs(mesh_.nodes, Four::Zero());
      for (std::size_t i = 0; i < mesh_.moving; ++i) {
        end_if_cancelled_at(i);
        for (double& sign : signs[i]) sign = random_.below(2) == 0 ? -1 : 1;
      }
      const auto filtered = low_pass_.filter(mesh_, signs, team_);
      for (std::size_t i = 0; i < mesh_.moving; ++i) {
        end_if_cancelled_at(i);
        followed_[i * width] = 1;
        for (std::size_t band = 0; band < filtered.size(); ++band)
          followed_[i * width + 1 + band] += (signs[i] * filtered[band][i]).mean() / fields_of_bands;
      }
    }
  }

  /// All shapes to choose from. low: these places after each low pass.
  std::vector<Places> shapes_of(const Places& places, const std::vector<Places>& low) {
    std::vector<const Places*> all = {&places};
    for (const Places& one : low) all.push_back(&one);
    const Risks risks = risks_of(mesh_, all, places, normals_, followed_, deviation_, team_);
    std::vector<Places> shapes = choose(mesh_, all, risks, choices_of_bands, deviation_, team_);
    append(shapes, with_flat_faces(mesh_, shapes[sharpest], turns_of_sharpest, team_));
    append(shapes, with_flat_faces(mesh_, shapes[middle], turns_of_middle, team_));
    append(shapes, with_flat_faces(mesh_, shapes[whole], turns_of_whole, team_));
    return shapes;
  }

  void add_followed(const std::vector<Places>& shapes, std::vector<double>& followed) {
    const double length = disturbed * deviation_;
    std::vector<double> signs(mesh_.moving);
    Places places(mesh_.nodes, Vector3::Zero());
    for (std::size_t i = 0; i < mesh_.moving; ++i) {
      end_if_cancelled_at(i);
      signs[i] = random_.normal();
      places[i] = length * signs[i] * normals_[i];
    }
    std::vector<Places> low = low_pass_.filter(mesh_, places, team_);
    for (std::size_t k = 0; k < low.size(); ++k) add(low[k], low_[k]);
    add(places, noisy_);
    const std::vector<Places> others = shapes_of(places, low);
    for (std::size_t i = 0; i < mesh_.moving; ++i) {
      end_if_cancelled_at(i);
      for (std::size_t k = 0; k < shapes.size(); ++k)
        followed[i * shapes.size() + k] +=
            signs[i] * (others[k][i] - shapes[k][i]).dot(normals_[i]) / (length * fields_of_choices);
    }
  }

  static void add(Places& places, const Places& others) {
    end_if_cancelled();
    for (std::size_t i = 0; i < places.size(); ++i) places[i] += others[i];
  }

  const ScanMesh& mesh_;
  Places noisy_;
  const std::vector<std::uint8_t>& known_;
  double deviation_;
  LowPass low_pass_;
  ThreadTeam& team_;
  Random random_{1};
  std::vector<double> followed_;
  std::vector<Places> low_;
  std::vector<Vector3> normals_;
};

}  // namespace

Places without_noise(const ScanMesh& mesh, Places noisy, const std::vector<std::uint8_t>& known, double deviation,
                     const std::function<bool()>& ended, ThreadTeam& team) {
  if (mesh.moving == 0) return noisy;
  return Denoiser(mesh, std::move(noisy), known, deviation, team).run(ended);
}

}  // namespace vspring
