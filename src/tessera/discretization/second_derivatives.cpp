#include "tessera/discretization/second_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tessera/discretization/discretization.hpp"
#include "tessera/discretization/quadratic_fit.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

namespace {

// Second derivatives that amplify noise more than this are not resolved.
constexpr double largest_amplification = 12.0;
// Nor are those of cells whose depth over amplification, in the mean with their neighbours, is less than this: two
// layers. One cell counts as no deeper than that; cells with narrow stencils do.
constexpr double least_certainty = 0.25, most_depth = 2.0;
// Away from the boundary a fit takes the neighbours with a common face and then, until it amplifies no more than this,
// the nearest of theirs, as many as this.
constexpr double enough = 6.0;
constexpr std::size_t most_added = 12;
// All other fits take the nearest of their neighbours' neighbours, as many as this.
constexpr std::size_t widely = 34;
// Particles whose distances differ by less than this fraction are taken together, so that lattices keep their symmetry.
constexpr double equally_far = 1e-6;
// The weight of a cell in means falls with this power of its deviation: the surest ones count.
constexpr int falls_with = 8;

/// One particle's fit and what it is over.
struct Fitted {
  FittedQuadratic quadratic;
  double amplification = std::numeric_limits<double>::infinity();
  std::size_t far = 0;  // how many of the particles beyond the neighbours with a common face, nearest first
  bool averaged = false;
  double depth = most_depth;

  double certainty() const { return depth / amplification; }
};

/// Fits particles one by one.
class Fitter {
 public:
  Fitted fit(const Discretization& d, Index a, CellPlace place) {
    find_near(d, a);
    if (near_ == 0) return {};
    if (place == CellPlace::inside) {
      extent_ = Extent::space;
      if (const Fitted fitted = over(0); fitted.amplification <= enough) return fitted;
    }
    find_far(d, a);
    if (place == CellPlace::inside)
      if (const Fitted fitted = few(); fitted.amplification <= enough) return fitted;
    Fitted wide = over(widely_added());
    wide.averaged = place != CellPlace::near_boundary;
    wide.depth = std::min(depth(branches_, near_, extent_), most_depth);
    return wide;
  }

  /// Of the one that was fitted last, what the fit takes beyond the neighbours with a common face, ascending.
  std::span<const Index> far(const Fitted& fitted) {
    const auto begin = particles_.begin() + static_cast<std::ptrdiff_t>(near_);
    std::sort(begin, begin + static_cast<std::ptrdiff_t>(fitted.far));
    return std::span(particles_).subspan(near_, fitted.far);
  }

 private:
  /// The least that is enough.
  Fitted few() const {
    Fitted fitted;
    for (std::size_t added = 1; added <= std::min(most_added, particles_.size() - near_); ++added) {
      if (belongs_to_next(near_ + added)) continue;
      fitted = over(added);
      if (fitted.amplification <= enough) break;
    }
    return fitted;
  }

  std::size_t widely_added() const {
    std::size_t added = std::min(widely, particles_.size() - near_);
    while (added > 0 && belongs_to_next(near_ + added)) ++added;
    return added;
  }

  bool belongs_to_next(std::size_t count) const {
    return count < branches_.size() && norm(branches_[count]) < (1.0 + equally_far) * norm(branches_[count - 1]);
  }

  void find_near(const Discretization& d, Index a) {
    particles_.clear();
    branches_.clear();
    d.for_each_face_neighbour(a, [&](Offset, Index b) {
      particles_.push_back(b);
      branches_.push_back(branch(d, a, b));
    });
    near_ = particles_.size();
  }

  /// Neighbours of those.
  void find_far(const Discretization& d, Index a) {
    for (std::size_t i = 0; i < near_; ++i)
      d.for_each_face_neighbour(particles_[i], [&](Offset, Index c) {
        if (c != a && std::find(particles_.begin(), particles_.end(), c) == particles_.end()) particles_.push_back(c);
      });
    const auto square = [&](Index b) { return norm2(branch(d, a, b)); };
    std::sort(particles_.begin() + static_cast<std::ptrdiff_t>(near_), particles_.end(),
              [&](Index l, Index r) { return std::pair(square(l), l) < std::pair(square(r), r); });
    for (std::size_t i = near_; i < particles_.size(); ++i) branches_.push_back(branch(d, a, particles_[i]));
    extent_ = extent(branches_);
  }

  static Vec3 branch(const Discretization& d, Index a, Index b) {
    return d.X[static_cast<std::size_t>(b)] - d.X[static_cast<std::size_t>(a)];
  }

