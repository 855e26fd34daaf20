#include "judge/fused.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/path_text.h"
#include "capture/bound_texture.h"
#include "judge/alternatives.h"
#include "judge/check_pack.h"
#include "judge/evaluations.h"
#include "judge/reference_outputs.h"
#include "judge/slots.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Pack, capture::PackCase, capture::PackEdge, capture::PassCase;
using enclosed::Enclosure, enclosed::Uncertain;

bool takes(const PackEdge& edge, const std::string& pass, const std::string& from) {
  return edge.pass == pass && edge.from == from && !edge.previous;
}

/// Everything that an invocation may give for a value, with or without the rounding of its store.
Enclosure everything_given(const Alternatives& all, std::size_t v, const Slot& slot, const enclosed::Profile& profile) {
  if (all.gave_up) return Enclosure::vacuous();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Enclosure out(infinity, -infinity);
  for (int a = 0; a < all.count; ++a) {
    const Enclosure& value = all.values[static_cast<std::size_t>(a)][v];
    const enclosed::CodeRange codes = enclosed::code_range(slot.kind, value, rules_of(profile, HalfMode::either, slot.store_rounding));
    if (value.is_vacuous() || codes.is_vacuous()) return Enclosure::vacuous();
    const auto end_of = [&](std::int64_t code) { return static_cast<float>(enclosed::code_value(slot.kind, code)); };
    out.lo = std::min({out.lo, value.lo, end_of(codes.lo)});
    out.hi = std::max({out.hi, value.hi, end_of(codes.hi)});
  }
  return out;
}

/// Everything that a pass may give for an output, decoded.
std::shared_ptr<const Uncertain> bounds_of(const PassCase& c, std::size_t output, const capture::PassModel& model,
                                           const enclosed::Profile& profile, const parallel::Executor& executor) {
  const capture::Array& array = c.outputs[output].array;
  const std::vector<Slot> slots = slots_of(c, model);
  auto bounds = std::make_shared<Uncertain>();
  bounds->low = bounds->high = capture::decoded(array);  // channels that the pass does not compute
  const auto channels = static_cast<std::size_t>(info(array.format).channels);
  executor.for_range(array.height, 1, [&](std::int64_t begin, std::int64_t end) {
    Alternatives all;
    std::vector<float> stored(slots.size());
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < array.width; ++x) {
        for (std::size_t v = 0; v < slots.size(); ++v)
          stored[v] = stored_value(slots[v], slots[v].at(c.outputs[static_cast<std::size_t>(slots[v].output)].array, x, y));
        all.run(model, x, y, stored.data(), profile);
        for (std::size_t v = 0; v < slots.size(); ++v) {
          if (slots[v].output != static_cast<int>(output)) continue;
          const std::size_t at =
              (static_cast<std::size_t>(y) * static_cast<std::size_t>(array.width) + static_cast<std::size_t>(x)) * channels +
              static_cast<std::size_t>(slots[v].channel);
          const Enclosure given = everything_given(all, v, slots[v], profile);
          bounds->low[at] = std::min(bounds->low[at], given.lo);
          bounds->high[at] = std::max(bounds->high[at], given.hi);
        }
      }
  });
  return bounds;
}

Error needs_files(const PassCase& c, const std::string& from, const char* why) {
  return Error(ExitCode::usage, fmt::format("--fused: {} cannot be judged without the port's own outputs of {}, because {}: expected files "
                                            "of {}, found none",
                                            c.pass, from, why, from));
}

}  // namespace

FusedPasses fused_passes(const std::string& text, const Pack& pack) {
  FusedPasses out;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t to = std::min(text.find('+', from), text.size());
    const std::string pass = text.substr(from, to - from);
    static_cast<void>(pack.pass(pass));
    const auto gives = [&](const std::string& before) {
      return std::any_of(pack.edges.begin(), pack.edges.end(), [&](const PackEdge& e) { return takes(e, pass, before); });
    };
    if (!out.empty() && std::none_of(out.begin(), out.end(), gives))
      throw Error(ExitCode::usage, fmt::format("--fused {}: expected passes of which each takes what one before it gives, found that {} "
                                               "takes nothing of {}",
                                               text, pass, fmt::join(out, ", ")));
    out.push_back(pass);
    from = to + 1;
  }
  if (out.size() < 2)
    throw Error(ExitCode::usage, fmt::format("--fused {}: expected two passes or more, such as ground_noise+shade, found one", text));
  return out;
}

