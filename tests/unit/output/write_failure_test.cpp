#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>

#include "sample.hpp"
#include "tessera/base/error.hpp"
#include "tessera/output/checkpoint.hpp"
#include "tessera/output/fields.hpp"
#include "tessera/output/history.hpp"
#include "tessera/output/output_file.hpp"
#include "tessera/output/summary.hpp"

namespace tessera {
namespace {

/// While it lives, no file can grow beyond `bytes`: what a full disk does.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

Snapshot many_particles() {
  Snapshot s = sample::snapshot();
  for (int i = 0; i < 8; ++i) {
    Snapshot copy = s;
    const auto twice = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    twice(s.body, copy.body), twice(s.material, copy.material), twice(s.volume, copy.volume), twice(s.mass, copy.mass);
    twice(s.reference_position, copy.reference_position), twice(s.position, copy.position);
    twice(s.velocity, copy.velocity), twice(s.force, copy.force);
    twice(s.deformation_gradient, copy.deformation_gradient);
    twice(s.first_piola_kirchhoff, copy.first_piola_kirchhoff);
  }
  for (std::size_t a = 0; a < s.position.size(); ++a) s.position[a].x += std::sin(double(a));  // hard to compress
  return s;
}

void expect_full_disk(const sample::Folder& folder, const std::string& name, const std::function<void()>& action) {
  std::string message;
  {
    const FullDisk full(4096);
    message = sample::message_of<RunError>(action);
  }
  EXPECT_EQ(message, folder.file(name) + ": cannot be written: File too large");
  EXPECT_FALSE(folder.has(name + ".tmp"));
}

TEST(WriteFailure, FieldsOnAFullDisk) {
  const Snapshot s = many_particles();
  for (const auto& [format, name] :
       {std::pair{FieldFormat::vtkhdf, "fields_000000.hdf"}, std::pair{FieldFormat::vtu, "fields_000000.vtu"},
        std::pair{FieldFormat::csv, "fields_000000.csv"}}) {
    const sample::Folder folder;
    FieldsSpec spec;
    spec.format = format;
    FieldSeries series(folder.path(), spec);
    expect_full_disk(folder, name, [&] { series.write(s); });
    EXPECT_EQ(folder.files(), 0u);
    series.write(s);  // room again
    EXPECT_EQ(series.index().size(), 1u);
  }
}

TEST(WriteFailure, PagesPastTheCacheOnAFullDisk) {
  const RawField<char> bytes(5'000'000, 'x');  // large enough to begin at a page
  const std::string_view all(bytes.data(), bytes.size());
  for (const rlim_t room : {rlim_t{0}, rlim_t{1'000'000}, rlim_t{4'997'120}}) {  // within pages, and all but the last
    const sample::Folder folder;
    std::string message;
    {
      const FullDisk full(room);
      message = sample::message_of<RunError>([&] {
        OutputFile file(folder.file("frame"));
        file.write_past_cache(all);
        file.commit(Durability::process);
      });
    }
    EXPECT_EQ(message, folder.file("frame") + ": cannot be written: File too large");
    EXPECT_EQ(folder.files(), 0u);
  }
}

TEST(OutputFile, WritesPastTheCacheWhatCameInBetween) {
  RawField<char> bytes(5'000'001);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 251);
  const std::string_view all(bytes.data(), bytes.size());
  const sample::Folder folder;
  OutputFile file(folder.file("frame"));
  file.write_past_cache(all);
  file.write("and more");
  file.write_past_cache(all);  // does not begin at a page of the file
  file.commit(Durability::process);
  EXPECT_EQ(content_of_file(folder.file("frame")), std::string(all) + "and more" + std::string(all));
}

TEST(WriteFailure, CheckpointOnAFullDiskKeepsTheOneBefore) {
  const sample::Folder folder;
  Checkpoint c;
  c.integers["step"] = {1};
  write_checkpoint(folder.file("checkpoint.h5"), c);
  c.integers["step"] = {2};
  c.arrays["x"].resize(10000, 1.5);
  expect_full_disk(folder, "checkpoint.h5", [&] { write_checkpoint(folder.file("checkpoint.h5"), c); });
  EXPECT_EQ(read_checkpoint(folder.file("checkpoint.h5")).integer("step")[0], 1);
}

TEST(WriteFailure, HistoryOnAFullDisk) {
  const sample::Folder folder;
  History history(folder.file("history.csv"), {{"t", "s"}});
  expect_full_disk(folder, "history.csv", [&] {
    for (int i = 0; i < 2000; ++i) history.append(std::vector<double>{0.1 * i});
  });
}

TEST(WriteFailure, SummaryOnAFullDisk) {
  const sample::Folder folder;
  Summary summary;
  summary.message = std::string(10000, 'x');
  expect_full_disk(folder, "summary.json", [&] { write_summary(folder.file("summary.json"), summary); });
}

TEST(WriteFailure, AFolderThatIsNotThere) {
  const sample::Folder folder;
  const std::string reason = ": cannot be written: No such file or directory";
  EXPECT_EQ(sample::message_of<RunError>([&] { replace_file(folder.file("no/file"), "text"); }),
            folder.file("no/file") + reason);
  EXPECT_EQ(sample::message_of<RunError>([&] { write_checkpoint(folder.file("no/checkpoint.h5"), {}); }),
            folder.file("no/checkpoint.h5") + reason);
  EXPECT_EQ(sample::message_of<RunError>([&] {
              History(folder.file("no/history.csv"), {{"t", "s"}});
            }),
            folder.file("no/history.csv") + reason);
  EXPECT_EQ(sample::message_of<RunError>([&] { FieldSeries(folder.file("no"), {}).write(sample::snapshot()); }),
            folder.file("no/fields_000000.hdf") + reason);
}

TEST(WriteFailure, AFileThatIsAFolder) {
  const sample::Folder folder;
  std::filesystem::create_directory(folder.file("summary.json"));
  EXPECT_EQ(sample::message_of<RunError>([&] { write_summary(folder.file("summary.json"), {}); }),
            folder.file("summary.json") + ": cannot be written: Is a directory");
  EXPECT_FALSE(folder.has("summary.json.tmp"));
}

}  // namespace
}  // namespace tessera
