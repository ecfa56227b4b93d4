#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_helpers.hpp"
#include "tessera/geometry/gmsh.hpp"
#include "tessera/geometry/mesh_file.hpp"
#include "tessera/tessellation/mesh_check.hpp"
#include "tessera/tessellation/vtu.hpp"

namespace tessera::test {
namespace {

enum class Outcome { read, refused };

/// Reads and checks; anything but a mesh or a GeometryError fails the test.
Outcome outcome(const std::string& name, const std::string& bytes) {
  try {
    checked_mesh(name.ends_with(".msh") ? read_gmsh(name, bytes) : read_vtu(name, bytes));
    return Outcome::read;
  } catch (const GeometryError&) {
    return Outcome::refused;
  }
}

class DamagedFile : public testing::TestWithParam<const char*> {
 protected:
  std::string bytes_ = read_whole_file(data_path(GetParam()));
};

/// The length beyond which nothing that is needed is lost.
std::size_t needed_length(const std::string& name, const std::string& bytes) {
  const char* last = name.ends_with(".msh")                             ? "$EndElements"
                     : bytes.find("<AppendedData") != std::string::npos ? "</AppendedData>"
                                                                        : "</VTKFile>";
  const std::size_t end = bytes.rfind(last);
  return name.ends_with(".msh") ? end + 12 : bytes.find_last_not_of(" \n", end - 1) + 1;
}

TEST_P(DamagedFile, CutAnywhereIsRefused) {
  ASSERT_EQ(outcome(GetParam(), bytes_), Outcome::read);
  const std::size_t needed = needed_length(GetParam(), bytes_);
  for (std::size_t length = 1; length < needed; ++length)
    ASSERT_EQ(outcome(GetParam(), bytes_.substr(0, length)), Outcome::refused) << "cut to " << length << " bytes";
}

TEST_P(DamagedFile, ChangedBytesNeverCrash) {
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bytes_.size(); ++i)
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string damaged = bytes_;
      damaged[i] = static_cast<char>(damaged[i] ^ change);
      if (outcome(GetParam(), damaged) == Outcome::refused) ++refused;
    }
  EXPECT_GT(refused, bytes_.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFile,
                         testing::Values("bar_22_ascii.msh", "bar_22_binary.msh", "bar_41_ascii.msh",
                                         "bar_41_binary.msh", "bar_ascii_32.vtu", "bar_binary_64.vtu",
                                         "bar_binary_zlib_32.vtu", "bar_appended_32.vtu", "bar_appended_zlib_64.vtu",
                                         "bar_appendedraw_64.vtu", "bar_appendedraw_zlib_32.vtu"),
                         [](const auto& instance) {
                           return std::string(instance.param).substr(0, std::string(instance.param).find('.'));
                         });

}  // namespace
}  // namespace tessera::test
