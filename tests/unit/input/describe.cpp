#include "tessera/input/describe.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tessera/base/error.hpp"
#include "tessera/input/parameter.hpp"
#include "tessera/input/toml_reader.hpp"
#include "tessera/output/quantities.hpp"

namespace tessera {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(InputTable, IsComplete) {
  std::set<std::string> seen;
  for (const input::Parameter& p : input::parameters()) {
    EXPECT_TRUE(seen.insert(p.key).second) << p.key << " is declared twice";
    EXPECT_TRUE(p.sentence.ends_with(".")) << p.key;
    const auto dot = p.key.rfind('.');
    const bool declared = dot == std::string::npos || seen.count(p.key.substr(0, dot)) > 0;
    EXPECT_TRUE(declared) << p.key << " comes before its table";
    for (const std::string& toml : {p.standard, p.flat})
      EXPECT_TRUE(toml.empty() || input::read_toml_value(toml).has_value()) << p.key << ": " << toml;
    const bool words = p.kind == input::Kind::choice || p.kind == input::Kind::step;
    EXPECT_EQ(!p.choices.empty(), words) << p.key;
    for (const std::string& name : p.exactly_one) EXPECT_NE(input::find_parameter(p.key + "." + name), nullptr) << name;
  }
}

TEST(Describe, NamesTheQuantitiesThatAreWrittenUnlessAskedFor) {
  const std::string text = describe_key("output.fields.quantities");
  const std::string sentence = text.substr(0, text.find("Quantities\n"));
  for (const Quantity* quantity : field_quantities({}, {}))
    EXPECT_TRUE(contains(sentence, std::string(quantity->name))) << sentence;
}

TEST(Describe, ShowsEveryKey) {
  const std::string text = describe_input();
  const std::string markdown = describe_input_markdown();
  for (const input::Parameter& p : input::parameters()) {
    EXPECT_TRUE(contains(text, p.key)) << p.key;
    EXPECT_TRUE(contains(text, p.sentence)) << p.key;
    for (const std::string& meaning : p.meanings) EXPECT_TRUE(contains(text, meaning) && contains(markdown, meaning));
    EXPECT_TRUE(contains(markdown, p.key)) << p.key;
  }
  EXPECT_TRUE(contains(text, "von_mises [Pa]"));
}

TEST(Describe, ShowsUnitRangeAndDefault) {
  EXPECT_EQ(describe_key("material.density"),
            "material.density\n    Density in the reference state.\n"
            "    a density in kg/m3, as in \"1000 kg/m3\" or 1000; allowed: > 0; required\n");
  EXPECT_TRUE(contains(describe_key("time.safety"), "allowed: > 0 and <= 1; default 0.8 (0.3 with step = \"auto\")"));
  EXPECT_TRUE(
      contains(describe_key("method.integration"),
               "default \"second-order\" (\"nodal\" with volumetric = \"averaged\"; \"cell\" with formulation = "));
}

TEST(Describe, TakesSectionsNumbersAndEndsOfKeys) {
  const std::string section = describe_key("[time]");
  EXPECT_TRUE(contains(section, "time.end\n") && contains(section, "time.damping\n"));
  EXPECT_FALSE(contains(section, "material"));
  EXPECT_EQ(describe_key("body.0.particles.jitter"), describe_key("jitter"));
  EXPECT_TRUE(contains(describe_key("output.fields.quantities"), "von_mises"));
}

TEST(Describe, SuggestsTheNearestKey) {
  for (const auto& [key, nearest] : {std::pair{"time.safty", "time.safety"}, {"jiter", "jitter"}}) {
    try {
      describe_key(key);
      FAIL();
    } catch (const UsageError& error) {
      EXPECT_TRUE(contains(error.what(), std::string("did you mean \"") + nearest + "\"?")) << error.what();
    }
  }
  EXPECT_THROW(describe_key("7"), UsageError);
}

TEST(Describe, BarsDoNotBreakTheTables) {
  const std::string markdown = describe_input_markdown();
  for (std::size_t begin = 0; begin < markdown.size();) {
    const std::size_t end = markdown.find('\n', begin);
    const std::string line = markdown.substr(begin, end - begin);
    begin = end + 1;
    if (!line.starts_with("| `")) continue;
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\') ? 1 : 0;
    EXPECT_TRUE(bars == 5 || bars == 4) << line;  // keys have four columns, quantities three
  }
}

}  // namespace
}  // namespace tessera
