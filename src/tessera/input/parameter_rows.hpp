#pragma once

#include <vector>

#include "tessera/input/parameter.hpp"

namespace tessera::input {

using Rows = std::vector<Parameter>;

// The rows of the input table, section by section.

/// title and [method].
Rows method_rows();
/// [[body]] and its particles.
Rows body_rows();
/// What shapes are made of.
Rows shape_rows();
/// [[material]].
Rows material_rows();
/// [[initial]], [[boundary]] and [gravity].
Rows load_rows();
/// [time] and [output].
Rows time_rows();
/// [[probe]] and [[reference]].
Rows probe_rows();

inline const char* const body_sentence = "The body that is meant; may be missing when there is only one.";

constexpr Range at_least(double min) { return {.min = min}; }
constexpr Range above(double min) { return {.min = min, .lower = Range::End::open}; }
constexpr Range between(double min, double max) { return {.min = min, .max = max}; }
constexpr Range inside(double min, double max) { return {min, max, Range::End::open, Range::End::open}; }
constexpr Range above_up_to(double min, double max) { return {min, max, Range::End::open, Range::End::closed}; }

}  // namespace tessera::input
