#include "tessera/discretization/second_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tessera/discretization/discretization.hpp"
#include "tessera/discretization/neighbour_rings.hpp"
#include "tessera/discretization/quadratic_fit.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

namespace {

// Second derivatives that amplify noise more than this are not resolved.
constexpr double largest_amplification = 12.0;
// Nor are those of cells that see none within so many rings of neighbours whose depth, in the mean with its neighbours,
// is this: so three layers are not resolved and four are. One cell counts as no deeper than four layers; cells with
// narrow stencils do.
constexpr double least_depth = 0.6, most_depth = 1.0;
constexpr int rings = 3;
// Away from the boundary a fit takes the neighbours with a common face and then, until it amplifies no more than this,
// the nearest of theirs, as many as this.
constexpr double enough = 6.0;
constexpr std::size_t most_added = 12;
// At the boundary it takes the nearest of theirs, as many as this, and elsewhere the nearest within three rings.
constexpr std::size_t widely_at_boundary = 30, widely = 54;
// The weight of a cell in means falls with this power of its deviation: the surest ones count.
constexpr int falls_with = 5;

/// One particle's fit and what it is over.
struct Fitted {
  FittedQuadratic quadratic;
  double amplification = std::numeric_limits<double>::infinity();
  std::size_t far = 0;  // how many of the particles beyond the neighbours with a common face, nearest first
  bool averaged = false;
  double depth = 0.0;
};

/// Fits particles one by one.
class Fitter {
 public:
  Fitted fit(const Discretization& d, Index a, CellPlace place) {
    rings_.start(d, a);
    if (rings_.near() == 0) return {};
    if (place == CellPlace::inside)
      if (const Fitted fitted = narrow(d); fitted.amplification <= enough) return fitted;
    return wide(d, a, place);
  }

  /// Of the one that was fitted last, what the fit takes beyond the neighbours with a common face, ascending.
  std::vector<Index> far(const Fitted& fitted) const {
    const std::span<const Index> nearest = rings_.particles().subspan(rings_.near(), fitted.far);
    std::vector<Index> ascending(nearest.begin(), nearest.end());
    std::sort(ascending.begin(), ascending.end());
    return ascending;
  }

 private:
  /// Of neighbours with a common face and the least of theirs that is enough.
  Fitted narrow(const Discretization& d) {
    extent_ = Extent::space;
    Fitted fitted = over(0);
    if (fitted.amplification <= enough) return fitted;
    rings_.widen(d, 2);
    rings_.sort_far();
    for (std::size_t added = 1; added <= std::min(most_added, rings_.far()); ++added) {
      if (rings_.ends_within_equals(added)) continue;
      fitted = over(added);
      if (fitted.amplification <= enough) break;
    }
    return fitted;
  }

  /// Over many, whatever they amplify.
  Fitted wide(const Discretization& d, Index a, CellPlace place) {
    rings_.widen(d, rings);
    extent_ = extent(rings_.branches());  // of all, so that a layer of a body is no plane
    const double seen = depth(rings_.branches(), d.measure->second_moment[static_cast<std::size_t>(a)], extent_);
    const bool at_boundary = place == CellPlace::at_boundary;
    if (at_boundary && extent_ == Extent::space) rings_.cut(2);
    rings_.sort_far();
    std::size_t added = std::min(at_boundary ? widely_at_boundary : widely, rings_.far());
    while (rings_.ends_within_equals(added)) ++added;
    Fitted fitted = over(added);
    fitted.averaged = place != CellPlace::near_boundary;
    fitted.depth = std::min(seen, most_depth);
    return fitted;
  }

  /// The fit over the neighbours with a common face and as many others.
  Fitted over(std::size_t others) const {
    const std::span<const Vec3> all = rings_.branches();
    const std::size_t near = rings_.near();
    double square = 0.0;
    for (const Vec3& X : all.first(near)) square += norm2(X);
    Fitted fitted;
    fitted.depth = most_depth;
    fitted.quadratic = fit_quadratic(all.first(near + others), extent_);
    fitted.amplification = square / static_cast<double>(near) * fitted.quadratic.deviation;
    fitted.far = others;
    return fitted;
  }

  NeighbourRings rings_;
  Extent extent_ = Extent::line;
};

/// Calls body(b, X_ab) for the particles that the fit of a is over.
template <class Body>
void for_each_fitted(const Discretization& d, const SecondDerivatives& s, Index a, Body&& body) {
  const Vec3& X_a = d.X[static_cast<std::size_t>(a)];
  d.for_each_face_neighbour(a, [&](Offset, Index b) { body(b, d.X[static_cast<std::size_t>(b)] - X_a); });
  for (const Index b : s.far.row(a)) body(b, d.X[static_cast<std::size_t>(b)] - X_a);
}

/// Calls body(b, share) for the cells in whose mean the cell's second derivatives are.
template <class Body>
void for_each_averaged(const Discretization& d, const SecondDerivatives& s, Index a, Body&& body) {
  std::vector<Index> cells{a};
  if (s.averaged[static_cast<std::size_t>(a)])
    d.for_each_face_neighbour(a, [&](Offset, Index b) { cells.push_back(b); });
  double sum = 0.0;
  for (const Index b : cells) sum += s.weight[static_cast<std::size_t>(b)];
  for (const Index b : cells)
    if (const double share = s.weight[static_cast<std::size_t>(b)] / sum; share > 0.0) body(b, share);
}

/// Each cell's value after take(value, other, count) has taken in those of its neighbours one by one, `other` being the
/// count-th of all, the cell's own the first.
template <class Take>
std::vector<double> with_neighbours(const Discretization& d, const std::vector<double>& values, Take&& take) {
  std::vector<double> result(values.size());
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    double value = values[static_cast<std::size_t>(i)];
    int count = 1;
    d.for_each_face_neighbour(static_cast<Index>(i),
                              [&](Offset, Index b) { take(value, values[static_cast<std::size_t>(b)], ++count); });
    result[static_cast<std::size_t>(i)] = value;
  });
  return result;
}

