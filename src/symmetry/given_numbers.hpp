#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

/// Which given node, face or point is meant by a number of the whole.
struct GivenNumbers {
  /// points: how many were given; 0 without.
  template <typename Shape>
  explicit GivenNumbers(const Symmetric<Shape>& shape, Index points = 0)
      : nodes(shape.given.node_count()), partner(shape.partner), given_points(points), is_half(shape.is_half) {
    if constexpr (std::is_same_v<Shape, PolygonMesh>) faces = shape.given.face_count();
  }

  [[nodiscard]] Index node(Index of_whole) const {
    return of_whole < nodes || of_whole >= static_cast<Index>(partner.size())
               ? of_whole
               : partner[static_cast<std::size_t>(of_whole)];
  }
  [[nodiscard]] Index face(Index of_whole) const { return is_half && of_whole >= faces ? of_whole - faces : of_whole; }
  [[nodiscard]] Index point(Index of_whole) const {
    const Index image = of_whole - given_points;
    return image < 0 || image >= static_cast<Index>(points_with_image.size())
               ? of_whole
               : points_with_image[static_cast<std::size_t>(image)];
  }

  Index nodes;
  std::span<const Index> partner;
  Index faces = 0;
  Index given_points;
  std::vector<Index> points_with_image;  ///< the given points whose mirror images follow them, in their order
  bool is_half;
};

/// A message about the whole with the numbers that were given: those after "node", "point", "edge" and "face", also in
/// lists.
std::string with_given_numbers(std::string_view text, const GivenNumbers& numbers);
std::vector<Advice> with_given_numbers(std::span<const Advice> advice, const GivenNumbers& numbers);

/// Has warnings name what was given. If a half is given, those that count nodes say that they are about the whole.
void name_what_was_given(std::vector<Warning>& warnings, const GivenNumbers& numbers);

/// Calls work(), and has errors name what was given.
template <typename Work>
auto naming_what_was_given(const GivenNumbers& numbers, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.code(), with_given_numbers(error.fault(), numbers), with_given_numbers(error.advice(), numbers));
  }
}

}  // namespace vspring
