#include <fmt/format.h>

#include "tessera/base/text.hpp"
#include "tessera/base/units.hpp"
#include "tessera/input/build_parts.hpp"
#include "tessera/input/names.hpp"
#include "tessera/output/quantities.hpp"

namespace tessera::input {

namespace {

FieldsSpec build_fields(const Reader& t) {
  FieldsSpec fields;
  if (t.text("format") == "vtu") fields.format = FieldFormat::vtu;
  if (t.text("format") == "csv") fields.format = FieldFormat::csv;
  if (t.has("precision") && t.text("precision") == "double") fields.precision = FieldPrecision::full;
  fields.every = t.optional_number("every");
  fields.quantities = t.words("quantities");
  fields.cells = t.flag("cells");
  fields.origin = t.origin_of("quantities");
  for (const Value& name : *t.value("quantities").get_if<Array>())
    find_quantity(*name.get_if<std::string>(), name.origin);
  return fields;
}

// A wall-clock interval is the only one that is still a text, "60 s wall".
CheckpointSpec build_checkpoint(const Reader& t) {
  CheckpointSpec checkpoint;
  if (!t.has("every")) return checkpoint;
  if (t.value("every").get_if<std::string>() == nullptr) {
    checkpoint.every_time = t.number("every");
  } else {
    const std::string& text = t.text("every");
    checkpoint.every_wall = read_quantity(text.substr(0, text.rfind(' '))).quantity->value;
  }
  return checkpoint;
}

ProbeKind build_kind(const std::string& name) {
  if (name == "point") return ProbeKind::point;
  if (name == "average") return ProbeKind::average;
  if (name == "maximum") return ProbeKind::maximum;
  if (name == "momentum") return ProbeKind::momentum;
  if (name == "energy") return ProbeKind::energy;
  return ProbeKind::reaction;
}

}  // namespace

OutputSpec build_output(const Reader& t) {
  OutputSpec output;
  output.fields = build_fields(t.table("fields"));
  output.history.every = t.table("history").optional_number("every");
  output.checkpoint = build_checkpoint(t.table("checkpoint"));
  return output;
}

ProbeSpec build_probe(const Reader& t, const std::vector<std::string>& bodies) {
  ProbeSpec probe;
  probe.name = t.text("name");
  probe.kind = build_kind(t.text("type"));
  probe.origin = t.origin();
  // Momentum and energy are those of everything unless a body is named.
  const bool of_everything = probe.kind == ProbeKind::momentum || probe.kind == ProbeKind::energy;
  if (!of_everything || t.has("body")) probe.body = body_of(t, bodies);
  if (t.has("where")) probe.where = t.selection("where");
  if (t.has("at")) probe.at = t.vector("at");
  if (t.has("about")) probe.about = t.vector("about");
  probe.quantity = t.text_or_empty("quantity");
  if (t.has("quantity")) find_quantity(probe.quantity, t.origin_of("quantity"));
  if (probe.kind == ProbeKind::reaction && !probe.where) {
    Origin origin = t.origin();
    origin.key += ".where";
    throw InputError(origin, "missing; a reaction needs the faces or particles on which it acts, as in \"-x\"");
  }
  return probe;
}

}  // namespace tessera::input
