#include "vspring/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/message_text.hpp"
#include "rules/edges_between.hpp"
#include "vspring/error.hpp"
#include "vspring/sharp_edges.hpp"
#include "vspring/topology.hpp"
#include "vspring/weld.hpp"

namespace vspring {

namespace {

using nlohmann::json;

using Flags = std::vector<std::uint8_t>;
using Directions = std::vector<Vector3>;

/// A surface or curve as rules see it.
struct RuledShape {
  const std::vector<Vector3>& positions;
  std::function<Flags()> boundary;
  std::function<Flags()> non_manifold;
  std::function<Directions(const std::vector<Index>&)> normals;
  std::function<Directions(const std::vector<Index>&)> tangents;  ///< none for surfaces
  std::function<Directions(const std::vector<Index>&, NodeSide)> side_tangents;
  std::function<MeshEdges(const std::vector<Index>&)> edges_between;  ///< as edges_between(); none for curves
  /// As as_sharp_edges(); none for curves.
  std::function<SharpEdges(const MeshEdges&, std::vector<LeftOutEdge>&)> sharp_edges;
};

Flags non_manifold_nodes(const PolygonMesh& mesh) {
  Flags wrong(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Defect& defect : check(mesh)) {
    const bool edge = defect.kind == Defect::Kind::non_manifold_edge;
    if (!edge && defect.kind != Defect::Kind::non_manifold_node) continue;
    wrong[static_cast<std::size_t>(defect.node)] = 1;
    if (edge) wrong[static_cast<std::size_t>(defect.other)] = 1;
  }
  return wrong;
}

/// Nodes where chains meet or cross.
Flags non_manifold_nodes(const PolygonCurve& curve) {
  Flags times(static_cast<std::size_t>(curve.node_count()), 0);
  for (const auto& chain : curve.chains()) {
    for (const Index node : chain.nodes) {
      std::uint8_t& seen = times[static_cast<std::size_t>(node)];
      seen = static_cast<std::uint8_t>(std::min(seen + 1, 2));
    }
  }
  for (std::uint8_t& seen : times) seen = seen > 1 ? 1 : 0;
  return times;
}

/// Finds contradictions between rules for nodes that are welded into one. A node without a rule contradicts none.
template <typename Value>
class Agreement {
 public:
  struct Told {
    Index node = -1;  ///< the last one named, by its number before welding
    int rule = 0;
    bool named = false;  ///< itself, by a group or a region; not by "all", "boundary" or the like
    std::optional<Value> value = std::nullopt;
  };

  /// Notes a rule's value for `told.node`, which `first` represents. Returns a node that contradicts it, else −1.
  Index differing(std::size_t node_count, Index first, const Told& told, const auto& same) {
    told_.resize(node_count);
    Told& last = told_[static_cast<std::size_t>(first)];
    const bool has_say =
        last.node >= 0 && last.node != told.node && (last.rule == told.rule || (last.named && told.named));
    const Index other = has_say && !same(*last.value, *told.value) ? last.node : -1;
    last = told;
    return other;
  }
  void forget(Index first) {
    if (!told_.empty()) told_[static_cast<std::size_t>(first)] = {};
  }

 private:
  std::vector<Told> told_;  // by representative
};

/// Applies the rules of one text. Every fault names the rule, counted from 1.
class RuleReader {
 public:
  RuleReader(Constraints& constraints, const RuledShape& shape, const RuleInput& input)
      : constraints_(constraints), shape_(shape), positions_(shape.positions), input_(input) {}

  /// Returns the sharp edges.
  MeshEdges read(const json& text) {
    if (!text.is_object() || !text.contains("rules") || !text["rules"].is_array())
      throw fault("write {\"rules\": [{\"nodes\": …, \"position\": …, \"normal\": …}, …]}");
    require_keys(text, {"rules"});
    for (const json& rule : text["rules"]) {
      ++rule_;
      apply(rule);
    }
    check_paths();
    return std::move(sharp_edges_);
  }

 private:
  [[nodiscard]] Error fault(const std::string& what, std::vector<Advice> advice = {}) const {
    return {ErrorCode::unusable_constraint, rule_ > 0 ? fmt::format("rule {}: {}", rule_, what) : "rules: " + what,
            std::move(advice)};
  }

