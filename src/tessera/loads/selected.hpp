#pragma once

#include "tessera/geometry/selection.hpp"
#include "tessera/loads/boundary_condition.hpp"
#include "tessera/loads/surface.hpp"

namespace tessera {

/// The selection of an entry on a body's surface.
Selection selection_of(const BoundaryCondition& c, const Surface& surface);

/// Throws InputError: `later` constrains a component of the face or particle (`what`) at X that `earlier` constrains.
[[noreturn]] void report_conflict(const BoundaryCondition& later, const BoundaryCondition& earlier, const char* what,
                                  const Vec3& X);

/// Throws InputError: the entry's selection takes no face or particle (`what`) of the body.
[[noreturn]] void report_nothing(const BoundaryCondition& c, const Surface& surface, const char* what);

/// "(1, 2, 3)"
std::string place(const Vec3& X);

}  // namespace tessera
