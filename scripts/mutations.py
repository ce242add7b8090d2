"""The mutations of scripts/mutate: for each source (name, formula, text, replacement, type).

The text must be found exactly once in its source. One that ends with a semicolon is replaced as a statement, others as expressions; a type
is needed where the two have different ones, as Eigen's expressions do.

A change that leaves the result and only slows the way to it is no mutation of a result: of preconditioners, acceleration, levels and
transfers between them only what a closed form promises is here.
"""

MUTATIONS = {
    "src/spring/v_spring.hpp": [
        ("spring-sum", "Eq. 4: N_i + N_j", "(d.dot(normal_i) + sense * d.dot(normal_j)) / (1 + std::abs(cosine))",
         "(d.dot(normal_i) - sense * d.dot(normal_j)) / (1 + std::abs(cosine))"),
        ("spring-denominator", "Eq. 4: 1 + N_i·N_j", "(d.dot(normal_i) + sense * d.dot(normal_j)) / (1 + std::abs(cosine))",
         "(d.dot(normal_i) + sense * d.dot(normal_j)) / 2"),
        ("spring-facing", "§3: −N_j where N_i·N_j < 0", "std::clamp(steepness * cosine, -1.0, 1.0)", "1.0"),
        ("measured-spring-sum", "Eq. 4 in figures: N_i + N_j", "(d.dot(normal_i) + (cosine < 0 ? -along_j : along_j)) / (1 + std::abs(cosine))",
         "(d.dot(normal_i) - (cosine < 0 ? -along_j : along_j)) / (1 + std::abs(cosine))"),
        ("measured-spring-denominator", "Eq. 4 in figures: 1 + N_i·N_j",
         "(d.dot(normal_i) + (cosine < 0 ? -along_j : along_j)) / (1 + std::abs(cosine))", "(d.dot(normal_i) + (cosine < 0 ? -along_j : along_j)) / 2"),
        ("measured-spring-facing", "Eq. 4 in figures: −N_j where N_i·N_j < 0",
         "(d.dot(normal_i) + (cosine < 0 ? -along_j : along_j)) / (1 + std::abs(cosine))", "(d.dot(normal_i) + along_j) / (1 + std::abs(cosine))"),
        ("edge-weight-even", "Eq. 8: w_j = 1/‖P_i − P_j‖", "1 / length", "1.0"),
        ("edge-weight-square", "Eq. 8: w_j = 1/‖P_i − P_j‖", "1 / length", "1 / (length * length)"),
        ("edge-weight-sum", "Eq. 8: over Σ w_j", "differences / weights", "differences / spokes"),
        ("regularisation-mean", "§4.4: (Σ P_j)/m − P_i", "mean /= spokes;", ""),
        ("regularisation-tangential", "§4.4: u − (u·N_i) N_i", "mean - mean.dot(normal) * normal", "mean", "Vector3"),
        ("regularisation-shares", "§4.4 with shares", "Vector3(shares[k] * d)", "Vector3(d / static_cast<double>(links.size()))"),
        ("mean-edge", "§4.6: mean length of edges", "lengths / spokes", "lengths"),
    ],
    "src/spring/pseudo_normal.hpp": [
        ("link-inversion", "Max's weights: e/|e|²", "1 / length2", "1 / std::sqrt(length2)"),
        ("link-closing", "Max's weights: the last face of a closed link", "if (!links.front().start()) sum += previous.cross(first);", ""),
        ("average-unit", "§4.2: average of unit normals", "length > 0 ? 1 / length : 0", "length > 0 ? 1.0 : 0.0"),
        ("angle-weight", "normals weighted by angles", "return angle * AverageWeight::of(area, first_edge, last_edge);",
         "return AverageWeight::of(area, first_edge, last_edge);"),
        ("angle-of-face", "the angle is that of one face", "first_edge = edge;", ""),
        ("face-closing", "the last face of a closed link", "if (!links.front().start()) step(links.front().node(), closing_edge, true);", ""),
    ],
    "src/join/curvature_arc.cpp": [
        ("arc-commutator", "Magnus' series: the commutator", "step * off / 2", "-step * off / 2"),
    ],
    "src/join/curve_side.cpp": [
        ("side-place", "an arc is told where it passes the node", "(places[0] - arc.start.place).dot(arc.start.tangent()) * arc.start.tangent()",
         "Vector3::Zero()", "Vector3"),
        ("side-terms", "arcs whose curvature is not constant, too", "terms <= most_terms_of_arc", "terms <= fewest_terms_of_arc"),
    ],
    "src/join/curvature_spline.cpp": [
        ("end-quadratic", "quadratic where one end has a curvature", "other_has_curvature ? 3 : 2", "other_has_curvature ? 2 : 2"),
        ("end-curvature", "in the unit of the equations", "*joint.curvature * unit_at(end)", "*joint.curvature", "Vector3"),
        ("joint-second", "the second derivative is continuous", "add_same(end, end.curvature[2], start, start.curvature[2], axis.along);",
         "add_same(end, end.curvature[3], start, start.curvature[3], axis.along);"),
    ],
    "src/constraints/support.cpp": [
        ("circle-plane", "the nearest place on a circle is in its plane", "if (kind_ == Kind::circle) there->ahead = 0;", ""),
        ("helix-angle", "a helix turns as it goes ahead", "const double angle = turn_ * along / radius_;",
         "const double angle = -turn_ * along / radius_;"),
    ],
    "src/fairness/hubs.cpp": [
        ("hub-arc-rise", "an arc with a chord c rises above it by up to c²/4", "(to_b - to_a).squaredNorm() / 4 + margin_on_sphere", "margin_on_sphere"),
    ],
    "src/spring/surface_force.hpp": [
        ("rim-springs", "sphere springs where nodes slide at a boundary", "(!on_boundary(links) || net.slides(i))", "!on_boundary(links)"),
        ("targets", "places of their own count as much as all neighbours", "target - target.dot(net.normals[i]) * net.normals[i]", "target", "Vector3"),
        ("targets-forgotten", "regularisation to places of their own", "(force.regularisation + across) / regularisation_divisor(net)",
         "force.regularisation", "Vector3"),
    ],
    "src/spring/sphere_springs.cpp": [
        ("curvature-form", "curvature: Σ K (height − q)", "2 * fit.q2 * x * y", "-2 * fit.q2 * x * y"),
        ("curvature-of-rim", "curvature at a rim", "0.25", "0.5"),
        ("curvature-of-given", "heights over neighbours' planes", "(1 + of_neighbours) * own + of_neighbours * theirs", "own"),
        ("sphere-facing", "curvature of a neighbour that faces the other way",
         "(net.normals[i].dot(net.normals[j]) < 0 ? -theirs : theirs) - own", "theirs - own"),
        ("sphere-force-sign", "force: κ ρ⁴/(4 M) Σ K (c_i − c_j)", "-4 * spheres.factor * sum / weight", "4 * spheres.factor * sum / weight"),
        ("sphere-force-size", "force: κ ρ⁴/(4 M) Σ K (c_i − c_j)", "-4 * spheres.factor * sum / weight", "-8 * spheres.factor * sum / weight"),
        ("bending-term", "least bending: ΔH + 2H(H² − K) = 0", "2 * spheres.areas[i] * own * spheres.differences[i]",
         "spheres.areas[i] * own * spheres.differences[i]"),
        ("bending-difference", "H² − K = 4|q|²", "4 * (fit.q1 * fit.q1 + fit.q2 * fit.q2)", "4 * (fit.q1 * fit.q1 - fit.q2 * fit.q2)"),
        ("slopes", "normals from heights over the link", "normal + fit.slope1 * t1 + fit.slope2 * t2", "normal", "Vector3"),
    ],
    "src/spring/laplacian_row.cpp": [
        ("cotangents", "cotangent Laplacian: the angle opposite", "row[first] += half.at_b;", "row[first] += half.at_a;"),
        ("polygon-row", "Laplacian of an n-gon", "share * (own - share * sum)", "share * own"),
        ("sphere-area", "a node's third of its triangles", "half.area / 6", "half.area / 2"),
    ],
    "src/spring/tangent.hpp": [
        ("circle-tangent", "tangent of the circle: e/ℓ²", "sum += *edge / length2;", "sum += *edge / std::sqrt(length2);"),
        ("chord-tangent", "§4.8: T ∝ P_{i+1} − P_{i−1}",
         "return direction(edges.before + edges.after, edges.before.norm() + edges.after.norm());",
         "return direction(edges.before.normalized() + edges.after.normalized(), 2);"),
        ("circle-curvature", "curvature of the circle: 2 sin/chord", "(2 / product)", "(1 / product)"),
        ("principal-normal", "§4.8: N ∝ B × T", "edges.before.cross(edges.after).cross(tangent)", "edges.before.cross(edges.after)", "Vector3"),
        ("end-tangent", "the chord of an end", "links.front().start() ? Vector3(-first) : first", "first", "Vector3"),
    ],
    "src/equilibrium/relaxation.cpp": [
        ("flow-energy", "energy: ((t_j − t_i)/ℓ)²", "difference * difference / (d.squaredNorm() + net.tiny)", "difference * difference"),
    ],
    "src/checks/bending_energy.cpp": [
        ("bending-product", "κ₁² + κ₂² = (κ₁ + κ₂)² − 2 κ₁ κ₂", "(fit[2] * fit[4] - fit[3] * fit[3])", "(fit[2] * fit[4])"),
        ("bending-second-derivative", "twice the form", "2 * plane->share / (plane->unit * plane->unit)", "plane->share / (plane->unit * plane->unit)"),
    ],
    "src/checks/result_check.cpp": [
        ("bent-to-given", "what leaves a given direction is bent: κ = 2 θ/ℓ", "return 4 * angle * angle / (length * length);", "return 0 * angle * length;"),
        ("bent-more", "more bending is worse", "if (defects.bending > risen_bending * defects_.bending + unseen)", "if (false)"),
    ],
    "src/spring/curve_force.hpp": [
        ("curve-held-springs", "springs between held neighbours count", "(i < net.moving || j < net.computed)", "i < net.moving"),
        ("carrying", "frames without spin: the second reflection", "mirrored -= (2 * mirror.dot(mirrored) / length2) * mirror;", ""),
        ("curve-spring-difference", "Eq. 4 of curves: (b_i − Rᵀ b_j)/(1 + T_i·T_j)",
         "return (bend_i - carried(bend_j, d, tangent_j, tangent_i)) / denominator;",
         "return (bend_i + carried(bend_j, d, tangent_j, tangent_i)) / denominator;"),
        ("curve-spring-denominator", "Eq. 4 of curves: 1 + T_i·T_j",
         "return (bend_i - carried(bend_j, d, tangent_j, tangent_i)) / denominator;",
         "return (bend_i - carried(bend_j, d, tangent_j, tangent_i)) / 2;"),
        ("curve-bend", "b = (ℓ²/2) k", "(0.5 * d.dot(d)) * net.curvatures[i]", "d.dot(d) * net.curvatures[i]", "Vector3"),
        ("curve-weight", "w = 1/ℓ³", "return 1 / (length * length * length);", "return 1 / length;"),
        ("curve-weight-square", "w = 1/ℓ³", "return 1 / (length * length * length);", "return 1 / (length * length);"),
        ("paper-curve-weight", "Eq. 8 of curves: w = 1/ℓ", "return 1 / length;", "return 1;"),
        ("curve-shares", "each length as its opposite share", "along += links[k].start() ? -shares[k] * length : shares[k] * length;",
         "along += links[k].start() ? -length : length;"),
        ("curve-regularisation", "§4.4 along the tangent", "along = mean.dot(tangent);", "along = 0;"),
        ("curve-targets", "regularisation to places of their own", "(net.target_positions[i] - net.positions[i]).dot(tangent)", "mean.dot(tangent)"),
    ],
    "src/spring/curve_model.cpp": [
        ("tangent-of-given-normal", "§4.8: T across a given N", "tangent - tangent.dot(normal) * normal", "tangent", "Vector3"),
        ("principal-beside-straight", "§4.8: a neighbour without N", "normal.dot(curve_spring(net, i, j))", "0.0"),
        ("printed-regularisation", "§4.4 of curves: u − (u·N_i) N_i", "way - way.dot(normal) * normal", "way", "Vector3"),
        ("mean-of-segments", "§4.2 of plane curves: the mean of unit normals", "direction(plane_.cross(*edge), edge->norm())", "plane_.cross(*edge)",
         "Vector3"),
        ("curve-point-force", "Eq. 9 of curves: across the tangent", "tangent.squaredNorm() * d - d.dot(tangent) * tangent", "d", "Vector3"),
    ],
    "src/spring/whole_faces.cpp": [
        ("whole-face", "§4.2: the normal of an n-gon is that of all of it", "area += previous.cross(next);", "area = previous.cross(next);"),
        ("whole-face-of-two", "of two faces between the same neighbours one is the n-gon", "!in_sense && wedge->next == last", "wedge->next == last"),
    ],
    "src/spring/surface_model.cpp": [
        ("point-force", "Eq. 9: ((V_j − P_i)·N_i) N_i", "d.dot(net.normals[i]) * net.normals[i]", "d", "Vector3"),
    ],
    "src/spring/point_force.hpp": [
        ("foot-weight", "Eq. 9: w_j = 1/‖P_i − Q_j‖", "1 / std::max((d - along).norm(), nearest_foot)", "1.0"),
        ("foot-distance", "Eq. 9: Q_j, not V_j", "1 / std::max((d - along).norm(), nearest_foot)", "1 / std::max(d.norm(), nearest_foot)"),
        ("foot-bound", "§4.5: w_j bounded", "1 / std::max((d - along).norm(), nearest_foot)", "1 / (d - along).norm()"),
        ("point-weight", "Eq. 9: k_j", "weight * net.points.weights[j]", "weight"),
        ("point-mean", "§4.5: over Σ w_j", "net.points.factor(i) / weights", "net.points.factor(i)"),
    ],
    "src/spring/model_of.hpp": [
        ("step-with-points", "any weight is stable in a sweep", "forces_ == Forces::printed ? 1 : 1 + force.stiffness", "1"),
        ("relative-step", "§4.6: displacement over the mean edge", "displacement.norm() / force.mean_edge", "displacement.norm()"),
        ("step-not-finite", "§4.6: what is no number is no end", "std::isfinite(step) ? step : std::numeric_limits<double>::infinity()", "step"),
    ],
    "src/spring/shares.cpp": [
        ("even-shares", "share_j = 1/m − (d_j − mean)·a", "1 / spokes - (across(links[k]) - mean).dot(a)", "1 / spokes + (across(links[k]) - mean).dot(a)"),
        ("length-shares", "each edge as the other is long", "1 - shares[k] / whole", "shares[k] / whole"),
        ("mean-value-shares", "mean value coordinates: over ‖d_j‖", "shares[k] /= ways[k].norm()", "shares[k]"),
        ("wide-cells", "neighbours along the long side of a cell count less", "std::sqrt(by * std::max(shares[k], least_mean_value * by))",
         "std::max(shares[k], least_mean_value * by)"),
    ],
    "src/equilibrium/surface_hierarchy.cpp": [
        ("coarse-springs", "coarser levels have nearly the shape of the finest", "take_springs_of(finest(), fine.net)", "void()"),
    ],
    "src/levels/surface_slide.cpp": [
        ("slide-in-faces", "triangles between all nodes of faces cover these", "if (links[k].start()) continue;", "if (links[k].start() || !links[k].spoke()) continue;"),
    ],
    "src/spring/spacing.cpp": [
        ("sweep-stretch", "weights by inverse squares", "std::exp(-square)", "std::exp(square)"),
        ("bricks", "half way to the mean of three", "way / 6", "way / 3", "Vector3"),
    ],
    "src/shape/fan.cpp": [
        ("fan-of-polygon", "the walk through a face", "along(face, corner.place, k * step)", "along(face, corner.place, -k * step)"),
        ("fan-flipped", "faces of one sense", "a % 2 == b % 2", "a % 2 != b % 2"),
        ("fan-closed", "the last link is the first", "fan_.links.pop_back();", ""),
    ],
    "src/shape/arcs.hpp": [
        ("three-point-curvature", "curvature by inversion", "2 * (p - along * (p.dot(along) / along.squaredNorm()))",
         "p - along * (p.dot(along) / along.squaredNorm())", "Vector3"),
        ("cubic-speed", "the cubic nearest to a circle", "2 * chord.norm() / (1 + std::sqrt((1 + cosine) / 2))", "chord.norm()"),
    ],
    "src/solve/attempt.cpp": [
        ("bent-least", "of shapes that are no equilibrium the one that is bent least", "!(best->bent < attempt.bent)", "best->bent < attempt.bent"),
    ],
    "src/sweep/sweep.cpp": [
        ("normals-once", "Fig. 3: normals anew in every iteration", "update_directions(*net_, *model_, *team_);", ""),
        ("file-order", "Fig. 3: i = 1 … n", "net.node[a.begin] < net.node[b.begin]", "a.begin < b.begin"),
        ("blocks-apart", "no two blocks of a group joined by an edge", "if (other < b) taken_by[group_of[other]] = b;", ""),
    ],
    "src/equilibrium/sweep_method.cpp": [
        ("last-iterate", "Fig. 3 ends with its last iteration", "!(task.keep_last && is_finite)", "true"),
        ("stop", "§4.6: below e", "result.residual < task.step_tolerance", "result.residual < 10 * task.step_tolerance"),
    ],
    "src/equilibrium/equilibrium.cpp": [
        ("expected-error", "expected error from the last corrections", "std::max({step * (1 + left), least_share * slower, rounding})",
         "0.01 * std::max({step * (1 + left), least_share * slower, rounding})"),
    ],
    "src/equilibrium/newton.cpp": [
        ("central-difference", "derivative of the forces", "(ahead[k] - displacement(forces_[j][k])) / (2 * step)",
         "(ahead[k] - displacement(forces_[j][k])) / step", "Vector3"),
    ],
    "src/levels/surface_slide.hpp": [
        ("lift", "transfer exact on spheres", "place.position += lift * place.normal;", ""),
    ],
    "src/constraints/normal_estimate.cpp": [
        ("estimate-slope", "normal from a quadratic", "(normal - (*solution)[0] * x - (*solution)[1] * y)",
         "(normal - (*solution)[0] * x + (*solution)[1] * y)", "Vector3"),
        ("estimate-sphere", "e·N = c|e|² on spheres", "terms.row(k) << u / length2, v / length2, 1, (u * u - v * v) / length2, 2 * u * v / length2;",
         "terms.row(k) << u / length2, v / length2, 0, (u * u - v * v) / length2, 2 * u * v / length2;"),
        ("estimate-form", "the quadratic form without trace", "terms.row(k) << u / length2, v / length2, 1, (u * u - v * v) / length2, 2 * u * v / length2;",
         "terms.row(k) << u / length2, v / length2, 1, 0, 0;"),
    ],
    "src/constraints/curve_directions.cpp": [
        ("estimate-tangent", "tangent of the circle", "inverted(forward[0]) - inverted(backward[0])", "forward[0] - backward[0]", "Vector3"),
        ("estimate-end-tangent", "tangent of the circle at an end", "Vector3(inverted(side[0]) - inverted(side[1]))", "Vector3(side[0])"),
        ("estimate-last-tangent", "the sense of a last tangent", "forward.empty() ? -one_sided(backward) : one_sided(forward)",
         "one_sided(forward.empty() ? backward : forward)", "Vector3"),
    ],
    "src/points/face_ties.cpp": [
        ("face-height", "distance from the nearest triangle", ".height = way.dot(up)}", ".height = 1.01 * way.dot(up)}"),
        ("face-rise", "∂height/∂node: its share times u·N", "shares[k] * up.dot(net_->normals[nodes[k]])", "shares[k]"),
    ],
    "src/points/point_ties.cpp": [
        ("nearest-node", "§4.5: tied to the nearest node", "if (!(square < least) || !may_pull(k, j, margin)) continue;",
         "if (!(square > least) || !may_pull(k, j, margin)) continue;"),
        ("second-order", "§4.5: neighbours of second order", "around.insert(around.end(), next.begin(), next.end());", ""),
    ],
    "src/points/point_sheet.cpp": [
        ("border-gap", "points end where there are none in 150°", "gap > widest_gap", "gap > 1.25 * widest_gap"),
    ],
    "src/fit/boundary_trace.cpp": [
        ("boundary-side", "points end on the side where the surface does", "about->out.dot(out[k]) < least_cosine_outwards", "false"),
    ],
    "src/fit/closed_way.cpp": [
        ("boundary-corner", "a corner turns more than what is beside it", "excess[k] > least_turn", "false"),
    ],
    "src/points/point_factors.cpp": [
        ("pull-by-edges", "weight of a length: λ⁴ against ρ⁴", "std::pow(mean_edge(net) / *length, 4) / 16", "std::pow(mean_edge(net) / *length, 2) / 16"),
        ("pull-by-smoothing", "weight of a length on surfaces", "scale * count * kappa * square * square", "scale * count * kappa * square"),
        ("pull-on-curves", "weight of a length on curves", "4 * mean_power(net, i, -3)", "8 * mean_power(net, i, -3)"),
        ("area-per-point", "a node's share of n-gons", "area += face.norm() / nodes;", "area += face.norm();"),
    ],
    "src/noise/noise.cpp": [
        ("noise-slopes", "noise across the surface", "std::sqrt(squares / static_cast<double>(nodes.size()))", "1.0"),
    ],
    "src/noise/noise_of_curve.cpp": [
        ("noise-quartic", "noise by coordinate is over a quartic", "{.axes = 1, .degree = 4, .directions = directions}", "{.axes = 1, .degree = 2, .directions = directions}"),
        ("noise-seen", "noise of one coordinate, seen beside others", "stretch.across.row(axis).cwiseAbs2().dot(variances) / variances[axis]", "1.0"),
        ("noise-repeats", "rows that come twice count once", "if (auto fewer = without_repeats(curve, found.steps, directions)) found = std::move(*fewer);", ""),
    ],
    "src/noise/noisy_places.cpp": [
        ("noise-freedom", "noise: squares over degrees of freedom", "size * std::sqrt(squares / heights.freedom)", "size * std::sqrt(squares)"),
        ("noise-expected", "noise: chi-square at a share", "1 - spread + quantile * std::sqrt(spread)", "1 - spread"),
        ("noise-quadratic", "noise over a quadratic", "matrix.row(k) << 1, u, v, u * u, u * v, v * v;", "matrix.row(k) << 1, u, v, u * u, 0, v * v;"),
        ("noise-extent", "noise is seen along a direction that places have", "place.extent >= narrowest * result.deviation", "true"),
    ],
    "src/noise/low_pass.cpp": [
        ("low-pass-response", "low pass: 1/(1 + (e/half)^order)", "(1 - std::cos(angle)) / band.half", "(1 + std::cos(angle)) / band.half"),
        ("low-pass-coefficients", "Chebyshev's expansion: half of the first", "(n == 0 ? 1 : 2) * sum", "2 * sum"),
        ("low-pass-constant", "low pass: 1 at the eigenvalue 0", "one /= constant", "one /= 1"),
    ],
    "src/noise/low_pass.hpp": [
        ("chebyshev", "Chebyshev's recurrence: 2 x T_n − T_{n−1}", "Value(sum - before[i])", "sum", "Value"),
    ],
    "src/noise/risk.cpp": [
        ("risk-noise", "Stein: twice the noise that is followed", "2 * deviation * deviation * followed[place]", "deviation * deviation * followed[place]"),
        ("choice-weight", "shapes count by exp(−weight · risk)", "std::exp(scale * (least - risk[k]))", "std::exp(scale * (risk[k] - least))"),
        ("choice-unit", "risks in squares of the noise", "choice.weight / (deviation * deviation)", "choice.weight / deviation"),
        ("choice-window", "half-way to the neighbours' mean", "0.5 * own[k] + share * result[k]", "own[k]"),
    ],
    "src/noise/flat_faces.cpp": [
        ("normals-alike", "normals count by their likeness", "std::exp((normals[f] - other).squaredNorm() / (-2 * alike * alike))", "1.0"),
        ("nodes-to-normals", "nodes move along normals of faces", "normals[f].dot(centres[f] - places[i]) * normals[f]", "centres[f] - places[i]", "Vector3"),
    ],
    "src/noise/scan_mesh.cpp": [
        ("area-of-face", "half the cross products", "twice_vector_area(mesh.faces.of(f), places) / 2",
         "twice_vector_area(mesh.faces.of(f), places)", "Vector3"),
    ],
    "src/noise/denoise.cpp": [
        ("followed-by-bands", "the noise that low passes follow", "(signs[i] * filtered[band][i]).mean() / fields_of_bands", "0.0"),
        ("followed-by-choices", "the noise that choices follow",
         "signs[i] * (others[k][i] - shapes[k][i]).dot(normals_[i]) / (length * fields_of_choices)", "0.0"),
    ],
    "src/fairness/measure.cpp": [
        ("energy-by-length", "energy: ((t_j − t_i)/ℓ)²", "d / length", "d", "Vector3"),
        ("turn-of-flipped", "turn between faces of two senses", "neighbours_[k].same_sense ? -a.dot(b) : a.dot(b)", "a.dot(b)"),
        ("turn-mean", "root mean square turn", "std::sqrt(turns.squares / turns.count)", "std::sqrt(turns.squares)"),
    ],
    "src/fairness/height_field.cpp": [
        ("one-way", "triangles that all face one way", "u.cross(v).dot(direction_) > view_margin * (u.squaredNorm() + v.squaredNorm())", "true"),
        ("simple-outline", "a boundary that does not cross itself", "if (!are_apart(k, static_cast<std::size_t>(other))) simple = false;", ""),
        ("one-sheet", "no place is wound around twice", "counter_clockwise == 1", "counter_clockwise > 0"),
        ("edges-cancel", "edges along which triangles run both ways are no boundary", "own[k] % 2 == 0 ? 1 : -1", "1"),
    ],
    "src/fairness/curvatures.cpp": [
        ("form-frame", "two tangents at right angles", "-p * q / (e * w)", "p * q / (e * w)"),
        ("codazzi", "covariant derivative of the form", "(third - bent / w2)", "third"),
        ("principal-angle", "principal directions", "std::atan2(-2 * form(0, 1), form(1, 1) - form(0, 0)) / 2", "std::atan2(2 * form(0, 1), form(1, 1) - form(0, 0)) / 2"),
        ("derivative-index", "derivative of κ₁ along e₂", "derivative(0, 0, 1)", "derivative(0, 1, 1)"),
    ],
    "src/fairness/measure_surface.cpp": [
        ("node-area", "area of a node: linear functions exactly", "whole / (3 * size)", "whole / size"),
        ("bending", "∫ κ₁² + κ₂²", "node_area * (k.k1 * k.k1 + k.k2 * k.k2)", "node_area * (k.k1 * k.k1 - k.k2 * k.k2)"),
        ("mean-variation", "∫ |∇H|²", "(along1 * along1 + along2 * along2) / 4", "(along1 * along1 + along2 * along2) / 2"),
        ("inline-variation", "∫ (∂κ₁/∂e₁)² + (∂κ₂/∂e₂)²", "k.k1_along_1 * k.k1_along_1 + k.k2_along_2 * k.k2_along_2",
         "k.k1_along_1 * k.k1_along_1 + k.k2_along_1 * k.k2_along_1"),
        ("cross-variation", "∫ (∂κ₁/∂e₂)² + (∂κ₂/∂e₁)²", "k.k1_along_2 * k.k1_along_2 + k.k2_along_1 * k.k2_along_1",
         "k.k1_along_2 * k.k1_along_2"),
        ("variation-scale", "the same at every size", "all.area * (all.inline_rates + all.cross_rates)", "(all.inline_rates + all.cross_rates)"),
        ("gaussian-scale", "the same at every size", "diagonal * diagonal * all.gaussian.greatest", "diagonal * all.gaussian.greatest"),
    ],
    "src/fairness/jet.cpp": [
        ("jet-factors", "elimination: what the rows above take from one", "rest[c] -= factor * entries[c]", "rest[c] += factor * entries[c]"),
        ("jet-rows-above", "what the rows above take from one", "above < k", "above + 1 < k"),
    ],
    "src/fairness/extrema.cpp": [
        ("highest-pass", "hills are joined by their highest pass", "a.value != b.value ? a.value > b.value : a.node < b.node", "a.node < b.node"),
        ("lowest-of-hills", "a hill that is joined stands over the lowest place of both", "std::min(lowest, low[static_cast<std::size_t>(lower)])", "lowest"),
    ],
    "src/fairness/measure_curve.cpp": [
        ("curve-energy", "energy: ((t_j − t_i)/ℓ)²", "(spring / length).squaredNorm()", "spring.squaredNorm()"),
    ],
    "src/fairness/measure_curve_figures.cpp": [
        ("curve-variation-scale", "the same at every size", "length_ * length_ * length_ * rates", "length_ * length_ * rates"),
        ("station", "where the curvature of a circle is that of the curve", "(to_before + to_after) / 3", "(to_before + to_after) / 2"),
        ("curve-rate", "∫ |dk/ds|²", "difference.squaredNorm() / (step * step)", "difference.squaredNorm() / step"),
        ("curve-transport", "curvature carried along", "b.curvature - transported(a.curvature, a.tangent, b.tangent)", "b.curvature - a.curvature", "Vector3"),
        ("curve-share", "length of an end", "k == 0 ? stations_[k].place : distance(k - 1) / 2", "k == 0 ? 0 : distance(k - 1) / 2"),
    ],
    "src/fairness/mesh_quality.cpp": [
        ("concave-angle", "angles beyond 180°", "2 * std::numbers::pi - angle", "std::numbers::pi - angle"),
    ],
    "src/fairness/distance.cpp": [
        ("height-over-triangle", "distance from a triangle", "height * height / area2", "height * height"),
    ],
    "src/shape/segment.hpp": [
        ("segment-ends", "distance from a segment", "std::clamp((point - a).dot(edge) / length2, 0.0, 1.0)", "(point - a).dot(edge) / length2"),
    ],
    "src/io/local_plane.cpp": [
        ("plane-exponent", "Gauss's sphere: n = √(1 + e² cos⁴φ / (1 − e²))", "std::sqrt(1 + eccentricity2 * cosine4 / (1 - eccentricity2))", "1.0"),
        ("plane-radius", "Gauss's sphere: R² = ρν", "2 * semi_major_axis * std::sqrt(1 - eccentricity2) / (1 - eccentricity2 * sine2)",
         "2 * semi_major_axis"),
        ("plane-latitude", "isometric latitude of the ellipsoid", "std::asinh(std::tan(latitude)) - e * std::atanh(e * std::sin(latitude))",
         "std::asinh(std::tan(latitude))"),
        ("plane-stretch", "oblique stereographic: k = 1 + r²/4R²",
         "(position.x() * position.x() + position.y() * position.y()) / (diameter_ * diameter_)",
         "2 * (position.x() * position.x() + position.y() * position.y()) / (diameter_ * diameter_)"),
    ],
    "src/shape/tour.cpp": [
        ("tour-turn", "2-opt: the steps that go", "length + distance(other, behind)", "length"),
        ("tour-move", "Or-opt: what is saved where a piece was", "here - distance(before, behind)", "here"),
        ("tour-move-turned", "Or-opt: which way a piece runs in its new place", "(side > 0) != (step > 0)", "(side > 0) == (step > 0)"),
    ],
    "src/curve_fit/dense_curve.cpp": [
        ("station-of-place", "where coordinates stay, they say where a place is", "v - (1 - share_of_moving) * moving_.cwiseProduct(v)", "v"),
    ],
    "src/curve_fit/polyline_bounds.cpp": [
        ("bound-on-long-ways", "between near rows a curve that goes far is bounded", "way(rows[k].at.edge, rows[(k + 1) % count].at.edge) > long_way * reach_",
         "false"),
    ],
    "src/curve_fit/node_spacing.cpp": [
        ("places-in-order", "places out of order are exchanged", "sorted[k] - least - from[k]", "values[k] - least - from[k]"),
    ],
    "src/curve_fit/outliers.cpp": [
        ("spikes-by-gain", "of spikes the one without which the way is shortest, for each row", "gain / (static_cast<double>(n) * std::max(middle, 1e-300))",
         "static_cast<double>(n) * gain / std::max(*middle, 1e-300)"),
    ],
    "src/curve_fit/curve_descent.cpp": [
        ("bound-across", "a bound across is what is left of it beside what is along", "std::sqrt(std::max(0.0, point.bound * point.bound - along * along))",
         "point.bound"),
    ],
    "src/curve_fit/curve_fitter.cpp": [
        ("rms-at-held", "points at held nodes do not make the others follow noise", "left >= std::pow(least_share_of_rms, 2) * wanted * movable", "true"),
    ],
    "src/fit/fit_curve.cpp": [
        ("better-is-near-the-way", "of two curves one that balloons is not taken", "(a.way_off <= most) != (b.way_off <= most)", "false"),
        ("better-uses-rms", "of two curves one that uses what is allowed is taken", "(a.figure >= least) != (b.figure >= least)", "false"),
    ],
    "src/linear/ball_program.cpp": [
        ("ball-bound", "a bound is on the length of a value", "values_[bound.row].squaredNorm() - most * most", "values_[bound.row].squaredNorm() - most"),
    ],
    "src/fill/rim.cpp": [
        ("outer-rim", "the rim of a sheet is no hole", "facing > 0.5", "facing > 1.5"),
        ("hole-sense", "new faces run as those around do", "std::reverse(loop.begin(), loop.end());", ""),
    ],
    "src/fill/rim_triangles.cpp": [
        ("least-dihedral-at-last-edge", "Liepa §2: the dihedral angle with the face beside every edge of the rim",
         "if (is_whole) weight.turn = std::max(weight.turn, turn_between(middle.normal, polygon_.normals.back()));", ""),
        ("least-area", "Liepa §2: then the least area", "weight.area += middle.area;", ""),
    ],
    "src/fill/refinement.cpp": [
        ("rounder-triangles", "Liepa §3: edges are swapped where opposite angles sum up to more than 180°",
         "sin_p * cos_q + cos_p * sin_q < -as_good", "sin_p * cos_q + cos_p * sin_q > as_good"),
    ],
    "src/span/network.cpp": [
        ("ends-go-to-curves", "an end goes to the curve that it meets, which stays", "sum[0].count > 0 ? sum[0] : sum[1]", "sum[1].count > 0 ? sum[1] : sum[0]"),
    ],
    "src/span/lids.cpp": [
        ("lid-beside-smooth", "faces of a box are no lids", "smooth > length / 2", "true"),
    ],
    "src/span/loops.cpp": [
        ("normals-agree", "normals agree from junction to junction", "else if (there.dot(normals_[n]) < 0)", "else if (false)"),
        ("outer-rim-of-a-network", "the outer rim of a sheet is no loop to span", "sum -= arcs_.of(half).length * ", "sum += arcs_.of(half).length * "),
    ],
    "src/span/end_normals.cpp": [
        ("cubic-between-normals", "the surface turns about its end as a cubic", "t * u * length * (u * slope[next - 1] - t * slope[next])", "0"),
    ],
    "src/span/held_surface.cpp": [
        ("crossing-curve", "the tangent plane is that of the end and of the curve that crosses it", "result.known[starts[k]] = normal / best;", "result.known[starts[k]] = Vector3::UnitX();"),
    ],
    "src/fill/patch_fairing.cpp": [
        ("crossing-patch", "a patch that crosses more than the flat one stays flat", "now[g].size() > flat[g].size()", "false"),
    ],
    "src/refine/refine.cpp": [
        ("opposite-side", "quads stay quads: the side opposite to a halved one is halved", "mark_edge(opposite);", ";"),
        ("graded-lengths", "near a long edge that stays others may be longer, by half of the distance less", "size - grading * length(node, other)", "size"),
        ("held-between", "only on the boundary a new node between held ones is held", "edges.uses(e).size() == 1", "true"),
        ("allowed-turn", "the surface turns by no more than is allowed", "turn_ = *how.turn / degrees_per_radian", "turn_ = 1.5 * *how.turn / degrees_per_radian"),
    ],
    "src/refine/evening.cpp": [
        ("longest-edge", "edges longer than 4/3 are halved", "longest_share = 4.0 / 3", "longest_share = 4.0 / 2"),
        ("shortest-edge", "edges shorter than 4/5 are collapsed", "shortest_share = 4.0 / 5", "shortest_share = 2.0 / 5"),
        ("graded-triangles", "near edges that stay others are of like length", "spread_from(true);", ";"),
        ("tangent-plane", "nodes go to the middle of the triangles around", "place(node) + share * (whole - place(node))", "place(node)"),
        ("flips-by-angles", "edges are flipped where opposite angles sum up to more than 180°", "> half_turn + rounding", "< straight - rounding"),
        ("moves-along-lines", "nodes of lines are collapsed along them only", "triangles_.line_of(from, to) != line(from)", "false"),
    ],
    "src/refine/input_surface.cpp": [
        ("same-side", "nodes go to the side of the surface that they are on", ".dot(normal) < 0 ?", ".dot(normal) > 0 ?"),
    ],
    "src/refine/editable_triangles.cpp": [
        ("link-condition", "an edge collapses only if its ends share no other neighbours", "common != at_edge.count", "false"),
    ],
    "src/symmetry/pairs.hpp": [
        ("mean-of-pair", "a pair goes to the mean of the one and the mirror image of the other", "(place + shape.plane.mirrored(other)) / 2", "place", "Vector3"),
        ("in-the-plane", "nodes on the plane stay in it", "place = shape.plane.projected(place);", ""),
    ],
    "src/symmetry/symmetric_constraints.cpp": [
        ("normal-of-image", "the mirror image has the mirrored normal", "held_.fix_normal(image, direction(held_.normal(node)));", ""),
        ("sense-of-image", "tangents turn round where the image runs the other way", "senses_.reversed(node) ? -1 : 1", "1"),
    ],
    "src/symmetry/given_report.hpp": [
        ("shared-by-halves", "nodes on the plane belong to both halves", "(of_whole + on_plane + 1) / 2", "(of_whole + 1) / 2"),
    ],
}