  void require_keys(const json& object, std::initializer_list<const char*> known) const {
    for (const auto& [key, value] : object.items()) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      std::string list;
      for (const char* name : known) list += (list.empty() ? "" : ", ") + std::string(name);
      throw fault(fmt::format("\"{}\" means nothing here; known: {}", in_one_line(key), list));
    }
  }

  void apply(const json& rule) {
    if (!rule.is_object())
      throw fault(fmt::format("{} is no rule; write {{\"nodes\": …, \"position\": …}}", in_one_line(rule.dump())));
    if (curve()) {
      if (rule.contains("sharp")) throw fault("\"sharp\" is for surfaces; a curve takes \"corner\"");
      require_keys(rule, {"nodes", "position", "normal", "tangent", "tangent_in", "tangent_out", "corner"});
    } else {
      for (const char* key : {"tangent", "tangent_in", "tangent_out", "corner"}) {
        if (rule.contains(key)) throw fault(fmt::format("\"{}\" is for curves; a surface takes \"normal\"", key));
      }
      require_keys(rule, {"nodes", "position", "slide", "normal", "sharp"});
    }
    if (!rule.contains("nodes")) throw fault("it names no \"nodes\"");
    if (rule.size() < 2)
      throw fault(curve() ? "it has none of \"position\", \"normal\" and \"tangent\", and makes no corner"
                          : "it has none of \"position\", \"slide\", \"normal\" and \"sharp\"");
    const std::vector<Index> nodes = select(rule["nodes"]);
    named_ = !rule["nodes"].is_string();
    if (!nodes.empty()) refuse_contradictions(rule, nodes.front());
    if (rule.contains("position")) apply_positions(nodes, rule["position"]);
    if (rule.contains("slide")) apply_slide(nodes, rule["slide"]);
    if (rule.contains("normal")) apply_normals(nodes, rule["normal"]);
    if (rule.contains("sharp")) apply_sharp(nodes, rule);
    if (rule.contains("tangent")) apply_tangents(nodes, rule["tangent"]);
    if (rule.contains("corner")) apply_corner(nodes, rule["corner"]);
    for (const NodeSide side : node_sides) {
      if (rule.contains(key_of(side))) apply_tangents(nodes, rule[key_of(side)], side);
    }
  }

  static const char* key_of(NodeSide side) { return side == NodeSide::before ? "tangent_in" : "tangent_out"; }

  /// node: the first of the rule's.
  void refuse_contradictions(const json& rule, Index node) const {
    if (rule.contains("slide") && rule.contains("position"))
      throw fault(fmt::format("node {}: it either has a \"position\" or is to \"slide\"", node));
    const bool has_sides = rule.contains("tangent_in") || rule.contains("tangent_out");
    if (rule.contains("tangent") && (has_sides || rule.contains("corner")))
      throw fault(fmt::format(
          "node {}: it either goes on in one \"tangent\", or is a corner, with \"tangent_in\" and \"tangent_out\"",
          node));
    if (has_sides && rule.contains("corner") && rule["corner"] == false)
      throw fault(fmt::format("node {}: without a corner it has one \"tangent\" in place of those of its sides", node));
  }

  void apply_corner(const std::vector<Index>& nodes, const json& value) {
    if (!value.is_boolean())
      throw fault(fmt::format("{} is no corner; write true or false", in_one_line(value.dump())));
    for (const Index i : nodes) {
      if (value.get<bool>())
        constraints_.make_corner(i);
      else
        constraints_.free_corner(i);
    }
  }

  void apply_sharp(const std::vector<Index>& nodes, const json& rule) {
    std::vector<Index> firsts = nodes;
    for (Index& node : firsts) node = first(node);
    const json& value = rule["sharp"];
    if (value == true) {
      const MeshEdges edges = shape_.edges_between(firsts);
      if (edges.empty()) throw fault("no edge of two faces leads from one of its nodes to another");
      sharp_edges_.insert(sharp_edges_.end(), edges.begin(), edges.end());
    } else if (value == "path") {
      add_path(nodes, firsts, rule["nodes"].is_array());
    } else {
      throw fault(
          fmt::format("{} says nothing of sharp edges; write true for those between the nodes, or \"path\" for those "
                      "from each to the next",
                      in_one_line(value.dump())));
    }
  }

