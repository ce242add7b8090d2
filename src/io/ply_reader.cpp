// PLY, the polygon file format: text and both byte orders, with any elements and properties; as a surface, and its
// vertices as points.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/message_text.hpp"
#include "io/face_list.hpp"
#include "io/file_normals.hpp"
#include "io/ply.hpp"
#include "io/ply_data.hpp"
#include "io/point_formats.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

template <typename Data>
class PlyReader : public PlyElements<Data> {
 public:
  PlyReader(const InputFile& file, PlySource& source) : PlyElements<Data>(file, source.header), source_(source) {}

  void read();

  std::vector<Vector3> positions;
  std::vector<Vector3> normals;
  FaceList faces;

 private:
  using PlyElements<Data>::file_;
  using PlyElements<Data>::header_;
  using PlyElements<Data>::data_;
  using PlyElements<Data>::check_count;
  using PlyElements<Data>::list_length;
  using PlyElements<Data>::skip_property;
  using PlyElements<Data>::skip_elements;

  void read_nodes(const PlyElement& element);
  void read_faces(const PlyElement& element);
  void read_strips(const PlyElement& element);
  void add_face(std::span<const std::int64_t> nodes, const PlyPlace& place);
  int corner_list(const PlyElement& element) const;

  PlySource& source_;
};

template <typename Data>
void PlyReader<Data>::read_nodes(const PlyElement& element) {
  positions.reserve(element.count);
  if (source_.has_normals()) normals.reserve(element.count);
  const bool keep_rows = header_.encoding == PlyEncoding::text || element.has_lists();
  if (keep_rows) source_.rows.reserve(element.count);
  // Which of the six fields each property is.
  std::vector<int> field_of(element.properties.size(), -1);
  for (int field = 0; field < 6; ++field) {
    if (source_.fields[field] >= 0) field_of[source_.fields[field]] = field;
  }
  source_.first_row = data_.offset();
  for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
    data_.align();
    if (keep_rows) source_.rows.push_back(data_.offset());
    std::array<double, 6> values{};
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (field_of[k] >= 0)
        values[field_of[k]] = data_.number(property.type, place);
      else
        skip_property(property, place);
    }
    positions.emplace_back(values[0], values[1], values[2]);
    if (source_.has_normals()) normals.push_back(unit_or_zero(Vector3(values[3], values[4], values[5])));
  }
}

template <typename Data>
int PlyReader<Data>::corner_list(const PlyElement& element) const {
  const int list = std::max(element.find("vertex_indices"), element.find("vertex_index"));
  const PlyProperty* property = list < 0 ? nullptr : &element.properties[list];
  if (property == nullptr || !property->count_type || !is_whole(property->type))
    file_.refuse(fmt::format("element {} has no list vertex_indices of whole numbers; export the file again",
                             in_quotes(element.name)));
  return list;
}

template <typename Data>
void PlyReader<Data>::add_face(std::span<const std::int64_t> nodes, const PlyPlace& place) {
  if (faces.full()) data_.refuse("too many faces; split the file");
  for (const std::int64_t node : nodes) {
    if (node < 0) data_.refuse(fmt::format("{}: node {} does not exist; correct the face", place.text(), node));
    faces.add_corner(node, data_.offset());
  }
  faces.end_face();
}

template <typename Data>
void PlyReader<Data>::read_faces(const PlyElement& element) {
  const int list = corner_list(element);
  faces.reserve(element.count, std::min<std::uint64_t>(3 * element.count, data_.bytes_left()));
  std::vector<std::int64_t> nodes;
  for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
    for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != list) {
        skip_property(property, place);
        continue;
      }
      nodes.resize(list_length(property, place));
      for (std::int64_t& node : nodes) node = data_.whole(property.type, place);
      add_face(nodes, place);
    }
  }
}

