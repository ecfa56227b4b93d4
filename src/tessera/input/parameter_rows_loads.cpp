#include "tessera/input/parameter_rows.hpp"

namespace tessera::input {

using enum Kind;
using enum Presence;

Rows load_rows() {
  return {
      {.key = "initial", .kind = tables, .sentence = "State of a body at t = 0."},
      {.key = "initial.body", .kind = name, .sentence = body_sentence},
      {.key = "initial.displacement",
       .kind = formulas,
       .presence = defaulted,
       .dimension = dimension::length,
       .standard = "[0, 0, 0]",
       .flat = "0",
       .sentence = "Displacement at t = 0."},
      {.key = "initial.velocity",
       .kind = formulas,
       .presence = defaulted,
       .dimension = dimension::velocity,
       .standard = "[0, 0, 0]",
       .flat = "0",
       .sentence = "Velocity at t = 0."},
      {.key = "boundary",
       .kind = tables,
       .exactly_one = {"condition", "displacement", "velocity", "traction", "pressure"},
       .sentence = "What happens on a part of a body's boundary. Parts that no entry takes are free."},
      {.key = "boundary.body", .kind = name, .sentence = body_sentence},
      {.key = "boundary.where",
       .kind = selection,
       .presence = required,
       .sentence = "The part: a side name like \"-x\", a list of names, or a formula in X, Y, Z such as "
                   "\"y == max && X > 1/3\"."},
      {.key = "boundary.condition",
       .kind = choice,
       .choices = {"fixed", "symmetric", "antisymmetric", "free"},
       .sentence = "No motion; none along the normal; none in the face's plane; no constraint [V 14]."},
      {.key = "boundary.displacement",
       .kind = partial_formulas,
       .dimension = dimension::length,
       .flat = "\"free\"",
       .sentence = "Prescribed displacement."},
      {.key = "boundary.velocity",
       .kind = partial_formulas,
       .dimension = dimension::velocity,
       .flat = "\"free\"",
       .sentence = "Prescribed velocity, integrated from the initial displacement."},
      {.key = "boundary.traction",
       .kind = formulas,
       .dimension = dimension::pressure,
       .flat = "0",
       .sentence = "Force per reference area, fixed in direction."},
      {.key = "boundary.pressure",
       .kind = formula,
       .dimension = dimension::pressure,
       .sentence = "Pressure against the reference normal, per reference area."},
      {.key = "gravity", .kind = table, .presence = defaulted, .sentence = "A force on all mass."},
      {.key = "gravity.acceleration",
       .kind = vector,
       .presence = defaulted,
       .dimension = dimension::acceleration,
       .standard = "[0, 0, 0]",
       .flat = "0",
       .sentence = "Acceleration of free fall."},
  };
}

}  // namespace tessera::input
