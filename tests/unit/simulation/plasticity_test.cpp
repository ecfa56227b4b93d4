#include "sample.hpp"

namespace tessera::test {
namespace {

struct Variant {
  Method method;
  Volumetric volumetric;
  Integration integration = Integration::nodal;
};

std::string name_of(const Variant& v) {
  return name_of(v.method) + (v.volumetric == Volumetric::averaged ? "_averaged" : "") +
         (v.integration == Integration::second_order ? "_second_order" : "");
}

/// A cube that is clamped below and pulled to and fro above, far beyond its yield stress.
Case pulled(const Variant& v) {
  Case c = cube_case(v.method, {3, 3, 3}, 0.2);
  c.method.volumetric = v.volumetric;
  integrate(c, v.integration);
  c.materials[0].law = J2Plasticity::from_young_poisson(1e6, 0.3, 1e4, 5e4);
  c.boundary = {condition({"-z"}, Condition::fixed),
                condition({"+z"}, PrescribedDisplacement{{formula("0"), std::nullopt, formula("0.1*sin(20*t)^3")}})};
  c.time.end = 0.2;
  c.time.damping = 2.0;
  return c;
}

double largest_strain(const Engine& engine) {
  const Snapshot shot = engine.snapshot();
  return *std::max_element(shot.plastic_strain.begin(), shot.plastic_strain.end());
}

class PlasticRuns : public testing::TestWithParam<Variant> {};
/// Those whose forces have a potential.
class PlasticLedger : public PlasticRuns {};

/// The history goes through a checkpoint's file with all its bits, at any step, and a resumed run ends where an
/// unbroken one does; what the step's estimates try out leaves no trace.
TEST_P(PlasticRuns, ContinueBitwise) {
  Case c = pulled(GetParam());
  c.time.step = AutoSpectralStep{};
  c.time.safety = 0.2;
  const std::string path = testing::TempDir() + "/plastic_" + name_of(GetParam()) + ".h5";
  Running unbroken(c);
  unbroken.finish();
  EXPECT_GT(largest_strain(unbroken.engine), 0.05);
  Running whole(c);
  for (int steps : {0, 1, 40}) {
    whole.advance(steps);
    write_checkpoint(path, whole.engine.checkpoint());
    Running rest(c);
    rest.engine.restore(read_checkpoint(path));
    expect_same(rest.engine.checkpoint(), whole.engine.checkpoint());
    rest.finish();
    expect_same(rest.engine.checkpoint(), unbroken.engine.checkpoint());
    EXPECT_EQ(rest.engine.energies().error(), unbroken.engine.energies().error());
    EXPECT_EQ(rest.engine.snapshot().plastic_strain, unbroken.engine.snapshot().plastic_strain);
  }
}

/// What flow dissipates is in the books: they close, the better the shorter the step.
TEST_P(PlasticLedger, Closes) {
  const auto error = [&](double dt) {
    Case c = pulled(GetParam());
    c.time.step = FixedStep{dt, true};
    Running run(c);
    double largest = 0.0;
    run.finish([&](const Engine& e) { largest = std::max(largest, std::abs(e.energies().error())); });
    EXPECT_GT(run.engine.energies().dissipated, 0.4 * run.engine.energies().external_work);
    return largest / run.engine.energies().scale;
  };
  const double coarse = error(1e-3), fine = error(0.25e-3);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, coarse / 8.0);
}

std::string name_of_variant(const testing::TestParamInfo<Variant>& variant) { return name_of(variant.param); }

INSTANTIATE_TEST_SUITE_P(All, PlasticRuns,
                         testing::Values(Variant{Method::delaunay, Volumetric::standard},
                                         Variant{Method::consistent, Volumetric::standard},
                                         Variant{Method::variational, Volumetric::standard},
                                         Variant{Method::quasi_static, Volumetric::standard},
                                         Variant{Method::consistent, Volumetric::averaged},
                                         Variant{Method::consistent, Volumetric::averaged, Integration::second_order}),
                         name_of_variant);
INSTANTIATE_TEST_SUITE_P(All, PlasticLedger,
                         testing::Values(Variant{Method::delaunay, Volumetric::standard},
                                         Variant{Method::consistent, Volumetric::standard},
                                         Variant{Method::consistent, Volumetric::averaged},
                                         Variant{Method::consistent, Volumetric::averaged, Integration::second_order}),
                         name_of_variant);

}  // namespace
}  // namespace tessera::test
