// Curvatures at nodes, and their integrals, against closed forms on jittered meshes of all kinds of faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "vspring/vspring.hpp"

namespace vspring::fairness_curvature_test {
namespace {

using generate::Faces;
constexpr double pi = std::numbers::pi;

/// The two principal curvatures at a place.
using Exact = std::function<std::pair<double, double>(const Vector3&)>;
using Make = std::function<PolygonMesh(int cells, Faces faces)>;

double largest_error(const PolygonMesh& mesh, const Exact& exact) {
  double error = 0;
  const auto found = curvatures(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const NodeCurvature& at = found[static_cast<std::size_t>(i)];
    const auto [k1, k2] = exact(mesh.position(i));
    error = std::max({error, std::abs(at.k1 - k1), std::abs(at.k2 - k2)});
  }
  return error;
}

PolygonMesh mapped(PolygonMesh mesh, const std::function<Vector3(const Vector3&)>& map) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position = map(position);
  mesh.set_positions(positions);
  return mesh;
}

PolygonMesh torus(int cells, Faces faces) {
  return generate::torus({.columns = 3 * cells, .rows = cells, .faces = faces, .jitter = 0.3}, 1, 0.4);
}

/// x = cosh v cos u, y = cosh v sin u, z = v.
PolygonMesh catenoid(int cells, Faces faces) {
  return mapped(generate::plane({.columns = 2 * cells, .rows = cells, .faces = faces, .jitter = 0.3}, 4, 2),
                [](const Vector3& p) {
                  const double v = p.y() - 1;
                  return Vector3(std::cosh(v) * std::cos(p.x()), std::cosh(v) * std::sin(p.x()), v);
                });
}

constexpr double a = 1.5;
constexpr double b = 1.1;
constexpr double c = 0.8;

PolygonMesh ellipsoid(int cells) {
  return mapped(generate::genus({.holes = 0, .cells = cells}), [](const Vector3& p) -> Vector3 {
    return Vector3(p.x(), p.y() / 3, p.z()).normalized().cwiseProduct(Vector3(a, b, c));
  });
}

std::pair<double, double> of_ellipsoid(const Vector3& p) {
  const double support2 = 1 / p.cwiseQuotient(Vector3(a * a, b * b, c * c)).squaredNorm();
  const double product2 = a * a * b * b * c * c;
  const double gaussian = support2 * support2 / product2;
  const double mean = std::pow(support2, 1.5) * (a * a + b * b + c * c - p.squaredNorm()) / (2 * product2);
  const double half = std::sqrt(std::max(mean * mean - gaussian, 0.0));
  return {mean + half, mean - half};
}

struct Surface {
  const char* name;
  Make make;
  Exact exact;
};

const std::vector<Surface>& surfaces() {
  static const std::vector<Surface> all = {
      {"sphere",
       [](int n, Faces faces) {
         return generate::sphere_patch({.columns = n, .rows = n, .faces = faces, .jitter = 0.3}, 2);
       },
       [](const Vector3&) { return std::pair(0.5, 0.5); }},
      {"cylinder",
       [](int n, Faces faces) {
         return generate::cylinder_patch({.columns = 2 * n, .rows = n, .faces = faces, .jitter = 0.3}, 0.5);
       },
       [](const Vector3&) { return std::pair(2.0, 0.0); }},
      {"torus", torus,
       [](const Vector3& p) {
         const double distance = std::hypot(p.x(), p.y());
         return std::pair(2.5, (distance - 1) / 0.4 / distance);
       }},
      {"saddle",
       [](int n, Faces faces) { return generate::saddle({.columns = n, .rows = n, .faces = faces, .jitter = 0.3}); },
       [](const Vector3& p) {
         const double w = std::sqrt(1 + p.x() * p.x() + p.y() * p.y());
         const double mean = p.x() * p.y() / (w * w * w);
         const double half = std::sqrt(mean * mean + std::pow(w, -4));
         return std::pair(mean + half, mean - half);
       }},
      {"catenoid", catenoid,
       [](const Vector3& p) {
         const double k = std::pow(std::cosh(p.z()), -2);
         return std::pair(k, -k);
       }},
  };
  return all;
}

TEST(Curvatures, ConvergeWithTheThirdPowerOfTheSpacingAtEveryNode) {
  for (const Surface& surface : surfaces()) {
    for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
      const double coarse = largest_error(surface.make(24, faces), surface.exact);
      const double fine = largest_error(surface.make(96, faces), surface.exact);
      const double order = std::log2(coarse / fine) / 2;
      RecordProperty(std::string(surface.name) + std::to_string(static_cast<int>(faces)), std::to_string(order));
      EXPECT_GT(order, 2.3) << surface.name << " faces " << static_cast<int>(faces) << ": " << coarse << ", " << fine;
      EXPECT_LT(fine, 8e-3) << surface.name << " faces " << static_cast<int>(faces);
    }
  }
}

