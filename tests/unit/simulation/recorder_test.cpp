#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "sample.hpp"
#include "tessera/base/error.hpp"
#include "tessera/simulation/run.hpp"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

class FramesInTheBackground : public testing::Test {
 protected:
  FramesInTheBackground() { fs::create_directories(root_); }
  ~FramesInTheBackground() override { fs::remove_all(root_); }

  std::string folder(const std::string& name) const { return (root_ / name).string(); }

  /// A frame at each of ten steps.
  static Case frequent_frames() {
    Case c = cube_case(Method::consistent);
    c.initial = {initial_velocity(formulas("Y", "0", "0"))};
    c.time.step = FixedStep{1e-4};
    c.time.end = 1e-3;
    c.output.fields.every = 1e-4;
    return c;
  }

  static std::string content(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  static std::size_t frames(const std::string& directory) {
    return nlohmann::json::parse(content(directory + "/fields.hdf.series"))["files"].size();
  }

 private:
  fs::path root_ = fs::temp_directory_path() / ("tessera_frames_" + std::to_string(::getpid()));
};

TEST_F(FramesInTheBackground, AreAllThereAtTheEnd) {
  run_case(frequent_frames(), {.directory = folder("whole"), .quiet = true});
  EXPECT_EQ(frames(folder("whole")), 11U);
}

TEST_F(FramesInTheBackground, ThatCannotBeWrittenFailTheRun) {
  run_case(frequent_frames(), {.directory = folder("whole"), .quiet = true});
  const std::string broken = folder("broken"), obstacle = broken + "/fields_000004.hdf";
  fs::create_directories(obstacle);  // a folder where a file should be
  try {
    run_case(frequent_frames(), {.directory = broken, .overwrite = true, .quiet = true});
    FAIL() << "the run did not notice";
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()), obstacle + ": cannot be written: Is a directory");
  }
  EXPECT_EQ(frames(broken), 4U);
  EXPECT_FALSE(fs::exists(obstacle + ".tmp"));
  EXPECT_FALSE(fs::exists(broken + "/fields_000005.hdf"));
  EXPECT_EQ(nlohmann::json::parse(content(broken + "/summary.json"))["status"], "failed");

  fs::remove(obstacle);
  run_case(frequent_frames(), {.directory = broken, .resume = true, .quiet = true});
  EXPECT_EQ(frames(broken), 11U);
  for (int i = 0; i < 11; ++i) {
    const std::string name = "/fields_" + std::string(i < 10 ? "00000" : "0000") + std::to_string(i) + ".hdf";
    EXPECT_TRUE(content(broken + name) == content(folder("whole") + name)) << name;
  }
}

}  // namespace
}  // namespace tessera::test
