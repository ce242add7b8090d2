#include "vspring/figures.hpp"

#include <variant>

namespace vspring {

namespace {

template <typename Figures>
struct Description {
  std::string_view key;
  std::string_view name;
  std::string_view unit;
  std::string_view definition;
  std::variant<double Figures::*, Index Figures::*, std::optional<double> Figures::*> value;
};

template <typename Figures, std::size_t count>
std::vector<Figure> list(const Figures& figures, const Description<Figures> (&descriptions)[count]) {
  std::vector<Figure> listed;
  listed.reserve(count);
  for (const auto& description : descriptions) {
    Figure figure{description.key, description.name, description.unit, description.definition, 0, false};
    if (const auto* real = std::get_if<double Figures::*>(&description.value)) {
      figure.value = figures.**real;
    } else if (const auto* whole = std::get_if<Index Figures::*>(&description.value)) {
      figure.value = figures.**whole;
      figure.whole = true;
    } else {
      const auto& measured = figures.*std::get<std::optional<double> Figures::*>(description.value);
      if (!measured) continue;
      figure.value = *measured;
    }
    figure.value += 0.0;  // −0 would be printed with its sign
    listed.push_back(figure);
  }
  return listed;
}

using S = SurfaceFigures;
using C = CurveFigures;

template <typename Figures>
constexpr double Figures::*of(double Fairness::*member) {
  return member;
}

constexpr Description<S> of_surfaces[] = {
    {"area", "area", "units²", "of the faces", &S::area},
    {"diagonal", "diagonal", "units", "D, of the box around the faces", &S::diagonal},
    {"vspring_energy", "V-Spring energy", "", "Σ over edges ((t_j − t_i)/ℓ)²", of<S>(&Fairness::vspring_energy)},
    {"bending_energy", "bending energy", "", "∫ κ1² + κ2² dA", &S::bending_energy},
    {"mean_curvature_variation", "variation of mean curvature", "", "A ∫ |∇H|² dA", &S::mean_curvature_variation},
    {"curvature_variation", "variation of curvature", "", "MVS: A ∫ (∂κ1/∂e1)² + (∂κ2/∂e2)² dA",
     &S::curvature_variation},
    {"curvature_variation_cross", "with cross terms", "", "MVS with (∂κ1/∂e2)² + (∂κ2/∂e1)² in addition",
     &S::curvature_variation_cross},
    {"greatest_curvature", "greatest curvature", "", "largest κ1 D", &S::greatest_curvature},
    {"least_curvature", "least curvature", "", "smallest κ2 D", &S::least_curvature},
    {"greatest_mean_curvature", "greatest mean curvature", "", "largest H D", &S::greatest_mean_curvature},
    {"least_mean_curvature", "least mean curvature", "", "smallest H D", &S::least_mean_curvature},
    {"greatest_gaussian_curvature", "greatest Gaussian curvature", "", "largest K D²", &S::greatest_gaussian_curvature},
    {"least_gaussian_curvature", "least Gaussian curvature", "", "smallest K D²", &S::least_gaussian_curvature},
    {"mean_curvature_extrema", "extremes of mean curvature", "", "inside; that stand out by 5 % of rms curvature",
     &S::mean_curvature_extrema},
    {"greatest_turn", "greatest turn", "°", "of the normal across an edge", of<S>(&Fairness::greatest_turn)},
    {"rms_turn", "rms turn", "°", "of the normal across an edge", of<S>(&Fairness::rms_turn)},
    {"flipped_faces", "flipped faces", "", "that point against the faces around them", &S::flipped_faces},
    {"self_intersections", "self-intersections", "", "pairs of faces that cross, counted up to 1,000,000",
     &S::self_intersections},
    {"edge_spread", "spread of edges", "", "longest over shortest", &S::edge_spread},
    {"neighbouring_edge_spread", "spread at a node", "", "longest over shortest edge at one node",
     &S::neighbouring_edge_spread},
    {"smallest_angle", "smallest angle", "°", "of corners of faces", &S::smallest_angle},
    {"greatest_angle", "greatest angle", "°", "of corners of faces", &S::greatest_angle},
    {"normal_error", "normal error", "°", "greatest angle to a given normal", &S::normal_error},
    {"zero_length_edges", "edges without length", "", "left out of spreads and angles", &S::zero_length_edges},
    {"zero_area_faces", "faces without area", "", "left out of turns", &S::zero_area_faces},
    {"nodes_without_curvature", "nodes without curvature", "", "too little around them; count as flat",
     &S::nodes_without_curvature},
    {"nodes_without_variation", "nodes without its variation", "", "too little around them; count as uniform",
     &S::nodes_without_variation},
};

constexpr Description<C> of_curves[] = {
    {"length", "length", "units", "L, of the edges", &C::length},
    {"diagonal", "diagonal", "units", "of the box around the curve", &C::diagonal},
    {"vspring_energy", "V-Spring energy", "", "Σ over edges ((t_j − t_i)/ℓ)²", of<C>(&Fairness::vspring_energy)},
    {"bending_energy", "bending energy", "", "L ∫ κ² ds", &C::bending_energy},
    {"curvature_variation", "variation of curvature", "", "L³ ∫ (dκ/ds)² ds", &C::curvature_variation},
    {"greatest_curvature", "greatest curvature", "", "largest |κ| L", &C::greatest_curvature},
    {"curvature_extrema", "extremes of curvature", "", "between the ends; that stand out by 5 % of rms curvature",
     &C::curvature_extrema},
    {"inflections", "inflections", "", "from 5 % of rms curvature on one side to the other", &C::inflections},
    {"greatest_turn", "greatest turn", "°", "between successive edges", of<C>(&Fairness::greatest_turn)},
    {"rms_turn", "rms turn", "°", "between successive edges", of<C>(&Fairness::rms_turn)},
    {"edge_spread", "spread of edges", "", "longest over shortest", &C::edge_spread},
    {"neighbouring_edge_spread", "spread at a node", "", "longer over shorter of successive edges",
     &C::neighbouring_edge_spread},
    {"normal_error", "normal error", "°", "greatest angle to a given tangent or normal", &C::normal_error},
    {"zero_length_edges", "edges without length", "", "left out", &C::zero_length_edges},
};

}  // namespace

std::vector<Figure> list_figures(const SurfaceFigures& figures) { return list(figures, of_surfaces); }
std::vector<Figure> list_figures(const CurveFigures& figures) { return list(figures, of_curves); }

}  // namespace vspring
