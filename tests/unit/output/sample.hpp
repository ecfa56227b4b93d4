#pragma once

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tessera/output/snapshot.hpp"

namespace tessera::sample {

/// F of every sample, J = 1.3 * 1.1 * 0.9 - 0.2 * 0.1 * 0.9.
inline const Mat3 F = {{1.3, 0.2, 0.0, 0.1, 1.1, 0.0, 0.0, 0.0, 0.9}};
inline const Mat3 stress = {{3e6, 1e6, 0.0, 1e6, -2e6, 5e5, 0.0, 5e5, 4e6}};  // Cauchy [Pa]
inline const Vec3 shift = {0.5, -0.25, 2.0};

/// Eight particles in the middles of the octants of the unit cube, moved by x = F X + shift.
inline Snapshot snapshot(double time = 0.0) {
  Snapshot s;
  s.time = time;
  for (int i = 0; i < 8; ++i) {
    const Vec3 X = {0.25 + 0.5 * (i & 1), 0.25 + 0.5 * (i >> 1 & 1), 0.25 + 0.5 * (i >> 2)};
    s.body.push_back(i / 4);
    s.material.push_back(i % 2);
    s.reference_position.push_back(X);
    s.position.push_back(F * X + shift);
    s.velocity.push_back({1.0 + i, -2.0, 0.5 * i});
    s.force.push_back({10.0 * i, 1.0, 0.0});
    s.internal_force.push_back({7.0 * i, 1.0, 0.0});
    s.contact_force.push_back({2.0 * i, 0.0, 0.0});
    s.external_force.push_back({1.0 * i, 0.0, 0.0});
    s.deformation_gradient.push_back(F);
    s.first_piola_kirchhoff.push_back(stress * cofactor(F));
    s.volume.push_back(0.125);
    s.mass.push_back(100.0 + i);
    s.energy_density.push_back(1000.0 * i);
    s.plastic_strain.push_back(0.01 * i);
  }
  return s;
}

/// A folder of its own that disappears with the object.
class Folder {
 public:
  Folder() {
    static std::atomic<int> made = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("tessera_test_" + std::to_string(::getpid()) + "_" + std::to_string(made++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }
  std::string read(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
  }

 private:
  std::filesystem::path path_;
};

/// The message of the error of type E that `action` throws; "nothing thrown" or the other error otherwise.
template <class E, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another kind of error: ") + error.what();
  }
  return "nothing thrown";
}

}  // namespace tessera::sample
