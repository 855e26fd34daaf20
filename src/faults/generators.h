// All that makes mistakes for the diagnosis to try, beside what faults_of() of fault.h has for `mutate` too, place_faults.h and
// draw_faults.h. Each adds to what is there.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

// ---- what happens to a finished buffer
/// Orientation, channel order, encoding, timing of the case's images. `before`: the run of the same pass before, or null.
void add_output_faults(std::vector<Fault>& out, const capture::PassCase& c, const capture::PassCase* before);
/// Values encoded, clamped or packed on their way to the store; one of several outputs turned or shifted; pixel centres.
void add_output_mixups(std::vector<Fault>& out, const Probed& p, const capture::PassCase* before);
/// What becomes of the numbers of finished record list `output`: another sign, scale, end, member; the list itself reversed or one short.
void add_member_faults(std::vector<Fault>& out, const Probed& p, std::size_t output);

// ---- what a pass is given
/// Whole uniforms exchanged.
void add_whole_mixups(std::vector<Fault>& out, const Probed& p);
/// Uniforms exchanged, permuted, transposed, in another encoding; of those that the pass uses.
void add_uniform_mixups(std::vector<Fault>& out, const Probed& p, const std::set<std::string>& used);
/// Each float of a uniform as 1, twice and half itself, of passes whose numbers are not followed.
void add_uniform_values(std::vector<Fault>& out, const Probed& p);
/// The same as each of these values, fitted to what a port stored.
void add_uniforms_of_values(std::vector<Fault>& out, const Probed& p, const std::vector<float>& values);
/// Inputs exchanged, shifted, by another address mode, level or encoding; the other variant's formula. Without `images` those of
/// records alone.
void add_input_mixups(std::vector<Fault>& out, const Probed& p, bool images = true);
/// Coarser levels where the first one of an image is meant.
void add_level_faults(std::vector<Fault>& out, const Probed& p);
/// Inputs that count twice or half.
void add_scaled_inputs(std::vector<Fault>& out, const Probed& p);
/// Texels loaded by integers, read from elsewhere: farther or diagonal neighbours, exchanged axes, another channel, another
/// rule at the border.
void add_tap_faults(std::vector<Fault>& out, const Probed& p);
/// Each literal, or each uniform, by its name, as what is often written for it: left out, with the other sign, doubled. A guard
/// against a division by zero is left out at most.
void add_named_constants(std::vector<Fault>& out, const Constants& constants, bool literals);
/// Each constant as what is rarely written for it: one more, times pi, in degrees.
void add_odd_constants(std::vector<Fault>& out, const Probed& p, const Constants& constants);

// ---- the pass text, of what the probes met, at most so many. `known`: as they were made with
/// The order of steps: a value of before in place of the new one, a factor that is applied too early or too late.
void add_order_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most = 600);
/// Parts put together otherwise: exchanged, mapped or blended otherwise, another curve. `all`: more invocations, of other ways through
/// the pass, in which functions are called with other arguments.
void add_edit_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most,
                     const std::vector<Probe>& all);
struct Solvable;
/// What explains all of a few texels. An operand, a result or the components of a vector are first solved for: the numbers that they
/// would need to be for what the port stored, if any; then what can be made of the values of the invocation, of uniforms and of small
/// numbers is compared with them.
void add_solved_substitutions(std::vector<Fault>& out, const Probed& p, const std::vector<Solvable>& texels,
                              const std::vector<float>& known);

// ---- what needs no search: it gives a port's very values or does not. `port`: what it stored, in the order of the case's outputs
/// Rows of another pitch, half a turn.
void add_layout_faults(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port);
/// What another format or a blend makes of values: 10 and 11 bits, no subnormal halves, colours times their alpha.
void add_format_faults(std::vector<Fault>& out, const Probed& p, const std::vector<capture::Array>& port);
/// A buffer that is read while it is written: neighbours hold new values. And its two levels exchanged at the texel itself alone.
void add_in_place_faults(std::vector<Fault>& out, const Probed& p, const std::vector<capture::Array>& port);
/// A hash of fractions computed in half precision, at the texel `at` and all others.
void add_hash_faults(std::vector<Fault>& out, const Probed& p, Texel at);
/// All of these. What is given must outlive it.
inline std::vector<Fault> decidable_faults(const Probed& p, const std::vector<capture::Array>& port, Texel at) {
  std::vector<Fault> out;
  add_layout_faults(out, p.c, port);
  add_format_faults(out, p, port);
  add_in_place_faults(out, p, port);
  add_hash_faults(out, p, at);
  return out;
}

}  // namespace rainref::faults
