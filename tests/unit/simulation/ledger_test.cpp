#include "sample.hpp"

namespace tessera::test {
namespace {

struct Sample {
  std::string name;
  Method method;
  std::function<void(Case&)> load;
};

/// The largest error of the energy ledger during a run with steps `dt` [s], relative to the largest energy.
double largest_error(const Sample& sample, double dt) {
  Case c = cube_case(sample.method, {3, 3, 3}, 0.2);
  c.time.end = 0.1;
  c.time.step = FixedStep{dt, true};
  c.initial = {initial_velocity(formulas("0.5*Y", "0", "0.8*X*Y"))};
  sample.load(c);
  Running run(c);
  double error = 0.0, scale = 0.0;
  run.finish([&](const Engine& e) {
    const EnergyLedger books = e.energies();
    error = std::max(error, std::abs(books.error()));
    scale = std::max(scale, books.scale);
  });
  return error / scale;
}

/// At rest all energies are round-off, which is no error of the books and has no shares.
TEST(Ledger, OfABodyAtRestHasNoError) {
  Case c = cube_case(Method::consistent, {3, 3, 3}, 0.2);
  c.boundary = {condition({"-x"}, Condition::fixed)};
  c.time.end = 0.05;
  Running run(c);
  run.finish([](const Engine& e) { EXPECT_LT(std::abs(e.energies().relative_error()), 0.01); });
  EXPECT_TRUE(std::isnan(run.engine.energies().contact_share()));
  EXPECT_TRUE(std::isnan(run.engine.energies().largest_contact_share()));
}

class LedgerCloses : public testing::TestWithParam<Sample> {};

/// The books close, and twice as well as the step halves squared.
TEST_P(LedgerCloses, WithTheSquareOfTheStep) {
  const double coarse = largest_error(GetParam(), 1e-3), fine = largest_error(GetParam(), 0.5e-3);
  RecordProperty("error", std::to_string(fine));
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(coarse / fine, 3.4);
  EXPECT_LT(coarse / fine, 4.6);
}

std::vector<Sample> samples() {
  const auto everything = [](Case& c) {
    c.materials[0].viscosity = {0.1, 0.1};
    c.materials[0].contact = {0.7, 1.6};
    c.gravity = {0, 0, -9.81};
    c.time.damping = 5.0;
    c.boundary = {condition({"-x"}, Condition::symmetric),
                  condition({"-y"}, PrescribedDisplacement{{formula("0"), formula("8*t*t*t"), formula("-20*t*t*t*X")}}),
                  condition({"+y"}, NominalTraction{formulas("3e5*t^2", "0", "2e5*t^2*Z")})};
    c.initial.clear();
  };
  std::vector<Sample> all;
  for (Method m : {Method::delaunay, Method::consistent}) {
    const std::string name = name_of(m) + "_";
    all.push_back({name + "free", m, [](Case&) {}});
    all.push_back({name + "traction", m, [](Case& c) {
                     c.boundary = {condition({"+x"}, NominalTraction{formulas("1e6*t^2", "3e5*t^2*Y", "0")}),
                                   condition({"-x"}, Condition::fixed)};
                     c.initial.clear();
                   }});
    all.push_back({name + "pressure", m,
                   [](Case& c) { c.boundary = {condition({"+z"}, NominalPressure{formula("1e5*sin(20*t)")})}; }});
    all.push_back({name + "following_pressure", m, [](Case& c) {
                     c.boundary = {condition({"+z", "+x"}, FollowingPressure{formula("4e5*t^2*(1+X)")}),
                                   condition({"-z"}, Condition::fixed)};
                     c.initial.clear();
                   }});
    all.push_back(
        {name + "rotation", m, [](Case& c) {
           c.boundary = {
               condition({"-z"}, Condition::fixed),
               condition({"+z"}, PrescribedRotation{
                                     {0, 0, 1}, {0.5, 0.5, 0}, formula("50*t^3"), formulas("0", "10*t^3", "0")})};
           c.initial.clear();
         }});
    all.push_back({name + "gravity", m, [](Case& c) { c.gravity = {3.0, 0, -9.81}; }});
    all.push_back({name + "wall", m, [](Case& c) {
                     c.boundary = {
                         condition({"-z"}, Condition::symmetric),
                         condition({"+z"}, PrescribedDisplacement{components(formulas("20*t^3", "0", "-30*t^3*X"))})};
                     c.initial.clear();
                   }});
    all.push_back({name + "velocity", m, [](Case& c) {
                     c.boundary = {
                         condition({"-z"}, Condition::fixed),
                         condition({"+z"}, PrescribedVelocity{{formula("60*t^2"), std::nullopt, std::nullopt}})};
                     c.initial.clear();
                   }});
    all.push_back({name + "damping", m, [](Case& c) { c.time.damping = 20.0; }});
    all.push_back({name + "viscosity", m, [](Case& c) { c.materials[0].viscosity = {0.2, 0.5}; }});
    all.push_back({name + "everything", m, everything});
  }
  for (const auto& [name, integration] :
       {std::pair{"consistent_cell_", Integration::cell}, {"consistent_second_order_", Integration::second_order}}) {
    all.push_back({std::string(name) + "free", Method::consistent, [=](Case& c) { integrate(c, integration); }});
    all.push_back({std::string(name) + "viscosity", Method::consistent, [=](Case& c) {
                     integrate(c, integration);
                     c.materials[0].viscosity = {0.2, 0.5};
                   }});
    all.push_back({std::string(name) + "everything", Method::consistent, [=](Case& c) {
                     integrate(c, integration);
                     everything(c);
                   }});
  }
  all.push_back({"variational_free", Method::variational, [](Case&) {}});
  all.push_back({"variational_viscosity", Method::variational, [](Case& c) { c.materials[0].viscosity = {0.2, 0.5}; }});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, LedgerCloses, testing::ValuesIn(samples()),
                         [](const auto& param) { return param.param.name; });

/// Free bodies keep their momenta; viscosity changes neither.
TEST(Momentum, OfFreeBodiesStays) {
  for (const auto& [method, integration] : {std::pair{Method::delaunay, Integration::nodal},
                                            {Method::consistent, Integration::nodal},
                                            {Method::variational, Integration::nodal},
                                            {Method::consistent, Integration::cell},
                                            {Method::consistent, Integration::second_order}}) {
    Case c = cube_case(method);
    integrate(c, integration);
    c.materials[0].viscosity = {0.1, 0.1};
    c.initial = {initial_velocity(formulas("1+0.5*Y", "-2*Z", "0.8*X*Y"))};
    Running run(c);
    run.engine.prepare();
    const Momentum start = run.engine.momentum();
    run.engine.advance();
    run.finish();
    const Momentum end = run.engine.momentum();
    EXPECT_LT(norm(end.linear - start.linear), 1e-12 * norm(start.linear)) << name_of(method);
    EXPECT_LT(norm(end.angular - start.angular), 1e-12 * norm(start.angular)) << name_of(method);
  }
}

/// The summary's largest share of the bonds is taken over the whole run, not at its end.
TEST(ContactShare, LargestOverTheRun) {
  Case c = cube_case(Method::delaunay);
  c.initial = {initial_velocity(formulas("Y*Z", "X", "-2*X*Y"))};
  Running run(c);
  double contact = 0.0, strain = 0.0;
  for (int i = 0; i < 40; ++i) {
    run.advance(1);
    run.engine.prepare();
    run.engine.verify_energy();
    const EnergyLedger e = run.engine.energies();
    contact = std::max(contact, e.contact);
    strain = std::max(strain, e.internal + e.contact);
  }
  const EnergyLedger end = run.engine.energies();
  EXPECT_GT(contact, end.contact);
  EXPECT_EQ(end.largest_contact_share(), contact / strain);
  EXPECT_EQ(end.contact_share(), end.contact / (end.contact + end.internal));
}

/// With gravity and a supporting wall the reaction carries the weight when all has come to rest.
TEST(Reactions, CarryTheWeightAtRest) {
  for (Method method : all_methods) {
    Case c = cube_case(method, {2, 2, 2}, 0.0);
    c.gravity = {0, 0, -9.81};
    c.time.damping = 60.0;
    c.time.end = 1.5;
    c.time.step = AutoStep{};
    c.boundary = {condition({"-z"}, Condition::fixed)};
    Running run(c);
    run.finish();
    Vec3 sum;
    for (const Vec3& r : run.engine.reactions()) sum += r;
    EXPECT_LT(norm(sum - Vec3{0, 0, -9810}), 1.0) << name_of(method);
  }
}

}  // namespace
}  // namespace tessera::test
