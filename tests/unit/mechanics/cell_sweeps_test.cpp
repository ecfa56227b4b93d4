#include "tessera/mechanics/cell_sweeps.hpp"

#include <gtest/gtest.h>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

/// What a sweep over the cells of a body gives.
struct CellAnswer {
  explicit CellAnswer(const System& s) : own(s.d.X.size()), J(s.d.X.size()), rim(s.tiles.rim.size()), scratch(s) {}
  CellStress stress() { return {own.data(), rim.data()}; }
  CellReport report() { return {nullptr, J.data(), nullptr}; }

  Field<Tensor> own;
  std::vector<double> J;
  Field<Tensor> rim;
  TileScratch scratch;
};

void expect_same_bits(const Field<Tensor>& a, const Field<Tensor>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(to_mat3(a[i]), to_mat3(b[i]));
}

/// Eight cells at once, where the processor can do that, have the same stresses as four, for quads of unequal lengths,
/// a quad that is alone and one with padding.
TEST(CellSweep, GivesTheSameBitsOnFourAndOnEightCells) {
  std::vector<Material> materials = other_materials();
  materials.push_back(rubber());
  for (const Material& material : materials) {
    if (material.plastic()) continue;
    for (const Index size : {64, 57, 11, 4, 1}) {
      const System s =
          system_of(discretize(Method::consistent, box({1, 1, 1}), {4, 4, 4}, 0.25, 3, nothing, Integration::cell),
                    material, size);
      State state = reference_state(s);
      move(state, s, wavy);
      Field<Tensor> F(s.d.X.size());
      CellAnswer wide(s), of_four(s);
      for (Index k = 0; k < s.tiles.size(); ++k) strain_sweep(s, k, state.x.data(), F.data(), wide.scratch);
      double energy = 0.0, energy_of_four = 0.0;
      for (Index k = 0; k < s.tiles.size(); ++k) {
        load_tile(s, k, state.x.data(), F.data(), wide.scratch);
        load_tile(s, k, state.x.data(), F.data(), of_four.scratch);
        energy +=
            cell_stress_sweep(s, k, F.data(), {}, nullptr, 0.0, wide.scratch, wide.stress(), wide.report()).internal;
        energy_of_four += cell_stress_sweep_of_four(s, k, F.data(), {}, nullptr, 0.0, of_four.scratch, of_four.stress(),
                                                    of_four.report())
                              .internal;
      }
      EXPECT_GT(energy, 0.0);
      EXPECT_NEAR(energy, energy_of_four, 1e-14 * energy_of_four);
      expect_same_bits(wide.own, of_four.own);
      expect_same_bits(wide.rim, of_four.rim);
      EXPECT_EQ(wide.J, of_four.J);
    }
  }
}

}  // namespace
}  // namespace tessera::test