/// The greatest depth, in means of neighbours, that cells see.
std::vector<double> greatest_depths(const Discretization& d, const std::vector<double>& depths) {
  std::vector<double> seen =
      with_neighbours(d, depths, [](double& mean, double value, int count) { mean += (value - mean) / count; });
  for (int ring = 0; ring < rings; ++ring)
    seen = with_neighbours(d, seen, [](double& most, double value, int) { most = std::max(most, value); });
  return seen;
}

/// The rows of those that are not resolved become empty.
Csr<Index> of_resolved(const Csr<Index>& far, const std::vector<char>& resolved) {
  return parallel::collect_rows<Index>(far.rows(), [&](Index a, parallel::RowCollector<Index>& row) {
    if (!resolved[static_cast<std::size_t>(a)]) return;
    for (const Index b : far.row(a)) row.add(b);
  });
}

/// Adds up the values of terms of equal particles, which become ascending, and leaves out those of a, for which
/// branches vanish.
template <class Term, class Value>
void join(std::vector<Term>& terms, Value Term::*value, Index a) {
  std::erase_if(terms, [a](const Term& t) { return t.particle == a; });
  std::stable_sort(terms.begin(), terms.end(), [](const Term& l, const Term& r) { return l.particle < r.particle; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < terms.size(); ++i)
    if (terms[i].particle == terms[last].particle)
      terms[last].*value += terms[i].*value;
    else
      terms[++last] = terms[i];
  terms.resize(std::min(terms.size(), last + 1));
}

/// The second derivatives that a cell uses, or a number that follows from them: share_in(fit)(X_ab) is one particle's
/// share in those of a fit.
template <class Term, class Value, class ShareIn>
std::vector<Term> cell_terms(const Discretization& d, const SecondDerivatives& s, Index a, Value Term::*value,
                             ShareIn&& share_in) {
  std::vector<Term> terms;
  if (!s.resolved[static_cast<std::size_t>(a)]) return terms;
  for_each_averaged(d, s, a, [&](Index b, double share) {
    const auto of = share_in(s.fit[static_cast<std::size_t>(b)]);
    Value own{};
    for_each_fitted(d, s, b, [&](Index c, const Vec3& X) {
      terms.push_back({c, share * of(X)});
      own -= terms.back().*value;
    });
    terms.push_back({b, own});
  });
  join(terms, value, a);
  return terms;
}

}  // namespace

SecondDerivatives second_derivatives(const Discretization& d, std::span<const CellPlace> places) {
  const double size = std::cbrt(std::accumulate(d.volume.begin(), d.volume.end(), 0.0) / d.particles());
  SecondDerivatives result;
  result.fit.resize(d.X.size());
  result.resolved.resize(d.X.size());
  result.averaged.resize(d.X.size());
  result.weight.resize(d.X.size());
  result.amplification.resize(d.X.size());
  std::vector<double> depths(d.X.size());
  result.far = parallel::collect_rows<Index>(d.particles(), [&](Index i, parallel::RowCollector<Index>& far) {
    const auto a = static_cast<std::size_t>(i);
    thread_local Fitter fitter;
    const Fitted fitted = places[a] == CellPlace::refused ? Fitted{} : fitter.fit(d, i, places[a]);
    result.amplification[a] = fitted.amplification;
    depths[a] = fitted.depth;
    if (!(fitted.amplification <= largest_amplification)) return;
    result.fit[a] = fitted.quadratic.fit;
    result.averaged[a] = fitted.averaged;
    result.weight[a] = std::pow(size * size * fitted.quadratic.deviation, -falls_with);
    for (const Index b : fitter.far(fitted)) far.add(b);
  });
  depths = greatest_depths(d, depths);
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    result.resolved[a] = result.weight[a] > 0.0 && depths[a] >= least_depth;
    if (result.resolved[a]) return;
    result.fit[a] = {};
    result.averaged[a] = 0;
    result.weight[a] = 0.0;
  });
  if (std::count(result.resolved.begin(), result.resolved.end(), 0) > 0)
    result.far = of_resolved(result.far, result.resolved);
  return result;
}

std::vector<CurvatureTerm> curvature(const Discretization& d, const SecondDerivatives& s, Index a) {
  std::vector<CurvatureTerm> terms;
  const auto k = static_cast<std::size_t>(a);
  if (s.resolved[k])
    for_each_fitted(d, s, a, [&](Index b, const Vec3& X) { terms.push_back({b, share_of(s.fit[k], X)}); });
  return terms;
}

std::vector<CurvatureTerm> cell_curvature(const Discretization& d, const SecondDerivatives& s, Index a) {
  return cell_terms(d, s, a, &CurvatureTerm::W,
                    [](const QuadraticFit& fit) { return [&fit](const Vec3& X) { return share_of(fit, X); }; });
}

std::vector<MeanTerm> contracted_curvature(const Discretization& d, const SecondDerivatives& s, Index a,
                                           const Symmetric3& M) {
  return cell_terms(d, s, a, &MeanTerm::weight, [&M](const QuadraticFit& fit) { return contracted(fit, M); });
}

}  // namespace tessera
