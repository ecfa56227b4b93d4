#include "tessera/output/quality.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

std::string named(const PlacedParticle& p) {
  return fmt::format("particle {} of body \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m", p.particle, p.body, p.X.x, p.X.y,
                     p.X.z);
}

std::string warning(const Quality& q) {
  if (q.few == 0) return {};
  return fmt::format(
      "{} {} the time step of all others; move or leave {} out, use less jitter or arrangement = "
      "\"relaxed\", or, for slow loading, time.mass_scaling",
      q.few, q.few == 1 ? "particle shortens" : "particles shorten", q.few == 1 ? "it" : "them");
}

nlohmann::ordered_json place(const PlacedParticle& p) {
  return {{"body", p.body}, {"particle", p.particle}, {"position", {p.X.x, p.X.y, p.X.z}}};
}

}  // namespace

std::string to_text(const Quality& q) {
  std::string text = fmt::format(
      "cells            volumes {:.4g} to {:.4g}, mean {:.4g} m3; faces {} to {}, mean {:.3g}\n"
      "                 shortest bonds {:.4g}, typical {:.4g} m: {}\n",
      q.smallest_volume, q.largest_volume, q.mean_volume, q.fewest_faces, q.most_faces, q.mean_faces, q.shortest_bond,
      q.typical_bond, named(q.at_shortest_bond));
  text += "shortest steps   of single particles, in shares of the typical one\n";
  for (const Quality::Step& s : q.shortest_steps) text += fmt::format("  {:<14.2f} {}\n", s.share, named(s.at));
  if (q.few > 0) text += "warning: " + warning(q) + "\n";
  return text;
}

nlohmann::ordered_json to_json(const Quality& q) {
  nlohmann::ordered_json j;
  j["volume"] = {{"min", q.smallest_volume}, {"mean", q.mean_volume}, {"max", q.largest_volume}};
  j["faces"] = {{"min", q.fewest_faces}, {"mean", q.mean_faces}, {"max", q.most_faces}};
  j["shortest_bond"] = place(q.at_shortest_bond);
  j["shortest_bond"]["length"] = q.shortest_bond;
  j["shortest_bond"]["typical"] = q.typical_bond;
  j["shortest_steps"] = nlohmann::ordered_json::array();
  for (const Quality::Step& s : q.shortest_steps) {
    nlohmann::ordered_json step = place(s.at);
    step["share"] = s.share;
    j["shortest_steps"].push_back(step);
  }
  j["few"] = q.few;
  if (q.few > 0) j["warning"] = warning(q);
  return j;
}

}  // namespace tessera