TEST(Curvatures, ConvergeOnAnEllipsoid) {
  const double coarse = largest_error(ellipsoid(8), of_ellipsoid);
  const double fine = largest_error(ellipsoid(32), of_ellipsoid);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.9) << coarse << ", " << fine;
}

TEST(Curvatures, AreRightWhereAGridEndsThatIsAlmostRegular) {
  // There four columns determine no polynomial of fourth degree, whatever the axes; a tilt turns these.
  for (const double tilt : {0.1, 0.3}) {
    PolygonMesh grid =
        mapped(generate::plane({.columns = 30, .rows = 20, .faces = Faces::quads}, 1, 2.0 / 3), [](const Vector3& p) {
          const double x = p.x() + 7e-6 * std::sin(7 * p.y() + 3 * p.x());
          return Vector3(x, p.y() + 3e-6 * std::sin(5 * p.x() * p.y() + 1), 0);
        });
    grid = mapped(grid, [&](const Vector3& p) {
      return Vector3(p.x(), p.y(), tilt * p.x() + 0.2 * p.x() * p.x() - 0.1 * p.y() * p.y() + 0.3 * std::pow(p.x(), 4));
    });
    const auto found = curvatures(grid);
    for (Index i = 0; i < grid.node_count(); ++i) {
      const double x = grid.position(i).x();
      const double p = tilt + 0.4 * x + 1.2 * std::pow(x, 3);
      const double q = -0.2 * grid.position(i).y();
      const double mean =
          -((1 + q * q) * (0.4 + 3.6 * x * x) - (1 + p * p) * 0.2) / (2 * std::pow(1 + p * p + q * q, 1.5));
      const NodeCurvature& at = found[static_cast<std::size_t>(i)];
      ASSERT_NEAR(std::abs(at.k1 + at.k2) / 2, std::abs(mean), 2e-3) << i << " of tilt " << tilt;
    }
  }
}

TEST(Curvatures, DirectionsAndNormals) {
  const PolygonMesh mesh = torus(48, Faces::mixed);
  const auto found = curvatures(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Vector3& p = mesh.position(i);
    const NodeCurvature& at = found[static_cast<std::size_t>(i)];
    const Vector3 around = Vector3(-p.y(), p.x(), 0).normalized();
    const Vector3 centre = Vector3(p.x(), p.y(), 0).normalized();
    EXPECT_GT(at.normal.dot((p - centre).normalized()), 1 - 1e-5);
    EXPECT_LT(std::abs(at.direction1.dot(around)), 0.02);
    EXPECT_GT(std::abs(at.direction2.dot(around)), 1 - 1e-3);
    EXPECT_NEAR(at.direction1.norm(), 1, 1e-12);
    EXPECT_NEAR(at.direction1.dot(at.direction2), 0, 1e-12);
    EXPECT_NEAR(at.direction1.dot(at.normal), 0, 1e-12);
  }
}

TEST(Curvatures, PlanesHaveNone) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const PolygonMesh mesh = generate::plane({.faces = faces, .jitter = 0.4});
    EXPECT_LT(largest_error(mesh, [](const Vector3&) { return std::pair(0.0, 0.0); }), 1e-10);
  }
}

using Member = double SurfaceFigures::*;
struct Claim {
  Member member;
  double exact;
};

/// Halving the spacing divides the error by nearly four. Returns the figures of the finer mesh.
SurfaceFigures expect_second_order(const std::function<PolygonMesh(int)>& make, int cells,
                                   const std::vector<Claim>& claims, const std::string& what) {
  const SurfaceFigures coarse = measure_surface(make(cells));
  const SurfaceFigures fine = measure_surface(make(2 * cells));
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const double error = std::abs(coarse.*claims[k].member / claims[k].exact - 1);
    const double half = std::abs(fine.*claims[k].member / claims[k].exact - 1);
    // Where it is far smaller than the rule promises, jitter decides.
    EXPECT_TRUE(std::log2(error / half) > 1.5 || half < 5e-5)
        << what << ", claim " << k << ": " << error << ", " << half;
    EXPECT_LT(half, 3e-2) << what << ", claim " << k;
  }
  return fine;
}

