// The vertices of a PLY file as points.
#include <algorithm>

#include "io/ply_elements.hpp"
#include "io/point_source.hpp"

namespace vspring {
namespace {

/// Data: PlyText or PlyBinary.
template <typename Data>
class PointReader : private PlyElements<Data> {
 public:
  using PlyElements<Data>::PlyElements;

  ScatteredPoints read() {
    const PlyElement& nodes = ply_nodes(this->file_, this->header_);
    for (const PlyElement& element : this->header_.elements) {
      this->check_count(element);
      if (&element == &nodes) return read_points(element);
      this->skip_elements(element);
    }
    return {};
  }

 private:
  ScatteredPoints read_points(const PlyElement& element) {
    constexpr std::size_t normal = 3;
    constexpr std::size_t weight = 6;
    // Which of these each property is.
    std::vector<std::size_t> field_of(element.properties.size(), weight + 1);
    constexpr std::array names = {"x", "y", "z", "nx", "ny", "nz"};
    bool faces = true;
    for (std::size_t k = normal; k < names.size(); ++k) faces = faces && find_number(element, names[k]) >= 0;
    for (std::size_t k = 0; k < (faces ? names.size() : normal); ++k)
      field_of[static_cast<std::size_t>(find_number(element, names[k]))] = k;
    const int named = find_number(element, "weight");
    const int weighed = named >= 0 ? named : find_number(element, "confidence");
    if (weighed >= 0) field_of[static_cast<std::size_t>(weighed)] = weight;

    ScatteredPoints points;
    points.positions.reserve(element.count);
    if (weighed >= 0) points.weights.reserve(element.count);
    if (faces) points.normals.reserve(element.count);
    for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
      std::array<double, weight + 1> values{};
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        if (field_of[k] <= weight)
          values[field_of[k]] = this->data_.number(property.type, place);
        else
          this->skip_property(property, place);
        if (field_of[k] == weight && !is_point_weight(values[weight]))
          this->data_.refuse(fmt::format("{}: its weight is {}; give 0 or more", place.text(), values[weight]));
      }
      points.positions.emplace_back(values[0], values[1], values[2]);
      if (weighed >= 0) points.weights.push_back(values[weight]);
      if (faces) points.normals.emplace_back(values[normal], values[normal + 1], values[normal + 2]);
    }
    return points;
  }
};

}  // namespace

ScatteredPoints read_ply_points(const InputFile& file) {
  const PlyHeader header = read_ply_header(file);
  if (header.encoding == PlyEncoding::text) return PointReader<PlyText>(file, header).read();
  return PointReader<PlyBinary>(file, header).read();
}

}  // namespace vspring
