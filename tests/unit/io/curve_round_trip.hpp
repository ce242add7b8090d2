#pragma once

#include "unit/io/scratch.hpp"
#include "vspring/curve_file.hpp"

namespace vspring {

/// Reads texts as curves of one format and writes them again.
class CurveScratch : public Scratch {
 protected:
  [[nodiscard]] CurveFile read(const std::string& text, const std::string& extension) const {
    return read_curve(put("in." + extension, text));
  }

  /// The text after nodes went to places.
  std::string moved(const std::string& text, const std::string& extension,
                    const std::vector<std::pair<std::size_t, Vector3>>& places) const {
    const CurveFile file = read(text, extension);
    std::vector<Vector3> positions = file.curve.positions();
    for (const auto& [node, place] : places) positions.at(node) = place;
    EXPECT_TRUE(write_curve(path("out." + extension), file, positions).empty());
    return get("out." + extension);
  }
  std::string unmoved(const std::string& text, const std::string& extension) const {
    return moved(text, extension, {});
  }
};

/// The nodes of a chain; empty where there is no such chain.
inline std::vector<Index> chain_of(const CurveFile& file, std::size_t chain = 0) {
  return chain < file.curve.chains().size() ? file.curve.chains()[chain].nodes : std::vector<Index>();
}

}  // namespace vspring
