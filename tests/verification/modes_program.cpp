// The lowest linear modes of a case at rest. Usage: modes_program CASE.toml MODES [KEY=VALUE ...]; prints JSON.
//
// The stiffness K is assembled column by column from central differences of the library's forces, so it contains
// whatever the forces contain. Eigenvalues of M^-1/2 K M^-1/2 come from inverse iteration on a subspace (Eigen's sparse
// LDL^T), and how many lie below zero from the signs of D (Sylvester's law of inertia).

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tessera/dynamics/time_step.hpp"
#include "tessera/input/case_file.hpp"
#include "tessera/mechanics/forces.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/simulation/model.hpp"

namespace tessera {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Displacement of a difference, in shortest bonds: its error, of second order, and round-off are both near 1e-10.
constexpr double difference = 1e-5;
// Entries of a column below this share of its largest are round-off.
constexpr double negligible = 1e-13;
// Relative to the largest diagonal entry: the shift that makes the matrix of a free body regular, and the largest
// negative eigenvalue that passes for round-off.
constexpr double shift_share = 1e-8;
constexpr int most_iterations = 300;
constexpr double settled = 1e-10;

std::size_t particle_of(Index i) { return static_cast<std::size_t>(i / 3); }
int axis_of(Index i) { return static_cast<int>(i % 3); }

std::vector<Vec3> resting_walls(const System& s) {
  std::vector<Vec3> walls;
  for (const BoundaryNode& f : s.d.nodes) walls.push_back(f.wall);
  return walls;
}

/// Components of particles that are not held; only particles held in all directions are known here.
std::vector<bool> free_particles(const System& s) {
  std::vector<bool> free(s.d.X.size(), true);
  for (const ParticleConstraint& c : s.d.constraints) free[static_cast<std::size_t>(c.particle)] = false;
  return free;
}

/// S = M^-1/2 K M^-1/2 over the free particles; `number` gives the row of each component, -1 where it is held.
Sparse scaled_stiffness(const System& s, const std::vector<Index>& number, Index size) {
  const std::vector<Vec3> walls = resting_walls(s);
  Forces plus(s), minus(s);
  State state = reference_state(s);
  const double h = difference * s.shortest_length;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index j = 0; j < static_cast<Index>(number.size()); ++j) {
    if (number[static_cast<std::size_t>(j)] < 0) continue;
    double& x = state.x[particle_of(j)][axis_of(j)];
    const double rest = x;
    x = rest + h;
    plus.evaluate(state, {walls, {}, {}}, 0.0);
    state.x[particle_of(j)][axis_of(j)] = rest - h;
    minus.evaluate(state, {walls, {}, {}}, 0.0);
    state.x[particle_of(j)][axis_of(j)] = rest;
    std::vector<double> column(number.size());
    double largest = 0.0;
    for (Index i = 0; i < static_cast<Index>(number.size()); ++i) {
      const std::size_t a = particle_of(i);
      const double f = minus.total()[a][axis_of(i)] - plus.total()[a][axis_of(i)];
      column[static_cast<std::size_t>(i)] = f / (2.0 * h * std::sqrt(s.mass[a] * s.mass[particle_of(j)]));
      largest = std::max(largest, std::abs(column[static_cast<std::size_t>(i)]));
    }
    for (Index i = 0; i < static_cast<Index>(number.size()); ++i)
      if (const Index row = number[static_cast<std::size_t>(i)];
          row >= 0 && std::abs(column[static_cast<std::size_t>(i)]) > negligible * largest)
        entries.emplace_back(row, number[static_cast<std::size_t>(j)], column[static_cast<std::size_t>(i)]);
  }
  Sparse S(size, size);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

Sparse shifted(const Sparse& S, double shift) {
  Sparse one(S.rows(), S.cols());
  one.setIdentity();
  return S + shift * one;
}

MatrixXd orthonormal(const MatrixXd& Y) {
  return Eigen::HouseholderQR<MatrixXd>(Y).householderQ() * MatrixXd::Identity(Y.rows(), Y.cols());
}

struct Modes {
  VectorXd omega2;     // ascending [1/s2]
  MatrixXd vectors;    // of M^1/2 times the displacement, one a column
  Index negative = 0;  // eigenvalues below zero, round-off apart
};

Modes lowest_modes(const Sparse& S, Index wanted) {
  const double shift = shift_share * VectorXd(S.diagonal()).maxCoeff();
  const Eigen::SimplicialLDLT<Sparse> inverse(shifted(S, shift));
  Modes modes;
  modes.negative = (inverse.vectorD().array() < 0.0).count();
  const Index block = std::min(S.rows(), wanted + 10);
  std::srand(1);
  MatrixXd Y = orthonormal(MatrixXd::Random(S.rows(), block));
  for (int k = 0; k < most_iterations; ++k) {
    Y = orthonormal(inverse.solve(Y));
    const MatrixXd small = Y.transpose() * (S * Y);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(0.5 * (small + small.transpose()));
    Y = Y * ritz.eigenvectors();
    const bool done = k > 0 && (ritz.eigenvalues() - modes.omega2).head(wanted).cwiseAbs().maxCoeff() <
                                   settled * std::abs(ritz.eigenvalues()(wanted - 1));
    modes.omega2 = ritz.eigenvalues();
    modes.vectors = Y;
    if (done) return modes;
  }
  std::fprintf(stderr, "the modes have not settled in %d iterations\n", most_iterations);
  std::exit(1);
}

Vec3 centre_of(const System& s) {
  Vec3 sum;
  double mass = 0.0;
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    sum += s.mass[a] * s.d.X[a];
    mass += s.mass[a];
  }
  return (1.0 / mass) * sum;
}