  /// firsts: the representatives of these nodes.
  void add_path(const std::vector<Index>& nodes, const std::vector<Index>& firsts, bool is_listed) {
    if (!is_listed || nodes.size() < 2)
      throw fault("a \"path\" leads from each node to the next; write a list of two or more");
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      paths_.emplace_back(firsts[k - 1], firsts[k]);
      steps_.push_back({rule_, nodes[k - 1], nodes[k]});
    }
  }

  /// All at once, as there may be many.
  void check_paths() {
    if (paths_.empty()) return;
    std::vector<LeftOutEdge> left_out;
    (void)shape_.sharp_edges(paths_, left_out);
    if (!left_out.empty()) {
      const LeftOutEdge& edge = left_out.front();
      const auto at = std::find(paths_.begin(), paths_.end(), std::pair(edge.first, edge.second));
      const Step& step = steps_[static_cast<std::size_t>(at - paths_.begin())];
      rule_ = step.rule;
      throw fault(fmt::format("sharp edge from node {} to node {}: {}", step.from, step.to, edge.why));
    }
    sharp_edges_.insert(sharp_edges_.end(), paths_.begin(), paths_.end());
  }

  [[nodiscard]] bool curve() const { return shape_.tangents != nullptr; }
  [[nodiscard]] Index node_count() const { return input_.named_nodes.value_or(static_cast<Index>(positions_.size())); }

  /// The representative of this node.
  [[nodiscard]] Index first(Index node) const {
    return input_.welded != nullptr ? input_.welded->representative[static_cast<std::size_t>(node)] : node;
  }

  /// Refuses a value that contradicts one of a node joined with this one.
  template <typename Value>
  void agree(Agreement<Value>& agreement, Index node, const Value& value, const char* what, const auto& same) {
    if (input_.welded == nullptr) return;
    const Index other = agreement.differing(positions_.size(), first(node), {node, rule_, named_, value}, same);
    if (other >= 0)
      throw fault(fmt::format("nodes {} and {} are welded into one and cannot have two {}s", other, node, what),
                  {{Remedy::rules, "give both the same"},
                   {Remedy::rules, "give only one of them one"},
                   {Remedy::weld, "weld within less"}});
  }

  void agree_on_slide(Index node, const std::optional<Support>& support) {
    agree(slides_told_, node, support, "way",
          [](const std::optional<Support>& a, const std::optional<Support>& b) { return a == b; });
  }

  void fix_position(Index node, const Vector3& position) {
    agree_on_slide(node, std::nullopt);
    agree(positions_told_, node, position, "position",
          [&](const Vector3& a, const Vector3& b) { return (a - b).stableNorm() <= input_.welded->tolerance; });
    constraints_.fix_position(first(node), position);
  }

  [[nodiscard]] std::vector<Index> nodes_where(const auto& holds) const {
    std::vector<Index> nodes;
    for (Index i = 0; i < node_count(); ++i) {
      if (holds(i)) nodes.push_back(i);
    }
    return nodes;
  }

  [[nodiscard]] std::vector<Index> select(const json& selection) const {
    if (selection == "all") return nodes_where([](Index) { return true; });
    if (selection == "boundary" || selection == "interior") {
      const Flags boundary = shape_.boundary();
      const std::uint8_t wanted = selection == "boundary" ? 1 : 0;
      return nodes_where([&](Index i) { return boundary[static_cast<std::size_t>(first(i))] == wanted; });
    }
    if (selection == "non-manifold") {
      const Flags wrong = shape_.non_manifold();
      return nodes_where([&](Index i) { return wrong[static_cast<std::size_t>(first(i))] != 0; });
    }
    if (selection.is_object() && selection.size() == 1 && selection.contains("group") && selection["group"].is_string())
      return group(selection["group"].get<std::string>());
    if (selection.is_object() && selection.size() == 1 && selection.contains("region") &&
        selection["region"].is_string()) {
      try {
        return select_region({positions_.begin(), positions_.begin() + node_count()},
                             parse_region(selection["region"].get<std::string>()),
                             input_.groups != nullptr ? *input_.groups : Groups());
      } catch (const Error& error) {
        throw Error(error.code(), fmt::format("rule {}: {}", rule_, error.what()));
      }
    }
    if (selection.is_array()) return listed(selection);
    throw fault(fmt::format(
        "{} selects no nodes; write \"all\", \"boundary\", \"interior\", \"non-manifold\", {{\"group\": NAME}}, "
        "{{\"region\": SPECIFICATION}} or a list of node numbers",
        in_one_line(selection.dump())));
  }

