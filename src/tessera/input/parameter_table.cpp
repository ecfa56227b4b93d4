#include "tessera/input/parameter_rows.hpp"

namespace tessera::input {

namespace {

Rows all_rows() {
  Rows all;
  for (const Rows& rows :
       {method_rows(), body_rows(), shape_rows(), material_rows(), load_rows(), time_rows(), probe_rows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace

std::span<const Parameter> parameters() {
  static const Rows rows = all_rows();
  return rows;
}

}  // namespace tessera::input