const PackCase* source_of(const Pack& pack, const std::string& id, const std::string& pass) {
  const PackCase* found = nullptr;
  const auto taker = std::find_if(pack.cases.begin(), pack.cases.end(), [&](const PackCase& c) { return c.id == id; });
  if (taker == pack.cases.end()) return nullptr;
  for (auto c = pack.cases.begin(); c != taker; ++c)
    if (c->pass == pass && c->frame == taker->frame) found = &*c;
  return found;
}

std::vector<std::string> FusedInputs::computed_for(const std::string& pass) const {
  std::vector<std::string> out;
  for (const FusedPasses& group : groups_) {
    const auto end = std::find(group.begin(), group.end(), pass);
    if (end == group.end()) continue;
    for (auto before = group.begin(); before != end; ++before)
      if (std::any_of(pack_.edges.begin(), pack_.edges.end(), [&](const PackEdge& e) { return takes(e, pass, *before); }))
        out.push_back(*before);
  }
  return out;
}
std::string FusedInputs::last_of(const std::string& pass) const {
  for (const FusedPasses& group : groups_)
    if (std::find(group.begin(), group.end() - 1, pass) != group.end() - 1) return group.back();
  return "";
}

void FusedInputs::replace(const PackCase& entry, PassCase& c, PortFiles& port) const { replace(entry, c, &port); }
void FusedInputs::widen(const PackCase& entry, PassCase& c) const { replace(entry, c, nullptr); }

void FusedInputs::replace(const PackCase& entry, PassCase& c, PortFiles* port) const {
  bool are_ports_own = false, is_any_uncertain = false;
  for (const std::string& from : computed_for(entry.pass)) {
    const PackCase* const source = source_of(pack_, entry.id, from);
    if (!source) continue;
    const bool is_given = port && port->has_output(source->id);
    PassCase given = read_case(pack_, *source);
    std::unique_ptr<capture::PassModel> model;
    for (const PackEdge& edge : pack_.edges) {
      const auto input = std::find_if(c.inputs.begin(), c.inputs.end(), [&](const auto& i) { return i.name == edge.input; });
      const auto output = std::find_if(given.outputs.begin(), given.outputs.end(), [&](const auto& o) { return o.name == edge.input; });
      if (!takes(edge, entry.pass, from) || input == c.inputs.end() || output == given.outputs.end()) continue;
      if (is_given) {
        port_dump::KeptForm kept;
        input->array = port->read(utf8_path(source->id), "out." + edge.input, output->array, &kept);
        if (kept && kept->widest > 0) throw needs_files(c, from, "their form in port.json rounds what was computed");
        are_ports_own = true;
        continue;
      }
      if (output->judge == capture::Judge::bits) continue;
      if (output->array.is_records) throw needs_files(c, from, "its list may differ");
      output->judge = capture::Judge::envelope;
      if (!model) {
        replace(*source, given, port);
        const Bind bind = binder(pack_, from);
        if (bind) model = bind(given);
        if (!model || model->needs_port()) throw needs_files(c, from, "what it may give is not known without them");
      }
      is_any_uncertain = true;
      input->array.uncertain = bounds_of(given, static_cast<std::size_t>(output - given.outputs.begin()), *model, profile_, executor_);
    }
  }
  if (!are_ports_own && !is_any_uncertain) return;
  const Bind bind = binder(pack_, entry.pass);
  const std::unique_ptr<capture::PassModel> bound = bind ? bind(c) : nullptr;  // throws if it looks up what is uncertain
  if (!are_ports_own || !bound) return;
  const std::vector<capture::Array> expected = reference_outputs(c, *bound, executor_);
  for (std::size_t o = 0; o < c.outputs.size(); ++o) c.outputs[o].array = expected[o];
}

}  // namespace rainref::judge
