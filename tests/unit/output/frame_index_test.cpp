#include "tessera/output/frame_index.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sample.hpp"
#include "tessera/base/error.hpp"

namespace tessera {
namespace {

void add_frame(FrameIndex& index, double time) {
  std::ofstream(index.next_path()) << "frame";
  index.add(time);
}

FrameIndex four_frames(const sample::Folder& folder, IndexKind kind) {
  FrameIndex index(folder.path(), "fields", kind == IndexKind::pvd ? ".vtu" : ".hdf", kind);
  for (const double time : {0.0, 0.1, 0.2, 1.0 / 3.0}) add_frame(index, time);
  return index;
}

TEST(FrameIndex, SeriesIsJsonWithNamesAndExactTimes) {
  const sample::Folder folder;
  four_frames(folder, IndexKind::series);
  const auto json = nlohmann::json::parse(folder.read("fields.hdf.series"));
  EXPECT_EQ(json["file-series-version"], "1.0");
  ASSERT_EQ(json["files"].size(), 4u);
  EXPECT_EQ(json["files"][3]["name"], "fields_000003.hdf");
  EXPECT_EQ(json["files"][3]["time"].get<double>(), 1.0 / 3.0);
  EXPECT_FALSE(folder.has("fields.hdf.series.tmp"));
}

TEST(FrameIndex, PvdListsDataSets) {
  const sample::Folder folder;
  four_frames(folder, IndexKind::pvd);
  const std::string text = folder.read("fields.pvd");
  EXPECT_NE(text.find("<DataSet timestep=\"0.1\" part=\"0\" file=\"fields_000001.vtu\"/>"), std::string::npos) << text;
  EXPECT_NE(text.find("</Collection>\n</VTKFile>"), std::string::npos);
}

TEST(FrameIndex, GoingOnDropsLaterFramesAndTheirFiles) {
  for (const IndexKind kind : {IndexKind::series, IndexKind::pvd}) {
    const sample::Folder folder;
    const std::string extension = kind == IndexKind::pvd ? ".vtu" : ".hdf";
    const std::string name = four_frames(folder, kind).path();
    FrameIndex index(folder.path(), "fields", extension, kind, ContinueFrom{0.2});
    EXPECT_EQ(index.size(), 3u);
    EXPECT_EQ(index.last_time(), 0.2);
    EXPECT_TRUE(folder.has("fields_000002" + extension));
    EXPECT_FALSE(folder.has("fields_000003" + extension));
    EXPECT_EQ(index.next_path(), folder.file("fields_000003" + extension));
    add_frame(index, 0.25);
    FrameIndex again(folder.path(), "fields", extension, kind, ContinueFrom{1.0});
    EXPECT_EQ(again.size(), 4u);
    EXPECT_EQ(again.last_time(), 0.25);
  }
}

TEST(FrameIndex, GoingOnWithoutAnIndexBeginsAnew) {
  const sample::Folder folder;
  folder.write("fields_000000.hdf", "left over");
  const FrameIndex index(folder.path(), "fields", ".hdf", IndexKind::series, ContinueFrom{1.0});
  EXPECT_EQ(index.size(), 0u);
  EXPECT_FALSE(index.last_time());
  EXPECT_FALSE(folder.has("fields_000000.hdf"));
}

TEST(FrameIndex, AForeignIndexIsAnErrorWithItsLine) {
  const sample::Folder folder;
  folder.write("fields.hdf.series", "{\n  \"files\": [\n    {\"name\": \"other.hdf\", \"time\": 0}\n]}\n");
  const std::string message = sample::message_of<InputError>(
      [&] { FrameIndex(folder.path(), "fields", ".hdf", IndexKind::series, ContinueFrom{1.0}); });
  EXPECT_EQ(message,
            folder.file("fields.hdf.series") + ":3:1: not a list of frames as tessera writes it; remove the file");
}

}  // namespace
}  // namespace tessera
