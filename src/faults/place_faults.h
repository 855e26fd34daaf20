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
/// All that can be made at a node of a probe.
std::vector<Mistake> mistakes_at(const Probe& p, std::size_t at);

/// What is wrong at a place.
enum class PlaceKind {
  plain,    ///< something left out, exchanged, of another sign
  multiple  ///< a term or factor that counts otherwise: twice, half, squared
};
/// Adds what can go wrong at each place that the probes met. `known`: as they were made with.
void add_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, PlaceKind kind);

/// The same at all places that look alike one or two operations deep, though they differ below: a function of the text that is called
/// several times is wrong in each call. Edits ask for these places too.
void add_shared_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known);
/// Places that look alike so few operations deep and are of several shapes, by one node; of each such class once.
struct SharedPlace {
  std::size_t probe;  ///< of those given
  std::int32_t node;
  std::int8_t depth;   ///< 1 or 2, or by_sequence
  std::size_t shapes;  ///< how many there are
};
/// By what it is known there.
std::uint32_t shape_of(const perturbed::Trace::Node& n, const SharedPlace& place);
/// Says of a mistake at one place that it is made at all of them.
void reach_all(What& what, const SharedPlace& place);
std::vector<SharedPlace> shared_places_of(const std::vector<Probe>& probes);

/// The places of the components of vectors, two or three of one operation and one text but for the components: nodes of the probe.
std::vector<std::vector<std::size_t>> vectors_of(const Probe& p);
/// The same of any values, leaves too.
std::vector<std::vector<std::size_t>> vector_values_of(const Probe& p);

/// A constant that has another value in the port, about the one that is said.
Fault another_value(Kind kind, const Constant& constant, float said, float replacement);
/// Adds, for each constant, the value that it would need to have for what the port stored at some failing texels, where there
/// is one. `wanted`: texels and what the port stored there, one number for each slot.
struct Wanted {
  Texel at;                                  ///< of a list: (id, 0)
  std::vector<float> port, reference, step;  ///< step: to the next number that the slot can hold
};
/// What the pass gives with a constant replaced.
using EvaluateWith = std::function<float(const Wanted& w, std::size_t slot, float constant, float replacement)>;
void add_fitted_constants(std::vector<Fault>& out, const EvaluateWith& evaluate, const Constants& constants,
                          const std::vector<Wanted>& wanted);

}  // namespace rainref::faults