  [[nodiscard]] std::vector<Index> group(const std::string& name) const {
    if (input_.groups != nullptr) {
      const auto found = input_.groups->find(name);
      if (found != input_.groups->end()) return found->second;
    }
    throw fault(fmt::format("the shape has no group \"{}\"", in_one_line(name)));
  }

  [[nodiscard]] std::vector<Index> listed(const json& list) const {
    std::vector<Index> nodes;
    for (const json& entry : list) {
      if (!entry.is_number_integer() || entry.get<std::int64_t>() < 0 || entry.get<std::int64_t>() >= node_count())
        throw fault(
            fmt::format("{} is not a node; nodes go from 0 to {}", in_one_line(entry.dump()), node_count() - 1));
      nodes.push_back(entry.get<Index>());
    }
    std::vector<Index> sorted = nodes;
    std::sort(sorted.begin(), sorted.end());
    const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
    if (repeated != sorted.end()) throw fault(fmt::format("node {} is named twice", *repeated));
    return nodes;
  }

  [[nodiscard]] Vector3 vector(const json& value, const char* what) const {
    const bool size_fits = value.size() == 3 || (curve() && value.size() == 2);
    if (!value.is_array() || !size_fits ||
        !std::all_of(value.begin(), value.end(), [](const json& x) { return x.is_number(); }))
      throw fault(fmt::format("{} is no {}; write {}", in_one_line(value.dump()), what, numbers()));
    return {value[0].get<double>(), value[1].get<double>(), value.size() == 3 ? value[2].get<double>() : 0};
  }

  [[nodiscard]] const char* numbers() const { return curve() ? "two or three numbers" : "three numbers"; }

  /// One vector for all nodes, or a list of them, one per node.
  [[nodiscard]] std::vector<Vector3> vectors(const json& value, std::size_t count, const char* what) const {
    if (!value.is_array() || value.empty() || !value[0].is_array())
      return std::vector<Vector3>(count, vector(value, what));
    if (value.size() != count) throw fault(fmt::format("{} {}s are given for {} nodes", value.size(), what, count));
    std::vector<Vector3> all;
    for (const json& entry : value) all.push_back(vector(entry, what));
    return all;
  }

  void apply_positions(const std::vector<Index>& nodes, const json& value) {
    if (value == "free") {
      for (const Index i : nodes) {
        constraints_.free_position(first(i));
        positions_told_.forget(first(i));
        slides_told_.forget(first(i));
      }
    } else if (value == "fixed") {
      for (const Index i : nodes) fix_position(i, positions_[static_cast<std::size_t>(first(i))]);
    } else if (value.is_string()) {
      throw fault(
          fmt::format("{} is no position; write \"fixed\", \"free\" or {}", in_one_line(value.dump()), numbers()));
    } else {
      const auto positions = vectors(value, nodes.size(), "position");
      for (std::size_t k = 0; k < nodes.size(); ++k) fix_position(nodes[k], positions[k]);
    }
  }

