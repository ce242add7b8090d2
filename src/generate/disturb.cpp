// Meshes with noise added, or with nodes and faces renumbered.

#include <numeric>

#include "base/random.hpp"
#include "generate/arguments.hpp"
#include "vspring/topology.hpp"

namespace vspring::generate {

namespace {

/// The numbers 0 … count − 1 in random order (Fisher and Yates).
std::vector<Index> permutation(Index count, Random& random) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  for (std::size_t k = numbers.size(); k > 1; --k) std::swap(numbers[k - 1], numbers[random.below(k)]);
  return numbers;
}

}  // namespace

PolygonMesh add_noise(const PolygonMesh& mesh, double amplitude, std::uint64_t seed, bool move_boundary) {
  require_length_or_zero("amplitude", amplitude);
  std::vector<std::uint8_t> held(mesh.positions().size(), 0);
  if (!move_boundary) held = boundary_nodes(mesh);
  Random random(seed);
  std::vector<Vector3> positions = mesh.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (held[i] == 0) positions[i] += amplitude * random.in_ball();
  }
  PolygonMesh noisy = mesh;
  noisy.set_positions(std::move(positions));
  return noisy;
}

Shuffled shuffle(const PolygonMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  Shuffled result;
  result.new_number = permutation(mesh.node_count(), random);
  result.new_face_number = permutation(mesh.face_count(), random);

  std::vector<Vector3> positions(mesh.positions().size());
  for (Index i = 0; i < mesh.node_count(); ++i)
    positions[static_cast<std::size_t>(result.new_number[static_cast<std::size_t>(i)])] = mesh.position(i);
  std::vector<Index> old_face(static_cast<std::size_t>(mesh.face_count()));
  for (Index f = 0; f < mesh.face_count(); ++f)
    old_face[static_cast<std::size_t>(result.new_face_number[static_cast<std::size_t>(f)])] = f;

  std::vector<Index> face_begin{0};
  std::vector<Index> corners;
  face_begin.reserve(old_face.size() + 1);
  corners.reserve(mesh.corners().size());
  for (const Index f : old_face) {
    for (const Index node : mesh.face(f)) corners.push_back(result.new_number[static_cast<std::size_t>(node)]);
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  result.mesh = PolygonMesh(std::move(positions), std::move(face_begin), std::move(corners));
  return result;
}

}  // namespace vspring::generate
