#include "tessera/output/field_vtkhdf.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample.hpp"
#include "tessera/output/fields.hpp"
#include "tessera/output/hdf5_image.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

/// Many particles of different values, more than a few chunks' worth.
Snapshot many_particles(std::size_t n, double time) {
  Snapshot s;
  s.time = time;
  for (std::size_t a = 0; a < n; ++a) {
    const double p = static_cast<double>(a);
    const Vec3 X = {std::sin(p), std::cos(2.0 * p), 1e-3 * p};
    s.body.push_back(static_cast<Index>(a / 20000));
    s.material.push_back(static_cast<Index>(a % 2));
    s.reference_position.push_back(X);
    s.position.push_back((1.0 + time) * X);
    s.velocity.push_back({p, -0.1 * p, time / 3.0});
    for (auto* forces : {&s.force, &s.internal_force, &s.contact_force, &s.external_force}) forces->push_back(time * X);
    s.deformation_gradient.push_back(diagonal(1.0 + 1e-9 * p, 1.0 + time, 1.0));
    s.first_piola_kirchhoff.push_back(diagonal(1e6 * X.x, 1e6 * X.y, 0.0));
    s.volume.push_back(0.1 + 1e-6 * p);
    s.mass.push_back(100.0 + p);
    s.energy_density.push_back(p);
    s.plastic_strain.push_back(p);
  }
  return s;
}

class File {
 public:
  explicit File(const std::string& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {}

  std::vector<double> values(const std::string& name) const {
    const Hdf5Id data = open(name);
    const Hdf5Id space(H5Dget_space(data.get()), H5Sclose);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    EXPECT_GE(H5Dread(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    return values;
  }
  std::size_t width(const std::string& name) const {
    const Hdf5Id data = open(name);
    const Hdf5Id type(H5Dget_type(data.get()), H5Tclose);
    return H5Tget_size(type.get());
  }

 private:
  Hdf5Id open(const std::string& name) const {
    return {H5Dopen2(file_.get(), ("/VTKHDF/" + name).c_str(), H5P_DEFAULT), H5Dclose};
  }
  Hdf5Id file_;
};

FieldsSpec all_quantities(FieldPrecision precision) {
  FieldsSpec spec;
  spec.precision = precision;
  for (const Quantity& quantity : quantity_table()) spec.quantities.emplace_back(quantity.name);
  return spec;
}

constexpr std::size_t n = 70001;

TEST(FieldVtkhdf, HoldsEveryValueInDoublePrecision) {
  const sample::Folder folder;
  FieldSeries series(folder.path(), all_quantities(FieldPrecision::full));
  for (const double time : {0.0, 0.5}) {  // the second frame uses constants of the first
    const Snapshot s = many_particles(n, time);
    series.write(s);
    const File file(folder.file(time == 0.0 ? "fields_000000.hdf" : "fields_000001.hdf"));
    for (const Quantity& quantity : quantity_table())
      EXPECT_EQ(file.values("PointData/" + std::string(quantity.name)), evaluate(quantity, s)) << quantity.name;
    EXPECT_EQ(file.values("Points"), evaluate(find_quantity("position", {}), s));
    EXPECT_EQ(file.values("Offsets").size(), n + 1);
    EXPECT_EQ(file.values("Offsets").back(), static_cast<double>(n));
    EXPECT_EQ(file.values("Connectivity"), evaluate(find_quantity("particle_id", {}), s));
    EXPECT_EQ(file.values("Types"), std::vector<double>(n, 1.0));
  }
}

TEST(FieldVtkhdf, MixedPrecisionKeepsWhatMattersBySmallDifferences) {
  const sample::Folder folder;
  const Snapshot s = many_particles(n, 0.5);
  FieldSeries(folder.path(), all_quantities(FieldPrecision::mixed)).write(s);
  const File file(folder.file("fields_000000.hdf"));
  for (const char* name :
       {"position", "reference_position", "deformation_gradient", "J", "volume", "mass", "particle_id"})
    EXPECT_EQ(file.values(std::string("PointData/") + name), evaluate(find_quantity(name, {}), s)) << name;
  EXPECT_EQ(file.width("PointData/J"), 8U);
  for (const char* name : {"displacement", "velocity", "cauchy_stress", "von_mises", "energy_density"}) {
    const std::string path = std::string("PointData/") + name;
    EXPECT_EQ(file.width(path), 4U) << name;
    std::vector<double> expected = evaluate(find_quantity(name, {}), s);
    for (double& value : expected) value = static_cast<double>(static_cast<float>(value));
    EXPECT_EQ(file.values(path), expected) << name;
  }
}

TEST(FieldVtkhdf, FramesThatWaitKeepTheirMemory) {
  const sample::Folder waiting, at_once;
  FieldSeries late(waiting.path(), all_quantities(FieldPrecision::mixed));
  FieldSeries early(at_once.path(), all_quantities(FieldPrecision::mixed));
  const Snapshot first = many_particles(n, 0.25), second = many_particles(n, 0.5), third = many_particles(n, 0.75);
  {
    const std::vector<WriteJob> jobs = {late.take(parts_of(first)), late.take(parts_of(second))};
    for (const WriteJob& job : jobs) job();
  }
  late.write(third);
  for (const Snapshot* s : {&first, &second, &third}) early.write(*s);
  for (const char* name : {"fields_000000.hdf", "fields_000001.hdf", "fields_000002.hdf"})
    EXPECT_TRUE(waiting.read(name) == at_once.read(name)) << name;
}

TEST(FieldVtkhdf, HasTheSameBytesForAnyNumberOfThreads) {
  const int before = parallel::threads();
  const Snapshot s = many_particles(n, 0.5);
  const sample::Folder one, three;
  parallel::set_threads(1);
  FieldSeries(one.path(), all_quantities(FieldPrecision::mixed)).write(s);
  parallel::set_threads(3);
  FieldSeries(three.path(), all_quantities(FieldPrecision::mixed)).write(s);
  parallel::set_threads(before);
  EXPECT_EQ(one.read("fields_000000.hdf"), three.read("fields_000000.hdf"));
}

}  // namespace
}  // namespace tessera