  void apply_slide(const std::vector<Index>& nodes, const json& value) {
    if (!value.is_array()) return slide(nodes, support_of(value));
    if (value.size() != nodes.size())
      throw fault(fmt::format("{} supports are given for {} nodes", value.size(), nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k) slide({nodes[k]}, support_of(value[k]));
  }

  void slide(std::vector<Index> nodes, const Support& support) {
    for (Index& node : nodes) {
      agree_on_slide(node, support);
      node = first(node);
      positions_told_.forget(node);
    }
    constraints_.slide_on(nodes, support);
  }

  [[nodiscard]] Support support_of(const json& value) const {
    const bool is_one = value.is_object() && value.size() == 1 && value.begin().value().is_object();
    const std::string kind = is_one ? value.begin().key() : "";
    const json& of = is_one ? value.begin().value() : value;
    const auto place = [&](const char* key) { return vector(member(of, kind, key), key); };
    try {
      if (kind == "plane") {
        require_keys(of, {"point", "normal"});
        return Support::plane(place("point"), place("normal"));
      }
      if (kind == "line") {
        require_keys(of, {"point", "direction"});
        return Support::line(place("point"), place("direction"));
      }
      if (kind == "cylinder") {
        require_keys(of, {"point", "direction", "radius"});
        return Support::cylinder(place("point"), place("direction"), number(member(of, kind, "radius"), "radius"));
      }
      if (kind == "circle") {
        require_keys(of, {"centre", "normal", "radius"});
        return Support::circle(place("centre"), place("normal"), number(member(of, kind, "radius"), "radius"));
      }
      if (kind == "polyline") {
        require_keys(of, {"points", "closed"});
        const json& points = member(of, kind, "points");
        if (!points.is_array()) throw fault("\"points\" of a polyline are a list");
        std::vector<Vector3> places;
        for (const json& point : points) places.push_back(vector(point, "point"));
        const bool closed = of.contains("closed") && of["closed"] == true;
        if (of.contains("closed") && !of["closed"].is_boolean())
          throw fault(fmt::format("\"closed\" is {}; write true or false", in_one_line(of["closed"].dump())));
        return Support::polyline(std::move(places), closed);
      }
    } catch (const Error& error) {
      const std::string what = error.what();
      throw what.starts_with("rule ") ? error : fault(what);
    }
    throw fault(fmt::format(
        "{} is nothing to slide on; write {{\"plane\": {{\"point\": …, \"normal\": …}}}}, a \"line\" or "
        "\"cylinder\" of \"point\", \"direction\" and \"radius\", a \"circle\" of \"centre\", \"normal\" and "
        "\"radius\", or a \"polyline\" of \"points\"",
        in_one_line(value.dump())));
  }

  [[nodiscard]] const json& member(const json& object, const std::string& of, const char* key) const {
    if (!object.contains(key)) throw fault(fmt::format("a {} to slide on has no \"{}\"", of, key));
    return object[key];
  }

  [[nodiscard]] double number(const json& value, const char* what) const {
    if (!value.is_number()) throw fault(fmt::format("{} is no {}; write a number", in_one_line(value.dump()), what));
    return value.get<double>();
  }

  void apply_normals(const std::vector<Index>& nodes, const json& value) {
    if (value == "free") {
      for (const Index i : nodes) {
        constraints_.free_normal(first(i));
        normals_told_.forget(first(i));
      }
    } else if (value == "fixed") {
      std::vector<Index> firsts = nodes;
      for (Index& node : firsts) node = first(node);
      fix_normals(nodes, shape_.normals(firsts), curve() ? no_normal : "no face gives it a normal");
    } else if (value == "file") {
      if (input_.normals == nullptr || input_.normals->empty()) throw fault("the file has no normals for \"file\"");
      std::vector<Vector3> normals;
      normals.reserve(nodes.size());
      for (const Index i : nodes) normals.push_back((*input_.normals)[static_cast<std::size_t>(i)]);
      fix_normals(nodes, normals, "the file gives it no normal");
    } else if (value.is_string()) {
      throw fault(fmt::format("{} is no normal; write \"fixed\", \"file\", \"free\" or {}", in_one_line(value.dump()),
                              numbers()));
    } else {
      fix_normals(nodes, vectors(value, nodes.size(), "normal"), "a normal of zero has no direction");
    }
  }

  /// side: of a corner; none: for both sides.
  void apply_tangents(const std::vector<Index>& nodes, const json& value, std::optional<NodeSide> side = {}) {
    if (value == "free") {
      for (const Index i : nodes) {
        if (side)
          constraints_.free_tangent(i, *side);
        else
          constraints_.free_tangent(i);
      }
      return;
    }
    if (value.is_string() && value != "fixed")
      throw fault(
          fmt::format("{} is no tangent; write \"fixed\", \"free\" or {}", in_one_line(value.dump()), numbers()));
    const auto estimated = [&] { return side ? shape_.side_tangents(nodes, *side) : shape_.tangents(nodes); };
    const Directions tangents = value.is_string() ? estimated() : vectors(value, nodes.size(), "tangent");
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (tangents[k].isZero(0))
        throw fault(
            fmt::format("node {}: {}", nodes[k],
                        value.is_string() ? "no edge gives it a tangent" : "a tangent of zero has no direction"));
      if (side)
        constraints_.fix_tangent(nodes[k], tangents[k], *side);
      else
        constraints_.fix_tangent(nodes[k], tangents[k]);
    }
  }

