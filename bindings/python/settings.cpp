#include "settings.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <variant>

namespace vspring::python {

namespace {

template <typename Value>
using Choices = std::initializer_list<std::pair<const char*, Value>>;

template <typename Value>
std::optional<Value> choose(const Settings& settings, const char* name, const Choices<Value>& choices) {
  const auto word = settings.get<std::string>(name);
  if (!word) return std::nullopt;
  std::string words;
  for (const auto& [choice, value] : choices) {
    if (*word == choice) return value;
    words += (words.empty() ? "" : ", ") + std::string(choice);
  }
  throw Error(ErrorCode::invalid_argument, std::string(name) + ": not \"" + *word + "\", but one of " + words);
}

template <typename Value>
void take(const std::optional<Value>& given, Value& into) {
  if (given) into = *given;
}

EquilibriumMethod equilibrium_of(const Settings& settings) {
  EquilibriumMethod method;
  take(settings.get<double>("tolerance"), method.tolerance);
  method.max_iterations = settings.get<int>("max_iterations");
  method.fallbacks = !is_papers(settings);
  return method;
}

FairingMethod method_of(const Settings& settings) {
  const bool paper = is_papers(settings);
  const SweepOrder order = paper ? SweepOrder::file : SweepOrder::parallel;
  const auto kind = choose<Method>(
      settings, "method",
      {{"equilibrium", Method::equilibrium}, {"multigrid", Method::multigrid}, {"sweep", Method::sweep}});
  switch (kind.value_or(paper ? Method::sweep : Method::equilibrium)) {
    case Method::multigrid: {
      MultigridMethod method;
      take(settings.get<double>("step_tolerance"), method.step_tolerance);
      take(settings.get<int>("max_iterations"), method.max_iterations);
      method.levels = settings.get<int>("levels");
      take(settings.get<int>("pre_smoothing"), method.pre_smoothing);
      method.order = order;
      method.keep_last = paper;
      return method;
    }
    case Method::sweep: {
      SweepMethod method;
      take(settings.get<double>("step_tolerance"), method.step_tolerance);
      take(settings.get<int>("max_iterations"), method.max_iterations);
      method.order = order;
      method.keep_last = paper;
      return method;
    }
    case Method::equilibrium:
      break;
  }
  return equilibrium_of(settings);
}

/// As on the command line: a distribution other than the default is for comparison, so the shape is returned as found.
void settle_distribution(FairOptions& options, const Settings& settings, const Subject& subject) {
  const bool paper = is_papers(settings);
  const bool papers_own = options.method_kind() != Method::equilibrium;
  const Distribution usual = paper                            ? Distribution::even
                             : subject.own_nodes_pull         ? Distribution::keep
                             : subject.is_curve || papers_own ? Distribution::even
                                                              : Distribution::smooth;
  const Distribution chosen =
      choose<Distribution>(
          settings, "distribution",
          {{"smooth", Distribution::smooth}, {"even", Distribution::even}, {"keep", Distribution::keep}})
          .value_or(usual);
  options.accept_worse = paper || chosen != usual || papers_own;
  if (paper || chosen != usual || subject.own_nodes_pull) options.distribution = chosen;
}

/// The last steps of a fit are about k times their distance.
void shorten_steps(FitOptions& options) {
  const double k = options.weight().value_or(0);
  if (!(k > 0)) return;
  const auto shorten = [&](auto& method) {
    if constexpr (requires { method.step_tolerance; }) method.step_tolerance = std::min(method.step_tolerance, k / 10);
  };
  std::visit(shorten, options.fair.method);
}

void take_papers_choices(FairOptions& options, const Settings& settings) {
  for (const char* name : {"springs", "pseudo_normals", "normal_plane"}) {
    if (settings.get<std::string>(name))
      throw Error(ErrorCode::invalid_argument, std::string(name) + ": paper says which; leave one of the two out");
  }
  options.pseudo_normals = PseudoNormals::average;
  options.springs = Springs::edge;
  options.forces = Forces::printed;
  options.curve = CurveRules::paper();
}

}  // namespace

bool is_papers(const Settings& settings) { return settings.get<bool>("paper").value_or(false); }

std::optional<Resampling> resampling_of(const Settings& settings) {
  Resampling resampling;
  resampling.nodes = settings.get<Index>("resample");
  resampling.spacing = settings.get<double>("spacing");
  take(
      choose<ResamplingBy>(
          settings, "resample_by",
          {{"length", ResamplingBy::length}, {"cosine", ResamplingBy::cosine}, {"curvature", ResamplingBy::curvature}}),
      resampling.by);
  if (!resampling.nodes && !resampling.spacing) return std::nullopt;
  return resampling;
}

FairOptions fair_options(const Settings& settings, const Subject& subject) {
  FairOptions options;
  options.method = method_of(settings);
  take(choose<Springs>(settings, "springs", {{"sphere", Springs::sphere}, {"edge", Springs::edge}}), options.springs);
  take(choose<FairBy>(settings, "fair_by", {{"curvature", FairBy::curvature}, {"bending", FairBy::bending}}),
       options.fair_by);
  take(choose<Continuity>(settings, "continuity",
                          {{"tangent", Continuity::tangent}, {"curvature", Continuity::curvature}}),
       options.continuity);
  take(choose<PseudoNormals>(settings, "pseudo_normals",
                             {{"link", PseudoNormals::link},
                              {"average", PseudoNormals::average},
                              {"area", PseudoNormals::area},
                              {"angle", PseudoNormals::angle}}),
       options.pseudo_normals);
  take(choose<NormalPlane>(settings, "normal_plane",
                           {{"full", NormalPlane::full}, {"principal", NormalPlane::principal}}),
       options.curve.normal_plane);
  take(settings.get<double>("strength"), options.strength);
  if (const auto edges = settings.get<Array<Index>>("sharp_edges")) options.sharp_edges = edges_of(*edges);
  options.sharp_curves =
      choose<SharpCurves>(settings, "sharp_curves", {{"fit", SharpCurves::fit}, {"hold", SharpCurves::hold}});
  take(settings.get<bool>("fix_sharp_normals"), options.fix_sharp_normals);
  const bool paper = is_papers(settings);
  if (settings.get<bool>("fair_boundary").value_or(false))
    options.fair_boundary = paper ? options.method : FairingMethod(equilibrium_of(settings));
  if (paper) take_papers_choices(options, settings);
  settle_distribution(options, settings, subject);
  return options;
}

FitOptions fit_options(const Settings& settings, const Subject& subject) {
  FitOptions options;
  options.fair = fair_options(settings, subject);
  int given = 0;
  const auto consider = [&](const char* name, const auto& criterion_of) {
    if (const auto value = settings.get<double>(name)) {
      options.criterion = criterion_of(*value);
      ++given;
    }
  };
  consider("weight", [](double value) { return Weight{value}; });
  consider("smoothing_length", [](double value) { return SmoothingLength{value}; });
  consider("within", [](double value) { return Within{value}; });
  consider("rms", [](double value) { return RootMeanSquare{value}; });
  consider("noise", [](double value) { return Noise{value}; });
  if (const auto size = settings.get<std::array<double, 3>>("voxels")) {
    options.criterion = Voxels{Vector3((*size)[0], (*size)[1], (*size)[2])};
    ++given;
  }
  if (given != 1)
    throw Error(ErrorCode::invalid_argument, std::string(given == 0 ? "one" : "only one") +
                                                 " of weight, smoothing_length, within, rms and noise has to be given");
  if (!subject.own_nodes_pull && !settings.get<double>("step_tolerance")) shorten_steps(options);
  take(settings.get<double>("outliers"), options.outliers);
  take(settings.get<double>("min_radius"), options.least_radius);
  take(settings.get<double>("sharp"), options.sharp);
  take(settings.get<double>("boundary_reach"), options.boundary_reach);
  return options;
}

int threads_of(const Settings& settings) { return settings.get<int>("threads").value_or(0); }

}  // namespace vspring::python