/// Strips of triangles: each node makes one with the two before it, every other one turned; −1 ends a strip.
template <typename Data>
void PlyReader<Data>::read_strips(const PlyElement& element) {
  const int list = corner_list(element);
  for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
    for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != list) {
        skip_property(property, place);
        continue;
      }
      std::array<std::int64_t, 3> last{};
      int run = 0;
      for (std::uint64_t left = list_length(property, place); left > 0; --left) {
        const std::int64_t node = data_.whole(property.type, place);
        last = {last[1], last[2], node};
        run = node == -1 ? 0 : run + 1;
        // Strips turn corners with triangles that repeat a node; those are not faces.
        if (run < 3 || last[0] == last[1] || last[1] == last[2] || last[0] == last[2]) continue;
        const bool turned = run % 2 == 0;
        add_face(std::array{last[turned ? 1 : 0], last[turned ? 0 : 1], last[2]}, place);
      }
    }
  }
}

template <typename Data>
void PlyReader<Data>::read() {
  for (const PlyElement& element : header_.elements) {
    check_count(element);
    if (element.name == "vertex")
      read_nodes(element);
    else if (element.name == "face")
      read_faces(element);
    else if (element.name == "tristrips")
      read_strips(element);
    else
      skip_elements(element);
  }
  if (!data_.only_padding_left())
    data_.refuse("the file goes on after its last element; correct the counts in its header");
  if (faces.highest() >= static_cast<std::int64_t>(positions.size()))
    data_.refuse_at(faces.highest_where(),
                    fmt::format("node {} does not exist, nodes go from 0 to {}; correct the face", faces.highest(),
                                positions.size() - 1));
}

/// Finds the coordinates and normals among the properties of the nodes.
void find_fields(const InputFile& file, PlySource& source) {
  const PlyElement& element = ply_nodes(file, source.header);
  constexpr std::array names = {"x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t k = 0; k < names.size(); ++k) source.fields[k] = find_number(element, names[k]);
  if (source.fields[3] < 0 || source.fields[4] < 0 || source.fields[5] < 0)
    source.fields[3] = source.fields[4] = source.fields[5] = -1;
}

/// What other formats would lose.
std::vector<std::string> carried_by(const PlySource& source) {
  static const std::set<std::string_view> colours = {"red",         "green",         "blue",        "alpha",
                                                     "diffuse_red", "diffuse_green", "diffuse_blue"};
  static const std::set<std::string_view> textures = {"s",         "t",         "u",        "v",
                                                      "texture_u", "texture_v", "texcoord", "texnumber"};
  std::set<std::string> carried;
  if (source.header.comments) carried.insert("comments");
  for (const PlyElement& element : source.header.elements) {
    const bool face = element.name == "face";
    if (element.name != "vertex" && !face && element.name != "tristrips") {
      carried.insert(fmt::format("element {}", element.name));
      continue;
    }
    for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
      const std::string& name = element.properties[k].name;
      const bool known = element.name == "vertex"
                             ? std::find(source.fields.begin(), source.fields.end(), k) != source.fields.end()
                             : name == "vertex_indices" || name == "vertex_index";
      if (known) continue;
      if (colours.count(name) > 0)
        carried.insert("colours");
      else if (textures.count(name) > 0)
        carried.insert("texture coordinates");
      else
        carried.insert(fmt::format("property {} of {}", name, element.name));
    }
  }
  return {carried.begin(), carried.end()};
}

template <typename Data>
void read_data(const InputFile& file, PlySource& source, SurfaceFile& surface) {
  PlyReader<Data> reader(file, source);
  reader.read();
  surface.mesh = source.mesh = reader.faces.take(std::move(reader.positions));
  surface.normals = std::move(reader.normals);
}

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
    // Which of these fields each property is.
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

SurfaceFile read_ply(InputFile file) {
  const auto source = std::make_shared<PlySource>();
  source->header = read_ply_header(file);
  find_fields(file, *source);
  SurfaceFile surface;
  surface.format = SurfaceFormat::ply;
  if (source->header.encoding == PlyEncoding::text)
    read_data<PlyText>(file, *source, surface);
  else
    read_data<PlyBinary>(file, *source, surface);
  source->carried = carried_by(*source);
  source->file = std::move(file);
  source->forget_plain_data();
  surface.source = source;
  return surface;
}

ScatteredPoints read_ply_points(const InputFile& file) {
  const PlyHeader header = read_ply_header(file);
  if (header.encoding == PlyEncoding::text) return PointReader<PlyText>(file, header).read();
  return PointReader<PlyBinary>(file, header).read();
}

}  // namespace vspring
