#include <gtest/gtest.h>

#include "sample.hpp"

namespace tessera {
namespace {

TEST(Overrides, ReplaceValues) {
  const Case c = sample::read(sample::text,
                              {"time.end=0.1", "method.boundary=quasi-static", "body.0.particles.jitter=0.1",
                               "material.0.poisson=0.3", "material.0.young=2 GPa", "material.0.density = \"7.8 g/cm3\"",
                               "boundary.1.where=[\"-x\"]", "probe.0.name=other"});
  EXPECT_EQ(c.time.end, 0.1);
  EXPECT_EQ(c.method.boundary, BoundaryTreatment::quasi_static);
  EXPECT_EQ(std::get<LatticeSpec>(c.bodies[0].particles.source).jitter, 0.1);
  EXPECT_EQ(c.materials[0].poisson, 0.3);
  EXPECT_EQ(c.materials[0].young, 2e9);
  EXPECT_EQ(c.materials[0].density, 7800.0);
  EXPECT_EQ(c.boundary[1].where.items, (std::vector<std::string>{"-x"}));
  EXPECT_EQ(c.probes[0].name, "other");
}

TEST(Overrides, TakeItemsOfLists) {
  const Case c = sample::read(sample::text, {"body.0.particles.counts.0=42", "body.0.shape.box.max.1=2 m"});
  EXPECT_EQ((*std::get<LatticeSpec>(c.bodies[0].particles.source).counts)[0], 42);
  EXPECT_EQ(std::get<BoxShape>(c.bodies[0].shape->kind).max.y, 2.0);
}

TEST(Overrides, AddWhatTheFileDoesNotSay) {
  const Case c = sample::read(sample::text, {"method.dimension=3", "time.force=true", "body.0.shape.name=B",
                                             "material.0.contact={normal = 3}"});
  EXPECT_EQ(c.bodies[0].shape->name, "B");
  EXPECT_EQ(c.materials[0].contact.normal, 3.0);
  EXPECT_EQ(c.materials[0].contact.tangential, 1.0);
}

TEST(Overrides, BeginListsThatTheFileDoesNotHave) {
  const std::string without =
      sample::text.substr(0, sample::text.find("[[initial]]")) + sample::text.substr(sample::text.find("[[boundary]]"));
  const Case c = sample::read(without, {"initial.0.velocity=[1, 0, 0]", "initial.0.body=block"});
  ASSERT_EQ(c.initial.size(), 1U);
  EXPECT_EQ(c.initial[0].body, "block");
  EXPECT_NE(sample::error_of(without, {"initial.1.velocity=[1, 0, 0]"}).find("\"1\" is no item of a list of 0"),
            std::string::npos);
}

TEST(Overrides, ReplaceAlternatives) {
  const Case c =
      sample::read(sample::text, {"body.0.particles.spacing=5 cm", "boundary.3.condition=fixed",
                                  "body.0.shape={ polygon = { points = [[0,0],[1,0],[0,1]], thickness = 1 } }"});
  const auto& lattice = std::get<LatticeSpec>(c.bodies[0].particles.source);
  EXPECT_EQ(*lattice.spacing, 0.05);
  EXPECT_FALSE(lattice.counts);
  EXPECT_EQ(lattice.jitter, 0.25);
  EXPECT_EQ(std::get<Condition>(c.boundary[3].kind), Condition::fixed);
  EXPECT_TRUE(std::holds_alternative<PolygonShape>(c.bodies[0].shape->kind));
}

TEST(Overrides, LaterOnesWin) { EXPECT_EQ(sample::read(sample::text, {"time.end=1", "time.end=2"}).time.end, 2.0); }

struct Bad {
  const char* text;
  const char* message;
};

class BadOverride : public testing::TestWithParam<Bad> {};

TEST_P(BadOverride, IsRefused) {
  const std::string what = sample::error_of(sample::text, {GetParam().text});
  EXPECT_EQ(what.rfind("command line: ", 0), 0U) << what;
  EXPECT_NE(what.find(GetParam().message), std::string::npos) << what;
}

INSTANTIATE_TEST_SUITE_P(
    Overrides, BadOverride,
    testing::Values(Bad{"time.end", "expected key=value"}, Bad{"=3", "expected key=value"},
                    Bad{"time..end=3", "expected key=value"},
                    Bad{"time.ends=3", "time.ends: unknown key (did you mean \"end\"?)"},
                    Bad{"time.end=3 kg", "time.end: found the string \"3 kg\", a mass in kg; expected a time in s"},
                    Bad{"time.end=-1", "time.end: found the number -1, out of range; allowed: >= 0"},
                    Bad{"body.1.name=b", "body.1.name: \"1\" is no item of a list of 1"},
                    Bad{"body.x.name=b", "\"x\" is no item of a list of 1"}, Bad{"body.-1.name=b", "\"-1\" is no item"},
                    Bad{"time.end.x=b", "\"x\" lies inside the string \"1500 ms\", which is no table"},
                    Bad{"time.end=2024-01-01", "time.end: found a date or time"},
                    Bad{"time=3", "time: found the number 3; expected a table"},
                    Bad{"time.end=1\n[x]\ny=2", "time.end: found the string \"1\\n[x]\\ny=2\""},
                    Bad{"gravty.acceleration=[0,0,0]", "gravty: unknown key (did you mean \"gravity\"?)"},
                    Bad{"boundary.3.pressure=1 +",
                        "boundary.3.pressure: formula \"1 +\", character 4: it ends too early"}));

}  // namespace
}  // namespace tessera
