#include "tessera/output/result_folder.hpp"

#include <gtest/gtest.h>

#include "sample.hpp"
#include "tessera/base/error.hpp"

namespace tessera {
namespace {

TEST(ResultFolder, IsMadeWithItsParents) {
  const sample::Folder folder;
  prepare_result_folder(folder.file("a/b"), ExistingResult::refuse);
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("a/b")));
  prepare_result_folder(folder.file("a/b"), ExistingResult::refuse);  // still empty: nothing to lose
}

TEST(ResultFolder, AFullOneIsRefused) {
  const sample::Folder folder;
  folder.write("summary.json", "{}");
  EXPECT_EQ(sample::message_of<UsageError>([&] { prepare_result_folder(folder.path(), ExistingResult::refuse); }),
            folder.path() +
                ": the result folder exists and is not empty; --force replaces the results in it, --resume goes on "
                "from its checkpoint, -o names another folder");
  EXPECT_EQ(folder.read("summary.json"), "{}");
}

TEST(ResultFolder, OverwritingRemovesOnlyResults) {
  const sample::Folder folder;
  for (const char* name : {"summary.json", "history.csv", "case.toml", "checkpoint.h5", "checkpoint.h5.tmp",
                           "fields.pvd", "fields.hdf.series", "fields.csv.series", "cells.pvd", "fields_000000.hdf",
                           "fields_000012.vtu", "fields_1000000.csv", "cells_000003.vtu", "cells_000004.vtu.tmp"})
    folder.write(name, "result");
  const auto foreign = {"notes.txt", "fields_1.hdf", "fields_00000a.hdf", "cells_000000.hdf",
                        "my.toml",   "history.csv~", "summary.json.bak",  "xfields_000000.hdf"};
  for (const char* name : foreign) folder.write(name, "mine");
  std::filesystem::create_directory(folder.file("fields_000001.hdf"));
  prepare_result_folder(folder.path(), ExistingResult::overwrite);
  for (const char* name : foreign) EXPECT_TRUE(folder.has(name)) << name;
  EXPECT_EQ(folder.files(), foreign.size() + 1);
}

TEST(ResultFolder, ResumingNeedsACheckpoint) {
  const sample::Folder folder;
  const std::string message =
      sample::message_of<UsageError>([&] { prepare_result_folder(folder.path(), ExistingResult::resume); });
  EXPECT_EQ(message, folder.path() +
                         ": nothing to resume: no checkpoint.h5 in it (a run that is done leaves one only with "
                         "output.checkpoint); run without --resume");
  EXPECT_THROW(prepare_result_folder(folder.file("missing"), ExistingResult::resume), UsageError);
  EXPECT_FALSE(folder.has("missing"));
  folder.write("checkpoint.h5", "state");
  folder.write("history.csv", "rows");
  prepare_result_folder(folder.path(), ExistingResult::resume);
  EXPECT_EQ(folder.files(), 2u);
}

TEST(ResultFolder, AFileIsNoFolder) {
  const sample::Folder folder;
  folder.write("out", "");
  for (const ExistingResult existing : {ExistingResult::refuse, ExistingResult::overwrite, ExistingResult::resume})
    EXPECT_EQ(sample::message_of<UsageError>([&] { prepare_result_folder(folder.file("out"), existing); }),
              folder.file("out") + ": is a file, not a folder for results; -o names another one");
}

TEST(ResultFolder, WhatCannotBeMadeIsAUsageError) {
  const std::string message =
      sample::message_of<UsageError>([] { prepare_result_folder("/proc/no_such_place/out", ExistingResult::refuse); });
  EXPECT_EQ(message.find("/proc/no_such_place/out: cannot be made the result folder: "), 0u) << message;
}

}  // namespace
}  // namespace tessera