/// ∫ f over an interval by Simpson's rule.
double integral(double begin, double end, const std::function<double(double)>& f) {
  constexpr int steps = 400;
  double sum = f(begin) + f(end);
  for (int k = 1; k < steps; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(begin + (end - begin) * k / steps);
  return sum * (end - begin) / (3 * steps);
}

TEST(SurfaceIntegrals, ConvergeOnATorus) {
  const double major = 1;
  const double minor = 0.4;
  const double bending =
      4 * pi * pi * major / minor + 2 * pi * minor * integral(0, 2 * pi, [&](double t) {
                                      return std::cos(t) * std::cos(t) / (major + minor * std::cos(t));
                                    });
  const double area = 4 * pi * pi * major * minor;
  // ∂κ2/∂e1 = −R sin t / (r (R + r cos t)²), and it is the only derivative.
  const double variation = area * 2 * pi / minor * integral(0, 2 * pi, [&](double t) {
                             return std::pow(major * std::sin(t), 2) / std::pow(major + minor * std::cos(t), 3);
                           });
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const auto make = [&](int n) { return torus(n, faces); };
    const SurfaceFigures fine = expect_second_order(make, 48,
                                                    {{&SurfaceFigures::area, area},
                                                     {&SurfaceFigures::bending_energy, bending},
                                                     {&SurfaceFigures::mean_curvature_variation, variation / 4},
                                                     {&SurfaceFigures::curvature_variation_cross, variation}},
                                                    "torus, faces " + std::to_string(static_cast<int>(faces)));
    // Cyclides have none of the inline variation.
    EXPECT_LT(fine.curvature_variation, 1e-3 * variation);
  }
}

TEST(SurfaceIntegrals, ConvergeOnACatenoid) {
  const double bending = 4 * integral(-1, 1, [](double v) { return 2 * std::pow(std::cosh(v), -2); });
  const double area = 4 * integral(-1, 1, [](double v) { return std::pow(std::cosh(v), 2); });
  const double variation =
      area * 4 * integral(-1, 1, [](double v) { return 4 * std::pow(std::sinh(v), 2) * std::pow(std::cosh(v), -6); });
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const auto make = [&](int n) { return catenoid(n, faces); };
    const SurfaceFigures fine = expect_second_order(make, 48,
                                                    {{&SurfaceFigures::area, area},
                                                     {&SurfaceFigures::bending_energy, bending},
                                                     {&SurfaceFigures::curvature_variation, variation}},
                                                    "catenoid, faces " + std::to_string(static_cast<int>(faces)));
    EXPECT_LT(fine.mean_curvature_variation, 1e-3 * variation);
  }
}

TEST(SurfaceIntegrals, ConvergeOnSpheresAndEllipsoids) {
  const auto sphere = [](int n) {
    return mapped(generate::genus({.holes = 0, .cells = n}),
                  [](const Vector3& p) -> Vector3 { return Vector3(p.x(), p.y() / 3, p.z()).normalized(); });
  };
  expect_second_order(sphere, 12, {{&SurfaceFigures::area, 4 * pi}, {&SurfaceFigures::bending_energy, 8 * pi}},
                      "sphere");

  // ∫ 4H² − 2K dA over directions on the unit sphere.
  const double bending = integral(0, pi, [](double t) {
    return integral(0, 2 * pi, [t](double u) {
      const Vector3 unit(std::sin(t) * std::cos(u), std::sin(t) * std::sin(u), std::cos(t));
      const Vector3 p = unit.cwiseProduct(Vector3(a, b, c));
      const auto [k1, k2] = of_ellipsoid(p);
      const double stretch = a * b * c * unit.cwiseQuotient(Vector3(a, b, c)).norm();
      return (k1 * k1 + k2 * k2) * stretch * std::sin(t);
    });
  });
  expect_second_order(ellipsoid, 12, {{&SurfaceFigures::bending_energy, bending}}, "ellipsoid");
}

TEST(SurfaceIntegrals, OfACylinderPatch) {
  // Radius 0.5 over 120°, height 1: κ1 = 2, nothing varies.
  const SurfaceFigures figures =
      measure_surface(generate::cylinder_patch({.columns = 80, .rows = 40, .jitter = 0.3}, 0.5));
  EXPECT_NEAR(figures.bending_energy, 4 * 0.5 * 2 * pi / 3, 2e-3);
  EXPECT_LT(figures.mean_curvature_variation, 1e-2);
  EXPECT_LT(figures.curvature_variation_cross, 3e-2);
  EXPECT_NEAR(figures.greatest_curvature, 2 * figures.diagonal, 1e-2);
  EXPECT_NEAR(figures.least_curvature, 0, 1e-2);
  EXPECT_NEAR(figures.greatest_mean_curvature, figures.diagonal, 1e-2);
  EXPECT_NEAR(figures.least_gaussian_curvature, 0, 5e-2);
  EXPECT_EQ(figures.mean_curvature_extrema, 0);
}

}  // namespace
}  // namespace vspring::fairness_curvature_test
