#include "tessera/output/checkpoint.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "sample.hpp"
#include "tessera/base/error.hpp"
#include "tessera/output/fields.hpp"
#include "tessera/output/hdf5_image.hpp"

// The HDF5 library loses memory when it gives up on a damaged file; leaks of our own still count.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace tessera {
namespace {

Checkpoint example() {
  Checkpoint c;
  c.arrays["position"].resize(100000);
  for (std::size_t i = 0; i < c.arrays["position"].size(); ++i) c.arrays["position"][i] = std::sin(double(i));
  c.arrays["empty"] = {};
  c.arrays["special"] = {-0.0, std::numeric_limits<double>::infinity(), 5e-324, std::nan("")};
  c.integers["step"] = {std::numeric_limits<std::int64_t>::max(), -1};
  c.texts["case"] = "title = \"Fläche\"\n[method]\n";
  c.texts["nothing"] = "";
  return c;
}

std::string reading(const sample::Folder& folder) {
  return sample::message_of<InputError>([&] { read_checkpoint(folder.file("checkpoint.h5")); });
}

TEST(Checkpoint, ComesBackBitByBit) {
  const sample::Folder folder;
  const Checkpoint written = example();
  write_checkpoint(folder.file("checkpoint.h5"), written);
  const Checkpoint read = read_checkpoint(folder.file("checkpoint.h5"));
  EXPECT_EQ(folder.files(), 1u);
  ASSERT_EQ(read.arrays.size(), written.arrays.size());
  for (const auto& [name, values] : written.arrays) {
    ASSERT_EQ(read.array(name).size(), values.size()) << name;
    const bool same =
        values.empty() || std::memcmp(read.array(name).data(), values.data(), values.size() * sizeof(double)) == 0;
    EXPECT_TRUE(same) << name;
  }
  EXPECT_EQ(read.integers, written.integers);
  EXPECT_EQ(read.texts, written.texts);
  EXPECT_EQ(read.source, folder.file("checkpoint.h5"));
}

TEST(Checkpoint, ReplacesTheOneBefore) {
  const sample::Folder folder;
  write_checkpoint(folder.file("checkpoint.h5"), example());
  Checkpoint second;
  second.integers["step"] = {7};
  write_checkpoint(folder.file("checkpoint.h5"), second);
  EXPECT_EQ(read_checkpoint(folder.file("checkpoint.h5")).integer("step", 1)[0], 7);
  EXPECT_TRUE(read_checkpoint(folder.file("checkpoint.h5")).arrays.empty());
}

TEST(Checkpoint, MissingEntriesAndWrongSizesNameFileAndEntry) {
  const sample::Folder folder;
  write_checkpoint(folder.file("checkpoint.h5"), example());
  const Checkpoint c = read_checkpoint(folder.file("checkpoint.h5"));
  const std::string place = folder.file("checkpoint.h5") + ": ";
  EXPECT_EQ(sample::message_of<InputError>([&] { c.array("velocity"); }),
            place + "the checkpoint has no entry \"velocity\"; it belongs to another version or case");
  EXPECT_EQ(sample::message_of<InputError>([&] { c.array("special", 3); }),
            place + "entry \"special\" of the checkpoint has 4 values instead of 3; it belongs to another case");
  EXPECT_THROW(c.integer("position"), InputError);
  EXPECT_THROW(c.text("step"), InputError);
}

TEST(Checkpoint, UnreadableFilesAreErrorsThatNameThem) {
  const sample::Folder folder;
  const std::string place = folder.file("checkpoint.h5") + ": ";
  EXPECT_EQ(reading(folder), place + "cannot be read: No such file or directory");
  folder.write("checkpoint.h5", "");
  EXPECT_EQ(reading(folder), place + "is not a checkpoint: no HDF5 file");
  folder.write("checkpoint.h5", "t[s],kinetic[J]\n0,1\n");
  EXPECT_EQ(reading(folder), place + "is not a checkpoint: no HDF5 file");
}

TEST(Checkpoint, TruncatedFilesAreErrors) {
  const sample::Folder folder;
  write_checkpoint(folder.file("checkpoint.h5"), example());
  const std::string whole = folder.read("checkpoint.h5");
  for (const double part : {0.001, 0.1, 0.5, 0.99, 1.0 - 1e-6}) {
    folder.write("checkpoint.h5", whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    EXPECT_EQ(reading(folder), folder.file("checkpoint.h5") +
                                   ": the checkpoint is truncated or damaged; go on from another one or start the "
                                   "run again")
        << part;
  }
}

TEST(Checkpoint, ChangedBytesNeverPassUnnoticed) {
  const sample::Folder folder;
  Checkpoint small;
  small.arrays["x"] = {1.0, 2.0, 3.0};
  small.integers["step"] = {42};
  write_checkpoint(folder.file("checkpoint.h5"), small);
  const std::string whole = folder.read("checkpoint.h5");
  int unnoticed = 0, changed = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    folder.write("checkpoint.h5", damaged);
    try {
      const Checkpoint read = read_checkpoint(folder.file("checkpoint.h5"));
      ++unnoticed;
      if (read.arrays != small.arrays || read.integers != small.integers) ++changed;
    } catch (const InputError&) {
    }
  }
  EXPECT_EQ(changed, 0);
  EXPECT_LT(unnoticed, static_cast<int>(whole.size()));
}

TEST(Checkpoint, OtherHdf5FilesAreRefused) {
  const sample::Folder folder;
  FieldSeries(folder.path(), {}).write(sample::snapshot());
  EXPECT_EQ(sample::message_of<InputError>([&] { read_checkpoint(folder.file("fields_000000.hdf")); }),
            folder.file("fields_000000.hdf") + ": is not a checkpoint of tessera");
}

TEST(Checkpoint, OtherVersionsAreRefused) {
  const sample::Folder folder;
  ImageMemory memory;
  Hdf5Image file(Hdf5Storage::plain, memory);
  file.attribute("/", "tessera_checkpoint", std::array<std::int64_t, 1>{2});
  file.save(folder.file("checkpoint.h5"), Durability::process);
  EXPECT_EQ(reading(folder),
            folder.file("checkpoint.h5") + ": is a checkpoint of format 2, this program reads format 1");
}

TEST(Checkpoint, NamesThatHdf5WouldTakeApartAreRefused) {
  const sample::Folder folder;
  for (const char* name : {"a/b", "", "."}) {
    Checkpoint c;
    c.arrays[name] = {1.0};
    EXPECT_EQ(sample::message_of<RunError>([&] { write_checkpoint(folder.file("checkpoint.h5"), c); }),
              folder.file("checkpoint.h5") + ": \"" + name + "\" cannot be the name of an entry");
  }
  EXPECT_EQ(folder.files(), 0u);
}

}  // namespace
}  // namespace tessera
