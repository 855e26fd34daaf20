// One mistake at one place of a pass text: a term left out, a sign, a factor twice, a lookup half a texel off.
#pragma once

#include <functional>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// A mistake at a place.
struct Mistake {
  perturbed::PlaceFault fault;
  What what;
};
/// Returns all mistakes at a node of a probe.
std::vector<Mistake> mistakes_at(const Probe& p, std::size_t at);

/// Kinds of mistakes at a place.
enum class PlaceKind {
  plain,    ///< something left out, exchanged, or with another sign
  multiple  ///< a term or factor with another multiplicity: twice, half, squared
};
/// Adds mistakes at each place that the probes met. `known`: the constants that the probes were made with.
void add_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, PlaceKind kind);

/// The same at all places that look equal one or two operations deep and differ below: a function that is called several times is wrong in
/// each call. Edits use these places too.
void add_shared_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known);
/// Places that look equal to this depth and have several shapes, represented by one node; one for each such class.
struct SharedPlace {
  std::size_t probe;  ///< index in the given probes
  std::int32_t node;
  std::int8_t depth;   ///< 1 or 2, or by_sequence
  std::size_t shapes;  ///< number of different shapes
};
/// The shape that identifies the node at that depth.
std::uint32_t shape_of(const perturbed::Trace::Node& n, const SharedPlace& place);
/// Sets the reach of a mistake at one place to all places of the class.
void reach_all(What& what, const SharedPlace& place);
std::vector<SharedPlace> shared_places_of(const std::vector<Probe>& probes);

/// The nodes of one shape, if they differ in the component alone: one for each of two or three components. Else only `at`.
std::vector<std::size_t> components_of(const Probe& p, std::size_t at);
/// Places of vector components: two or three nodes of a probe with equal operation and text but for the component.
std::vector<std::vector<std::size_t>> vectors_of(const Probe& p);
/// The same for all values, including leaves.
std::vector<std::vector<std::size_t>> vector_values_of(const Probe& p);

/// A constant with another value in the port, near `said`.
Fault another_value(Kind kind, const Constant& constant, float said, float replacement);
/// Adds for each constant the value that would give what the port stored at some failing texels, if there is one. `wanted`: texels and what
/// the port stored there, one number for each slot.
struct Wanted {
  Texel at;                                  ///< of a list: (id, 0)
  std::vector<float> port, reference, step;  ///< step: distance to the next value that the slot can hold
};
/// Evaluates the pass with a constant replaced.
using EvaluateWith = std::function<float(const Wanted& w, std::size_t slot, float constant, float replacement)>;
void add_fitted_constants(std::vector<Fault>& out, const EvaluateWith& evaluate, const Constants& constants,
                          const std::vector<Wanted>& wanted);

}  // namespace rainref::faults
