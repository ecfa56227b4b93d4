#include "tessera/loads/selected.hpp"

#include <fmt/format.h>

namespace tessera {

std::string place(const Vec3& X) { return fmt::format("({:g}, {:g}, {:g})", X.x, X.y, X.z); }

void report_conflict(const BoundaryCondition& later, const BoundaryCondition& earlier, const char* what,
                     const Vec3& X) {
  throw InputError(later.origin,
                   fmt::format("constrains the same component of the {} at {} as the [[boundary]] entry at line {}; "
                               "let their `where` exclude each other or leave the component \"free\" in one",
                               what, place(X), earlier.origin.line));
}

void report_nothing(const BoundaryCondition& c, const Surface& surface, const char* what) {
  const std::string names = fmt::format("{}", fmt::join(surface.known_names, ", "));
  throw InputError(c.where.origin, fmt::format("takes no {} of body \"{}\", which reaches from {} to {}{}", what,
                                               surface.body, place(surface.lower), place(surface.upper),
                                               names.empty() ? std::string() : "; its sides are " + names));
}

Selection selection_of(const BoundaryCondition& c, const Surface& surface) {
  return Selection(c.where, surface.known_names, surface.lower, surface.upper);
}

}  // namespace tessera