  void fix_normals(const std::vector<Index>& nodes, const std::vector<Vector3>& normals, const char* without) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (normals[k].isZero(0)) throw fault(fmt::format("node {}: {}", nodes[k], without));
      const Vector3 unit = normals[k].stableNormalized();
      agree(normals_told_, nodes[k], unit, "normal", [](const Vector3& a, const Vector3& b) {
        return std::min((a - b).norm(), (a + b).norm()) <= same_direction;
      });
      constraints_.fix_normal(first(nodes[k]), normals[k]);
    }
  }

  static constexpr double same_direction = 1e-6;  // radians

  static constexpr const char* no_normal = "a straight run has no normal of its own; give its \"tangent\" instead";

  Constraints& constraints_;
  const RuledShape& shape_;
  const std::vector<Vector3>& positions_;
  const RuleInput& input_;
  int rule_ = 0;
  bool named_ = false;  ///< the rule names nodes, groups or a region
  Agreement<Vector3> positions_told_;
  Agreement<std::optional<Support>> slides_told_;  ///< none: the node is held
  Agreement<Vector3> normals_told_;
  /// A step of a path, by the numbers before welding.
  struct Step {
    int rule;
    Index from;
    Index to;
  };
  MeshEdges sharp_edges_;
  MeshEdges paths_;
  std::vector<Step> steps_;
};

MeshEdges apply(Constraints& constraints, const RuledShape& shape, std::string_view text, const RuleInput& input) {
  json rules;
  try {
    rules = json::parse(text);
  } catch (const json::exception& fault) {
    throw Error(ErrorCode::unusable_constraint, fmt::format("rules: no JSON: {}", in_one_line(fault.what())));
  }
  Constraints changed = constraints;
  MeshEdges sharp = RuleReader(changed, shape, input).read(rules);
  constraints = std::move(changed);
  return sharp;
}

}  // namespace

MeshEdges apply_rules(Constraints& constraints, const PolygonMesh& mesh, std::string_view text,
                      const RuleInput& input) {
  const Index named = input.named_nodes.value_or(mesh.node_count());
  const RuledShape shape{
      .positions = mesh.positions(),
      .boundary = [&] { return boundary_nodes(mesh); },
      .non_manifold = [&] { return non_manifold_nodes(mesh); },
      .normals = [&](const std::vector<Index>& nodes) { return estimate_normals(mesh, nodes); },
      .tangents = {},
      .side_tangents = {},
      .edges_between = [&](const std::vector<Index>& nodes) { return edges_between(mesh, nodes, named); },
      .sharp_edges = [&](const MeshEdges& edges,
                         std::vector<LeftOutEdge>& left_out) { return as_sharp_edges(mesh, edges, left_out); }};
  return apply(constraints, shape, text, input);
}

void apply_rules(Constraints& constraints, const PolygonCurve& curve, std::string_view text, const RuleInput& input) {
  const RuledShape shape{.positions = curve.positions(),
                         .boundary = [&] { return boundary_nodes(curve); },
                         .non_manifold = [&] { return non_manifold_nodes(curve); },
                         .normals = [&](const std::vector<Index>& nodes) { return estimate_normals(curve, nodes); },
                         .tangents = [&](const std::vector<Index>& nodes) { return estimate_tangents(curve, nodes); },
                         .side_tangents = [&](const std::vector<Index>& nodes,
                                              NodeSide side) { return estimate_tangents(curve, nodes, side); },
                         .edges_between = {},
                         .sharp_edges = {}};
  apply(constraints, shape, text, input);
}

}  // namespace vspring
