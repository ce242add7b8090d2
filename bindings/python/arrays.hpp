// Converts between NumPy's arrays and the library's vectors.

#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring::python {

namespace py = pybind11;

/// Contiguous arrays; the Python side converts them.
template <typename Number>
using Array = py::array_t<Number, py::array::c_style>;

template <typename Number>
std::span<const Number> span_of(const Array<Number>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

inline std::vector<Vector3> vectors_of(const Array<double>& array) { return positions_of(span_of(array)); }

inline std::vector<Index> indices_of(const Array<Index>& array) {
  const auto numbers = span_of(array);
  return {numbers.begin(), numbers.end()};
}

/// A read-only view of numbers that `owner` keeps. row: numbers per row there, if the view has only the first columns.
template <typename Number>
py::array view_of(const Number* numbers, std::vector<py::ssize_t> shape, const py::handle& owner, py::ssize_t row = 0) {
  constexpr auto size = static_cast<py::ssize_t>(sizeof(Number));
  const py::ssize_t columns = shape.size() > 1 ? shape[1] : 1;
  std::vector<py::ssize_t> strides = {(row > 0 ? row : columns) * size};
  if (shape.size() > 1) strides.push_back(size);
  py::array_t<Number> view(std::move(shape), std::move(strides), numbers, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

/// An array that takes over the numbers without a copy.
template <typename Value>
py::array array_of(std::vector<Value> values, std::vector<py::ssize_t> shape, const auto* first) {
  using Values = std::vector<Value>;
  auto kept = std::make_unique<Values>(std::move(values));
  const py::capsule owner(kept.get(), [](void* made) { std::default_delete<Values>()(static_cast<Values*>(made)); });
  (void)kept.release();
  return py::array(py::dtype::of<std::remove_cv_t<std::remove_pointer_t<decltype(first)>>>(), std::move(shape), first,
                   owner);
}

inline py::array array_of(std::vector<Vector3> positions) {
  const auto count = static_cast<py::ssize_t>(positions.size());
  const double* const first = coordinates(positions).data();
  return array_of(std::move(positions), {count, 3}, first);
}

/// (k, 2).
inline py::array array_of(const MeshEdges& edges) {
  std::vector<Index> nodes;
  nodes.reserve(2 * edges.size());
  for (const auto& [a, b] : edges) nodes.insert(nodes.end(), {a, b});
  const Index* const first = nodes.data();
  return array_of(std::move(nodes), {static_cast<py::ssize_t>(edges.size()), 2}, first);
}

/// The edges of an array of pairs of nodes.
inline MeshEdges edges_of(const Array<Index>& array) {
  const auto nodes = span_of(array);
  MeshEdges edges;
  for (std::size_t k = 0; k + 1 < nodes.size(); k += 2) edges.emplace_back(nodes[k], nodes[k + 1]);
  return edges;
}

inline py::array array_of(std::vector<double> numbers) {
  const auto count = static_cast<py::ssize_t>(numbers.size());
  const double* const first = numbers.data();
  return array_of(std::move(numbers), {count}, first);
}

inline py::array array_of(std::vector<Index> numbers) {
  const auto count = static_cast<py::ssize_t>(numbers.size());
  const Index* const first = numbers.data();
  return array_of(std::move(numbers), {count}, first);
}

}  // namespace vspring::python
