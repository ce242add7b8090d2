#include "fairness/jet.hpp"

#include <tuple>
#include <utility>

#include "base/inlined.hpp"

namespace vspring {

namespace {

// The monomials of degree d end before terms[d]; that many points and a few more determine them.
constexpr std::array<std::size_t, 5> terms = {0, 2, 5, 9, 14};
constexpr std::array<std::size_t, 5> points_needed = {0, 2, 5, 11, 17};
// The squared sine of the angle, at the points, between a monomial and the space of those before it. Next to a boundary
// it is about 1e-4; below this value the points lie on a curve of lower degree.
constexpr double independent = 1e-6;

template <std::size_t lanes>
struct VectorOf {
  using Type __attribute__((vector_size(lanes * sizeof(double)), may_alias)) = double;
};

}  // namespace

/// Sums up and eliminates row by row, each when those above it are done. Every entry is summed and reduced in one fixed
/// order, so the bits do not depend on how many entries are processed at once.
template <std::size_t lanes>
class NormalEquations {
 public:
  VSPRING_INLINE NormalEquations(const JetFit& fit) : points_(fit.rows_.data()), count_(fit.points_) {}

  VSPRING_INLINE Jet solve() {
    eliminate(std::make_index_sequence<unknowns>());
    std::array<double, unknowns> c{};
    for (std::size_t k = solved_; k-- > 0;) {
      double rest = rows_[k].entry[unknowns];
      for (std::size_t b = k + 1; b < solved_; ++b) rest -= rows_[k].entry[b] * c[b];
      c[k] = rest / rows_[k].entry[k];
    }
    Jet jet;
    jet.degree = degree_;
    jet.first = {c[0], c[1]};
    jet.second = {2 * c[2], c[3], 2 * c[4]};
    jet.third = {6 * c[5], 2 * c[6], 2 * c[7], 6 * c[8]};
    return jet;
  }

 private:
  static constexpr std::size_t unknowns = 14;
  using Row = JetFit::Row;
  static constexpr std::size_t width = std::tuple_size_v<decltype(Row::entry)>;
  using Vector = typename VectorOf<lanes>::Type;

  template <std::size_t... k>
  VSPRING_INLINE void eliminate(std::index_sequence<k...>) {
    (void)(next<k>() && ...);
  }

  /// False if the points determine nothing beyond row k.
  template <std::size_t k>
  VSPRING_INLINE bool next() {
    const auto degree = static_cast<std::size_t>(degree_);
    if (k == terms[degree] && count_ < points_needed[degree + 1]) return false;
    // As many rows at once as have their sums in registers.
    constexpr std::size_t together = lanes == 4 ? (k < 8 ? 2 : k < 12 ? 4 : 2) : (k < 8 ? 1 : 2);
    if constexpr (k % together == 0) sum_up<k>(std::make_index_sequence<together>(), chunks<k>());
    const double squares = rows_[k].entry[k];
    reduce<k>(chunks<k>());
    if (!(rows_[k].entry[k] > independent * squares)) return false;
    divide<k>(chunks<k>());
    if (k + 1 == terms[degree + 1]) {
      ++degree_;
      solved_ = k + 1;
    }
    return true;
  }

  /// The first chunk of a row with an entry of the upper triangle.
  static constexpr std::size_t first_chunk(std::size_t k) { return k / lanes; }
  template <std::size_t k>
  static constexpr auto chunks() {
    return std::make_index_sequence<width / lanes - first_chunk(k)>();
  }
  static VSPRING_INLINE const Vector* vectors(const Row& row) {
    return reinterpret_cast<const Vector*>(row.entry.data());
  }
  static VSPRING_INLINE Vector* vectors(Row& row) { return reinterpret_cast<Vector*>(row.entry.data()); }

  template <std::size_t k, std::size_t... a, std::size_t... c>
  VSPRING_INLINE void sum_up(std::index_sequence<a...>, std::index_sequence<c...> columns) {
    Vector sums[sizeof...(a)][sizeof...(c)] = {};
    for (const Row* point = points_; point != points_ + count_; ++point) {
      const Vector* entries = vectors(*point) + first_chunk(k);
      (add(sums[a], point->entry[k + a], entries, columns), ...);
    }
    (store(sums[a], vectors(rows_[k + a]) + first_chunk(k), columns), ...);
  }
  template <std::size_t... c>
  static VSPRING_INLINE void add(Vector* sums, double factor, const Vector* entries, std::index_sequence<c...>) {
    ((sums[c] += factor * entries[c]), ...);
  }
  template <std::size_t... c>
  static VSPRING_INLINE void store(const Vector* from, Vector* to, std::index_sequence<c...>) {
    ((to[c] = from[c]), ...);
  }

  template <std::size_t k, std::size_t... c>
  VSPRING_INLINE void reduce(std::index_sequence<c...>) {
    Vector* own = vectors(rows_[k]) + first_chunk(k);
    Vector rest[] = {own[c]...};
    for (std::size_t above = 0; above < k; ++above) {
      const double factor = factors_[above].entry[k];
      const Vector* entries = vectors(rows_[above]) + first_chunk(k);
      ((rest[c] -= factor * entries[c]), ...);
    }
    ((own[c] = rest[c]), ...);
  }

  template <std::size_t k, std::size_t... c>
  VSPRING_INLINE void divide(std::index_sequence<c...>) {
    const Vector* own = vectors(rows_[k]) + first_chunk(k);
    Vector* factors = vectors(factors_[k]) + first_chunk(k);
    const double pivot = rows_[k].entry[k];
    ((factors[c] = own[c] / pivot), ...);
  }

  std::array<Row, unknowns> rows_;     // the upper triangle, the last column for heights
  std::array<Row, unknowns> factors_;  // rows divided by their first entry
  const Row* points_;
  std::size_t count_;
  std::size_t solved_ = 0;
  int degree_ = 0;
};

namespace {

using Solve = Jet (*)(const JetFit&);

Jet solve_by_twos(const JetFit& fit) { return NormalEquations<2>(fit).solve(); }

#if defined(__x86_64__)
__attribute__((target("avx2"))) Jet solve_by_fours(const JetFit& fit) { return NormalEquations<4>(fit).solve(); }

Solve fastest_here() { return __builtin_cpu_supports("avx2") ? solve_by_fours : solve_by_twos; }
#else
Solve fastest_here() { return solve_by_twos; }
#endif

}  // namespace

void JetFit::add(double u, double v, double height, double weight) noexcept {
  const double uu = u * u;
  const double uv = u * v;
  const double vv = v * v;
  Row& row = rows_[points_++];
  row.entry = {u,      v,       uu,      uv,      vv,      uu * u,  uu * v, vv * u,
               vv * v, uu * uu, uu * uv, uu * vv, uv * vv, vv * vv, height, 0};
  for (double& entry : row.entry) entry *= weight;
}

Jet JetFit::solve() const noexcept {
  static const Solve fastest = fastest_here();
  return fastest(*this);
}

}  // namespace vspring

#undef VSPRING_INLINE