/// The direction in which the body is longest.
Vec3 long_axis(const System& s) {
  Vec3 low = s.d.X[0], high = s.d.X[0];
  for (const Vec3& X : s.d.X)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], X[i]);
      high[i] = std::max(high[i], X[i]);
    }
  const Vec3 size = high - low;
  Vec3 axis;
  axis[size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2] = 1.0;
  return axis;
}

/// Kinetic energy of the motion inside cells, which masses at points leave out, as a share of theirs: cells are taken
/// as cubes of their volume that move with F_a.
double motion_inside(const System& s, const std::vector<Index>& number, const VectorXd& v) {
  State state = reference_state(s);
  const double h = difference * s.shortest_length;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] >= 0) state.x[i / 3][static_cast<int>(i % 3)] += h * v(number[i]) / std::sqrt(s.mass[i / 3]);
  Forces forces(s);
  const std::vector<Vec3> walls = resting_walls(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  double sum = 0.0;
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    const Mat3 gradient = (1.0 / h) * (to_mat3(forces.deformation_gradient()[a]) - identity());
    for (double g : gradient.m) sum += s.mass[a] * std::pow(s.d.volume[a], 2.0 / 3.0) / 12.0 * g * g;
  }
  return sum;
}

/// Shares of the kinetic energy along the long axis and around it: near one for stretching and for torsion.
nlohmann::json describe(const System& s, const std::vector<Index>& number, const VectorXd& v, double omega2) {
  const Vec3 axis = long_axis(s), centre = centre_of(s);
  double along = 0.0, around = 0.0;
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    if (number[3 * a] < 0) continue;
    const Vec3 w{v(number[3 * a]), v(number[3 * a + 1]), v(number[3 * a + 2])};
    const Vec3 turn = cross(axis, s.d.X[a] - centre);
    along += dot(w, axis) * dot(w, axis);
    if (norm(turn) > 0.0) around += dot(w, turn) * dot(w, turn) / dot(turn, turn);
  }
  return {{"omega2", omega2}, {"along", along}, {"around", around}, {"inside", motion_inside(s, number, v)}};
}

nlohmann::json report(const System& s, Index wanted) {
  std::vector<Index> number(3 * s.d.X.size(), -1);
  const std::vector<bool> free = free_particles(s);
  Index size = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (free[i / 3]) number[i] = size++;
  const Sparse S = scaled_stiffness(s, number, size);
  const Sparse transposed = S.transpose();
  const Modes modes = lowest_modes(0.5 * (S + transposed), wanted);
  nlohmann::json list = nlohmann::json::array();
  for (Index k = 0; k < wanted; ++k) list.push_back(describe(s, number, modes.vectors.col(k), modes.omega2(k)));
  SpectralEstimator estimator(s);
  const double fastest = estimator.largest_frequency(reference_state(s), resting_walls(s), s.shortest_length);
  return {{"particles", s.particles()},
          {"asymmetry", Sparse(S - transposed).norm() / S.norm()},
          {"negative", modes.negative},
          {"largest_omega", fastest},
          {"stable_step", stable_step(s, fastest)},
          {"travel_time", shortest_travel_time(s)},
          {"modes", list}};
}

}  // namespace
}  // namespace tessera

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "usage: modes_program CASE.toml MODES [KEY=VALUE ...]\n");
    return 2;
  }
  tessera::parallel::set_threads(1);  // the bodies are small
  try {
    const tessera::Case c = tessera::read_case(arguments[1], {arguments + 3, arguments + count});
    const tessera::Model model = tessera::build_model(c);
    std::printf("%s\n", tessera::report(model.system, std::strtol(arguments[2], nullptr, 10)).dump(1).c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "modes_program: %s\n", e.what());
    return 1;
  }
  return 0;
}
