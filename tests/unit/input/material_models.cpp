#include <gtest/gtest.h>

#include "sample.hpp"

namespace tessera {
namespace {

const std::string neo_hookean = "model = \"neo-hookean\"\nyoung = \"1 MPa\"\npoisson = 0.45\n";

Material material_of(const std::string& constants) {
  return sample::read(sample::with(neo_hookean, constants)).materials[0];
}

std::string error_with(const std::string& constants) { return sample::error_of(sample::with(neo_hookean, constants)); }

TEST(MaterialModels, OfYoungAndPoissonTakeThem) {
  const Material svk = material_of("model = \"saint-venant-kirchhoff\"\nyoung = \"2 MPa\"\npoisson = 0.25\n");
  EXPECT_NEAR(std::get<SaintVenantKirchhoff>(svk.law).lambda, 0.8e6, 1e-6);
  EXPECT_NEAR(std::get<SaintVenantKirchhoff>(svk.law).mu, 0.8e6, 1e-6);
  const Material j2 = material_of(
      "model = \"j2-plasticity\"\nyoung = \"200 GPa\"\npoisson = 0.3\nyield_stress = \"300 MPa\"\nhardening = 1e9\n");
  const auto& law = std::get<J2Plasticity>(j2.law);
  EXPECT_NEAR(law.bulk, 200e9 / 1.2, 1.0);
  EXPECT_NEAR(law.mu, 200e9 / 2.6, 1.0);
  EXPECT_EQ(law.yield_stress, 300e6);
  EXPECT_EQ(law.hardening, 1e9);
  EXPECT_EQ(j2.young, 200e9);
}

/// The others give the modulus and the ratio of the same solid at rest, from which bonds take their stiffness.
TEST(MaterialModels, OfOtherConstantsKnowTheirYoungAndPoisson) {
  const double shear = 1e6, bulk = 4e6;
  const std::string mooney = "model = \"mooney-rivlin\"\nc10 = \"0.4 MPa\"\nc01 = \"0.1 MPa\"\nbulk = \"4 MPa\"\n";
  const std::string ogden =
      "model = \"ogden\"\nterms = [{ mu = \"1 MPa\", alpha = 1.5 }, { mu = -1e5, alpha = -5 }]\nbulk = \"4 MPa\"\n";
  const Material m = material_of(mooney), o = material_of(ogden);
  EXPECT_NEAR(m.shear_modulus(), shear, 1e-6 * shear);
  EXPECT_NEAR(o.shear_modulus(), shear, 1e-6 * shear);
  for (const Material& material : {m, o}) {
    EXPECT_NEAR(material.young, 9.0 * bulk * shear / (3.0 * bulk + shear), 1e-6);
    EXPECT_NEAR(material.young / (3.0 * (1.0 - 2.0 * material.poisson)), bulk, 1e-6 * bulk);
    EXPECT_NEAR(material.plane_wave_modulus(), bulk + 4.0 / 3.0 * shear, 1e-3);
  }
  EXPECT_EQ(std::get<Ogden>(o.law).terms.at(1).alpha, -5.0);
}

TEST(MaterialModels, RefuseWhatTheyCannotUse) {
  struct {
    const char* constants;
    const char* message;
  } const cases[] = {
      {"model = \"mooney-rivlin\"\nyoung = 1e6\nc10 = 1\nc01 = 1\nbulk = 1\n",
       "13:9: material.0.young: only has an effect with model = \"neo-hookean\", model = \"saint-venant-kirchhoff\" or "
       "model = \"j2-plasticity\""},
      {"model = \"neo-hookean\"\nyoung = 1e6\npoisson = 0.3\nhardening = 1\n",
       "15:13: material.0.hardening: only has an effect with model = \"j2-plasticity\""},
      {"model = \"mooney-rivlin\"\nc10 = 1\nbulk = 1\n", "material.0.c01: missing; expected a pressure"},
      {"model = \"mooney-rivlin\"\nc10 = 1\nc01 = -1\nbulk = 1\n",
       "13:7: material.0.c10: the shear modulus at rest, 2 (c10 + c01), is 0 Pa; it must be > 0"},
      {"model = \"ogden\"\nterms = []\nbulk = 1\n", "material.0.terms: found the list []; expected a list of tables"},
      {"model = \"ogden\"\nterms = [{ mu = 1, alpha = 0 }]\nbulk = 1\n",
       "material.0.terms.0.alpha: found 0; an exponent must not be zero"},
      {"model = \"ogden\"\nterms = [{ mu = 1, alpha = -1 }]\nbulk = 1\n",
       "material.0.terms: the shear modulus at rest, half the sum of mu alpha, is -0.5 Pa; it must be > 0"},
      {"model = \"j2-plasticity\"\nyoung = 1e6\npoisson = 0.3\n", "material.0.yield_stress: missing"},
      {"model = \"j2-plasticity\"\nyoung = 1e6\npoisson = 0.3\nyield_stress = 1\nhardening = -1\n",
       "material.0.hardening: found the number -1, out of range; allowed: >= 0"},
      {"model = \"j2-plastic\"\nyoung = 1e6\npoisson = 0.3\n", "(did you mean"},
  };
  for (const auto& c : cases)
    EXPECT_NE(error_with(c.constants).find(c.message), std::string::npos) << error_with(c.constants);
}

TEST(Volumetric, IsReadForAllIntegrations) {
  const auto with = [](const std::string& integration) {
    return sample::read(sample::text, {"method.boundary=consistent", "method.volumetric=averaged", integration}).method;
  };
  EXPECT_EQ(sample::read(sample::text).method.volumetric, Volumetric::standard);
  for (const std::string integration : {"nodal", "cell", "second-order"})
    EXPECT_EQ(with("method.integration=" + integration).volumetric, Volumetric::averaged);
}

}  // namespace
}  // namespace tessera
