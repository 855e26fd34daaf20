// Traces a pass at a few texels and names its numbers: which uniform or input a literal or texel is.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

/// A case with its model, for probes.
struct Probed {
  const capture::PackPass& pass;
  const capture::PassCase& c;
  judge::Bind bind;
  const capture::PassModel& model;
};

/// Trace of one invocation.
struct Probe {
  Texel at;
  perturbed::Trace trace;
  std::vector<std::string> names;               ///< name of each leaf: "damping", "wave.x", "amplitude of drops", "4"; "" for other nodes
  std::vector<std::int32_t> outputs = {};       ///< nodes of the values for a texel's slots; empty for lists
  mutable std::vector<std::string> words = {};  ///< cached texts of nodes

  /// The expression of a node, `depth` operations deep, in the terms of the pass: "damping * (wave.x - wave.y)".
  std::string text(std::int32_t node, int depth = 2) const;

 private:
  bool is_of_column(const perturbed::Trace::Node& n) const;
};

/// The texels of a run that no alternative accepts, row by row.
std::vector<Texel> failing_texels(const judge::CaseJudgement& judgement);
/// At most `most` of them, spread evenly.
std::vector<Texel> spread(const std::vector<Texel>& all, std::size_t most);

/// Traces an invocation.
perturbed::Trace trace_of(const capture::PassModel& model, Texel at);
/// Number of uses of each node of an invocation.
std::vector<int> uses_of(const perturbed::Trace& trace);

/// Literals and uniforms that a pass uses at 8 x 8 texels, with the number of texels.
std::map<float, int> constants_met(const capture::PassModel& model);
/// Numbers that are the same at every texel of the pass. Sorted.
std::vector<float> constants_everywhere(const capture::PassModel& model);

/// Traces some texels. Identifies a uniform or input by what changes if its last bit changes.
std::vector<Probe> probes_of(const Probed& probed, const std::vector<Texel>& texels, const std::vector<float>& known);

/// Traces the evaluation of all records of a keyed list.
std::vector<Probe> probes_of_list(const Probed& probed, const std::string& list, const std::vector<float>& known);

/// Traces the same invocations again with other known constants; `probes` have named leaves. `list`: of probes_of_list().
std::vector<Probe> probes_again(const capture::PassModel& model, const std::vector<Probe>& probes, const std::vector<float>& known,
                                const std::string& list = "");

/// A number that every invocation uses.
struct Constant {
  float value;
  std::string name;        ///< "damping", "pixel_scale or up.y", "the literal 4"
  bool is_literal;         ///< one of its names is the number itself
  bool begins_as_literal;  ///< its first name is the number itself
  bool is_made;            ///< its first name is a function of several numbers
  std::string head;        ///< the first word of its name
};
using Constants = std::vector<Constant>;
/// Constants that the probes met and that are `known`, without those of records.
Constants names_of_constants(const std::vector<Probe>& probes, const std::vector<float>& known);

/// The uniforms, without components, that the probes met.
std::set<std::string> uniforms_met(const std::vector<Probe>& probes, const capture::PackPass& pass);

}  // namespace rainref::faults
