// What a pass does at a few texels, and what its numbers are called: which uniform, which input a literal or a texel is.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

/// A case with its model, as the probes ask for it.
struct Probed {
  const capture::PackPass& pass;
  const capture::PassCase& c;
  judge::Bind bind;
  const capture::PassModel& model;
};

/// What one invocation did.
struct Probe {
  Texel at;
  perturbed::Trace trace;
  std::vector<std::string> names;               ///< of each node that is a leaf: "damping", "wave.x", "amplitude of drops", "4"; others ""
  std::vector<std::int32_t> outputs = {};       ///< nodes of what a texel's slots are given; of lists none
  mutable std::vector<std::string> words = {};  ///< of nodes whose words were asked for

  /// What a node computes, in the words of the pass, `depth` operations deep: "damping * (wave.x - wave.y)".
  std::string text(std::int32_t node, int depth = 2) const;

 private:
  bool is_of_column(const perturbed::Trace::Node& n) const;
};

/// The texels of a run that no alternative accepts, row by row.
std::vector<Texel> failing_texels(const judge::CaseJudgement& judgement);
/// At most so many of them, spread evenly.
std::vector<Texel> spread(const std::vector<Texel>& all, std::size_t most);

/// What an invocation does.
perturbed::Trace trace_of(const capture::PassModel& model, Texel at);
/// How often each node of an invocation is used by others.
std::vector<int> uses_of(const perturbed::Trace& trace);

/// Literals and uniforms that a pass meets at 8 x 8 texels, and at how many.
std::map<float, int> constants_met(const capture::PassModel& model);
/// The numbers that a pass is given anywhere: the same at every texel. Sorted.
std::vector<float> constants_everywhere(const capture::PassModel& model);

/// The invocations at some texels. A uniform or an input is found by what changes when its last bit does.
std::vector<Probe> probes_of(const Probed& probed, const std::vector<Texel>& texels, const std::vector<float>& known);

/// The evaluation of all records of a keyed list.
std::vector<Probe> probes_of_list(const Probed& probed, const std::string& list, const std::vector<float>& known);

/// The same invocations, of probes whose leaves have names, with other constants known. `list`: of probes_of_list().
std::vector<Probe> probes_again(const capture::PassModel& model, const std::vector<Probe>& probes, const std::vector<float>& known,
                                const std::string& list = "");

/// A number that is met everywhere.
struct Constant {
  float value;
  std::string name;        ///< "damping", "pixel_scale or up.y", "the literal 4"
  bool is_literal;         ///< the number itself is one of its names
  bool begins_as_literal;  ///< the first of them
  bool is_made;            ///< the first of them is a function of several numbers
  std::string head;        ///< the first word of its name
};
using Constants = std::vector<Constant>;
/// Constants that the probes met and that are `known`; those of records are none.
Constants names_of_constants(const std::vector<Probe>& probes, const std::vector<float>& known);

/// The uniforms, without components, that the probes met.
std::set<std::string> uniforms_met(const std::vector<Probe>& probes, const capture::PackPass& pass);

}  // namespace rainref::faults