  /// The fit over the neighbours with a common face and as many others; `extent_` is that of all, so that a layer of a
  /// body is no plane.
  Fitted over(std::size_t others) const {
    const std::span<const Vec3> all(branches_);
    double square = 0.0;
    for (const Vec3& X : all.first(near_)) square += norm2(X);
    Fitted fitted;
    fitted.quadratic = fit_quadratic(all.first(near_ + others), extent_);
    fitted.amplification = square / static_cast<double>(near_) * fitted.quadratic.deviation;
    fitted.far = others;
    return fitted;
  }

  std::vector<Index> particles_;
  std::size_t near_ = 0;  // of them, with a common face
  std::vector<Vec3> branches_;
  Extent extent_ = Extent::line;
};

void add_terms(const Discretization& d, Index a, std::span<const Index> particles, const QuadraticFit& fit,
               std::vector<CurvatureTerm>& terms) {
  for (const Index b : particles)
    terms.push_back({b, share_of(fit, d.X[static_cast<std::size_t>(b)] - d.X[static_cast<std::size_t>(a)])});
}

/// Over a cell and its neighbours.
double mean(const Discretization& d, Index a, const std::vector<double>& values) {
  double sum = values[static_cast<std::size_t>(a)];
  int count = 1;
  d.for_each_face_neighbour(a, [&](Offset, Index b) { sum += values[static_cast<std::size_t>(b)], ++count; });
  return sum / count;
}

/// The rows of those that are not resolved become empty.
Csr<Index> of_resolved(const Csr<Index>& far, const std::vector<char>& resolved) {
  return parallel::collect_rows<Index>(far.rows(), [&](Index a, parallel::RowCollector<Index>& row) {
    if (!resolved[static_cast<std::size_t>(a)]) return;
    for (const Index b : far.row(a)) row.add(b);
  });
}

/// Adds up terms of equal particles, which become ascending.
void join(std::vector<CurvatureTerm>& terms) {
  std::stable_sort(terms.begin(), terms.end(),
                   [](const CurvatureTerm& l, const CurvatureTerm& r) { return l.particle < r.particle; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < terms.size(); ++i)
    if (terms[i].particle == terms[last].particle)
      terms[last].W += terms[i].W;
    else
      terms[++last] = terms[i];
  terms.resize(std::min(terms.size(), last + 1));
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
  std::vector<double> certainty(d.X.size());
  result.far = parallel::collect_rows<Index>(d.particles(), [&](Index i, parallel::RowCollector<Index>& far) {
    const auto a = static_cast<std::size_t>(i);
    thread_local Fitter fitter;
    const Fitted fitted = places[a] == CellPlace::refused ? Fitted{} : fitter.fit(d, i, places[a]);
    result.amplification[a] = fitted.amplification;
    certainty[a] = fitted.certainty();
    if (!(fitted.amplification <= largest_amplification)) return;
    result.fit[a] = fitted.quadratic.fit;
    result.averaged[a] = fitted.averaged;
    result.weight[a] = std::pow(size * size * fitted.quadratic.deviation, -falls_with);
    for (const Index b : fitter.far(fitted)) far.add(b);
  });
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    result.resolved[a] = result.weight[a] > 0.0 && mean(d, static_cast<Index>(i), certainty) >= least_certainty;
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
  if (!s.resolved[k]) return terms;
  std::vector<Index> near;
  d.for_each_face_neighbour(a, [&](Offset, Index b) { near.push_back(b); });
  add_terms(d, a, near, s.fit[k], terms);
  add_terms(d, a, s.far.row(a), s.fit[k], terms);
  return terms;
}

std::vector<CurvatureTerm> cell_curvature(const Discretization& d, const SecondDerivatives& s, Index a) {
  if (!s.resolved[static_cast<std::size_t>(a)]) return {};
  std::vector<Index> cells{a};
  if (s.averaged[static_cast<std::size_t>(a)])
    d.for_each_face_neighbour(a, [&](Offset, Index b) { cells.push_back(b); });
  double sum = 0.0;
  for (const Index b : cells) sum += s.weight[static_cast<std::size_t>(b)];
  std::vector<CurvatureTerm> terms;
  for (const Index b : cells) {
    const double share = s.weight[static_cast<std::size_t>(b)] / sum;
    Symmetric3 own;
    for (const CurvatureTerm& t : curvature(d, s, b)) {
      terms.push_back({t.particle, share * t.W});
      own -= share * t.W;
    }
    terms.push_back({b, own});
  }
  join(terms);
  std::erase_if(terms, [a](const CurvatureTerm& t) { return t.particle == a; });
  return terms;
}

}  // namespace tessera
