#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// Goes on with files that an interrupted run left: what belongs to times after `time` [s] is dropped.
struct ContinueFrom {
  double time = 0.0;
};

/// The ways in which a time series is listed for viewers.
enum class IndexKind { series, pvd };

/// The numbered files of one time series, and the index file that gives viewers their times. The index is replaced as
/// a whole after every frame, so a killed run can still be opened.
class FrameIndex {
 public:
  /// A new series: frames DIRECTORY/STEM_000000EXTENSION .., index STEMEXTENSION.series or STEM.pvd.
  FrameIndex(const std::string& directory, const std::string& stem, const std::string& extension, IndexKind kind);
  /// Goes on with a series (a missing index counts as empty); frame files that it no longer lists are removed.
  /// Throws InputError for an index that cannot be read.
  FrameIndex(const std::string& directory, const std::string& stem, const std::string& extension, IndexKind kind,
             const ContinueFrom& from);

  /// Path of the next frame's file.
  std::string next_path() const;
  /// Adds the next frame, whose file is complete, to the index. Throws RunError when the index cannot be written.
  void add(double time);
  /// Number of frames listed.
  std::size_t size() const { return frames_.size(); }
  /// Time of the last frame [s].
  std::optional<double> last_time() const;
  /// Path of the index file.
  const std::string& path() const { return path_; }

 private:
  struct Frame {
    std::string name;
    double time = 0.0;
  };

  std::string next_name() const;
  void read(const ContinueFrom& from);
  void remove_unlisted() const;
  std::string text() const;

  std::string directory_;
  std::string stem_;
  std::string extension_;
  IndexKind kind_;
  std::string path_;
  std::vector<Frame> frames_;
};

}  // namespace tessera
