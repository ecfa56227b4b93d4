#include "tessera/output/frame_index.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "tessera/base/error.hpp"
#include "tessera/output/output_file.hpp"

namespace tessera {

namespace {

/// The text of `line` between `before` and `after`; nothing when either is missing.
std::optional<std::string_view> between(std::string_view line, std::string_view before, std::string_view after) {
  const auto start = line.find(before);
  if (start == std::string_view::npos) return std::nullopt;
  const auto begin = start + before.size();
  const auto end = line.find(after, begin);
  if (end == std::string_view::npos) return std::nullopt;
  return line.substr(begin, end - begin);
}

std::optional<double> number(std::optional<std::string_view> text) {
  double value = 0.0;
  if (!text) return std::nullopt;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size()) return std::nullopt;
  return value;
}

}  // namespace

FrameIndex::FrameIndex(const std::string& directory, const std::string& stem, const std::string& extension,
                       IndexKind kind)
    : directory_(directory), stem_(stem), extension_(extension), kind_(kind) {
  path_ = directory_ + "/" + stem_ + (kind_ == IndexKind::pvd ? ".pvd" : extension_ + ".series");
}

FrameIndex::FrameIndex(const std::string& directory, const std::string& stem, const std::string& extension,
                       IndexKind kind, const ContinueFrom& from)
    : FrameIndex(directory, stem, extension, kind) {
  if (std::filesystem::exists(path_)) {
    read(from);
    replace_file(path_, text());
  }
  remove_unlisted();
}

std::string FrameIndex::next_name() const { return fmt::format("{}_{:06}{}", stem_, frames_.size(), extension_); }

std::string FrameIndex::next_path() const { return directory_ + "/" + next_name(); }

void FrameIndex::add(double time) {
  frames_.push_back({next_name(), time});
  replace_file(path_, text());
}

std::optional<double> FrameIndex::last_time() const {
  return frames_.empty() ? std::nullopt : std::optional<double>(frames_.back().time);
}

void FrameIndex::read(const ContinueFrom& from) {
  const std::string content = content_of_file(path_);
  const bool pvd = kind_ == IndexKind::pvd;
  int line_number = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    const std::string_view line = std::string_view(content).substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    const auto name = between(line, pvd ? "file=\"" : "\"name\": \"", "\"");
    if (!name) continue;
    const auto time = number(pvd ? between(line, "timestep=\"", "\"") : between(line, "\"time\": ", "}"));
    if (!time || *name != next_name())
      throw InputError({path_, line_number, 1, ""}, "not a list of frames as tessera writes it; remove the file");
    if (*time > from.time) return;
    frames_.push_back({std::string(*name), *time});
  }
}

void FrameIndex::remove_unlisted() const {
  // Frames are numbered without gaps, so the first number without a file ends the stale ones.
  std::error_code ignored;
  for (std::size_t i = frames_.size();; ++i)
    if (!std::filesystem::remove(fmt::format("{}/{}_{:06}{}", directory_, stem_, i, extension_), ignored)) return;
}

std::string FrameIndex::text() const {
  const bool pvd = kind_ == IndexKind::pvd;
  std::string text = pvd ? "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
                         : "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
  for (const Frame& frame : frames_) {
    if (pvd)
      text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, frame.name);
    else
      text += fmt::format("    {{\"name\": \"{}\", \"time\": {}}}{}\n", frame.name, frame.time,
                          &frame == &frames_.back() ? "" : ",");
  }
  return text + (pvd ? "</Collection>\n</VTKFile>\n" : "  ]\n}\n");
}

}  // namespace tessera
