// Conversions between the library and JavaScript: arrays, lists, errors, progress, reports, bytes of files.

#pragma once

#include <emscripten.h>
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring {

using emscripten::val;

/// A separate copy, which can be transferred to another thread.
template <typename Number>
val array_of(const char* type, std::size_t count, const Number* numbers) {
  const val view(emscripten::typed_memory_view(count, numbers));
  return val::global(type).new_(view);
}

inline val int_array(const std::vector<Index>& numbers) {
  return array_of("Int32Array", numbers.size(), numbers.data());
}

inline bool is_given(const val& value) { return !value.isNull() && !value.isUndefined(); }

/// None if the array is not given.
inline std::vector<Index> numbers_of(const val& array) {
  return is_given(array) ? emscripten::convertJSArrayToNumberVector<Index>(array) : std::vector<Index>();
}

/// Throws Error(invalid_argument) for a setting of another name, which nothing would hear.
inline void check_names(const val& settings, std::initializer_list<const char*> known) {
  if (!is_given(settings)) throw Error(ErrorCode::invalid_argument, "settings are an object, such as {}");
  std::string names;
  for (const char* name : known) names += (names.empty() ? "" : ", ") + std::string(name);
  const val given = val::global("Object").call<val>("keys", settings);
  for (const std::string& name : emscripten::vecFromJSArray<std::string>(given)) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(ErrorCode::invalid_argument,
                  std::string("settings have no ").append(name).append("; they have ").append(names));
  }
}

inline val positions_array(const std::vector<Vector3>& positions) {
  const std::span<const double> numbers = coordinates(positions);
  return array_of("Float64Array", numbers.size(), numbers.data());
}

/// Throws Error(invalid_argument) unless there are three numbers for each.
inline std::vector<Vector3> vectors_of(const val& array) {
  return positions_of(emscripten::convertJSArrayToNumberVector<double>(array));
}

/// Two nodes for each edge.
inline val edges_array(const MeshEdges& edges) {
  std::vector<Index> nodes;
  for (const auto& [a, b] : edges) nodes.insert(nodes.end(), {a, b});
  return array_of("Int32Array", nodes.size(), nodes.data());
}

/// Throws Error(invalid_argument) unless there are two nodes for each.
inline MeshEdges edges_of(const val& array) {
  const auto nodes = emscripten::convertJSArrayToNumberVector<Index>(array);
  if (nodes.size() % 2 != 0) throw Error(ErrorCode::invalid_argument, "edges need two nodes each");
  MeshEdges edges;
  for (std::size_t k = 0; k < nodes.size(); k += 2) edges.emplace_back(nodes[k], nodes[k + 1]);
  return edges;
}

inline val list_of(const std::vector<std::string>& lines) {
  val list = val::array();
  for (const std::string& line : lines) list.call<void>("push", val(line));
  return list;
}

/// The value returned after an error.
template <typename Value>
Value none() {
  if constexpr (std::is_same_v<Value, val>)
    return val::undefined();
  else
    return Value();
}

/// Turns library errors into JavaScript ones with the same text, which faults.js throws after the call has returned.
template <typename Call>
auto forwarding_errors(const Call& call) {
  using Value = decltype(call());
  try {
    return call();
  } catch (const std::exception& error) {
    EM_ASM({ Module['fault'] = UTF8ToString($0); }, error.what());
  }
  return none<Value>();
}

/// The bytes of a file, as a Uint8Array.
inline val bytes_array(const FileBytes& file) {
  return array_of("Uint8Array", file.bytes.size(), reinterpret_cast<const std::uint8_t*>(file.bytes.data()));
}

/// The given normals, of unit length: `nodes`, ascending, and `normals`, three numbers each.
inline val held_normals(const Constraints& constraints) {
  std::vector<Index> nodes;
  std::vector<Vector3> normals;
  for (Index node = 0; node < constraints.node_count(); ++node) {
    if (!constraints.normal_fixed(node)) continue;
    nodes.push_back(node);
    normals.push_back(constraints.normal(node));
  }
  val result = val::object();
  result.set("nodes", int_array(nodes));
  result.set("normals", positions_array(normals));
  return result;
}

/// How a shape is symmetric.
template <typename Shape>
val to_val(const Symmetric<Shape>& shape) {
  val result = val::object();
  result.set("isHalf", shape.is_half);
  result.set("pairs", shape.pairs);
  result.set("onPlane", shape.on_plane);
  result.set("partner", array_of("Int32Array", shape.partner.size(), shape.partner.data()));
  return result;
}

/// The number of threads given as `threads` on loading; one if not given, or if linked without threads.
inline int threads() {
  const val given = val::module_property("threads");
  return given.isUndefined() || val::module_property("PThread").isUndefined() ? 1 : given.as<int>();
}

/// Makes the context call progress(fraction), which may be null; if it returns true the solution ends soon.
inline void ask(Context& context, const val& progress) {
  if (progress.isNull() || progress.isUndefined()) return;
  context.on_progress = [&context, progress](const Progress& now) {
    if (progress(now.fraction).as<bool>()) context.cancel();
  };
}

/// How a run ended.
inline val outcome_of(const FairReport& report) {
  val result = val::object();
  result.set("outcome", std::string(name(report.outcome)));
  result.set("usable", report.usable());
  result.set("iterations", report.iterations);
  result.set("seconds", report.seconds);
  result.set("threads", report.threads);
  result.set("expectedError", report.expected_error ? val(*report.expected_error) : val::null());
  result.set("movingNodes", report.moving_nodes);
  std::vector<std::string> warnings;
  for (const Warning& warning : report.warnings) warnings.push_back(warning.text);
  result.set("warnings", list_of(warnings));
  return result;
}

/// The outcome, and how far nodes moved.
inline val to_val(const FairReport& report) {
  val result = outcome_of(report);
  result.set("greatestMove", report.greatest_move);
  return result;
}

}  // namespace vspring
