#include "truth/parameters.h"

#include <algorithm>

#include <fmt/format.h>

#include "scene/variant_names.h"

namespace rainref::truth {
namespace {

scene::Parameter samples_parameter() {
  scene::Parameter p = scene::integer("compositor.samples", "1", sample_counts.front(), sample_counts.back(), 1, "Traced rays of a pixel.");
  for (const int count : sample_counts) p.choices.push_back(fmt::format("{}", count));
  return p;
}

}  // namespace

std::vector<scene::Parameter> parameters() {
  using scene::correct;
  return {
      scene::choice("compositor.picture", {"passes", "traced"}, "passes", "What is shown: the passes' picture, or one that is traced.")
          .only(correct),
      samples_parameter().only(correct),
      scene::integer("compositor.depth", "1", 1, 64, 8, "Surfaces that a traced ray may meet one after the other.").only(correct),
      scene::text("compositor.embree_config", "", "Configuration of Embree, such as isa=sse2; it changes no bit.").only(correct),
  };
}

scene::Parameter pane_thickness() {
  return scene::real("compositor.glass_thickness", "m", 1e-5, 0.1, 5e-3, "Thickness of the pane that rays go through.");
}

std::vector<scene::Parameter> pane_parameters() {
  std::vector<scene::Parameter> all = parameters();
  all.push_back(pane_thickness().only("corrected"));
  return all;
}

Choice choice_from(const scene::Config& config) {
  Choice c;
  const auto& entries = config.entries();
  const auto declared = [](const scene::Config::Entry& e) { return e.parameter.key == "compositor.picture"; };
  if (std::none_of(entries.begin(), entries.end(), declared)) return c;
  c.is_traced = config.text("compositor.picture") == "traced";
  c.picture.samples = static_cast<int>(config.integer("compositor.samples"));
  c.picture.shading.depth = static_cast<int>(config.integer("compositor.depth"));
  c.tracer.embree_config = config.text("compositor.embree_config");
  return c;
}

}  // namespace rainref::truth
