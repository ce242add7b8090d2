#include "io/drawing_part.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace vspring {
namespace {

/// Adds a run's stretches. Nodes beyond the last are those of another round.
class Cutter {
 public:
  Cutter(const Drawing::Run& run, const Window& window, Drawing& part) : run_(run), window_(window), part_(part) {}

  void cut() {
    const auto outside = std::find_if(run_.nodes.begin(), run_.nodes.end(),
                                      [&](const Vector2& node) { return !window_.contains(node); });
    if (outside == run_.nodes.end()) {
      part_.runs.push_back(run_);
      return;
    }
    // A closed run is cut where it is outside, so that no stretch is in two.
    const auto count = run_.nodes.size();
    const auto first = run_.closed ? static_cast<std::size_t>(std::distance(run_.nodes.begin(), outside)) : 0;
    const std::size_t last = run_.closed ? first + count : count - 1;
    for (std::size_t k = first; k <= last; ++k) {
      const bool beside = (k > first && inside(k - 1)) || (k < last && inside(k + 1));
      if (inside(k) || beside)
        add(k);
      else
        stretch_ = false;
    }
  }

 private:
  [[nodiscard]] bool inside(std::size_t k) const { return window_.contains(run_.nodes[k % run_.nodes.size()]); }

  void add(std::size_t k) {
    if (!stretch_) {
      Drawing::Run& stretch = part_.runs.emplace_back();
      stretch.begin = run_.begin;
      stretch.length = run_.length;
      stretch_ = true;
    }
    Drawing::Run& stretch = part_.runs.back();
    const std::size_t node = k % run_.nodes.size();
    stretch.nodes.push_back(run_.nodes[node]);
    stretch.curvatures.push_back(run_.curvatures[node]);
    stretch.arc.push_back(run_.arc[node] + (k == node ? 0 : run_.length));
    stretch.bends.push_back(run_.bends[node]);
  }

  const Drawing::Run& run_;
  const Window& window_;
  Drawing& part_;
  bool stretch_ = false;
};

}  // namespace

Drawing part_inside(const Drawing& drawing, const Window& window) {
  Drawing part;
  part.planar = drawing.planar;
  for (const Drawing::Run& run : drawing.runs) Cutter(run, window, part).cut();
  for (const Drawing::Run& run : part.runs) {
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      if (window.contains(run.nodes[k])) part.sharpest = std::max(part.sharpest, run.curvatures[k].norm());
    }
  }
  return part;
}

}  // namespace vspring
