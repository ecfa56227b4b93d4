#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "sample.hpp"

namespace tessera {
namespace {

TEST(CaseFile, TruncatedAnywhereIsNeverACrash) {
  for (std::size_t n = 0; n < sample::text.size(); ++n) {
    const std::string what = sample::error_of(sample::text.substr(0, n));
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

// Anything but an InputError would leave error_of() and fail the test.
TEST(CaseFile, WithWrongCharactersIsNeverACrash) {
  const std::string alphabet = "[]{}=\"'.,#\n \\-0e1xX*()\x01\xff";
  std::uint64_t state = 1;
  const auto next = [&state](std::size_t n) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>(state >> 33) % n;
  };
  for (int i = 0; i < 3000; ++i) {
    std::string text = sample::text;
    for (int changes = 0; changes < 3; ++changes) text[next(text.size())] = alphabet[next(alphabet.size())];
    const std::string what = sample::error_of(text);
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

TEST(CaseFile, DeeplyNestedIsNeverACrash) {
  const std::string shape = "{ box = { min = [0, 0, 0], max = [\"1 m\", \"50 cm\", 0.1] } }";
  std::string nested;
  for (int i = 0; i < 5000; ++i) nested += "{ union = [";
  EXPECT_FALSE(sample::error_of(sample::with(shape, nested)).empty());
  EXPECT_FALSE(sample::error_of(sample::with("\"10*X/6\"", "\"" + std::string(50000, '(') + "\"")).empty());
}

TEST(Examples, AreReadWithoutErrors) {
  const std::filesystem::path folder = std::filesystem::path(TESSERA_SOURCE_DIR) / "examples";
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW({
      const CaseFile read = read_case_file(file, {});
      EXPECT_TRUE(read.unused.empty()) << read.unused.front();
    });
  }
}

}  // namespace
}  // namespace tessera
