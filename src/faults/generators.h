// Generators of mistakes for the diagnosis only. faults_of() of fault.h, which `mutate` uses too, place_faults.h and draw_faults.h have
// others. Each function appends to `out`.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

// ---- mistakes in a finished buffer
/// Orientation, channel order, encoding and timing of the case's images. `before`: the previous run of the same pass, or null.
void add_output_faults(std::vector<Fault>& out, const capture::PassCase& c, const capture::PassCase* before);
/// Values encoded, clamped or packed before the store; one of several outputs turned or shifted; pixel centres.
void add_output_mixups(std::vector<Fault>& out, const Probed& p, const capture::PassCase* before);
/// Changes the numbers of finished record list `output`: sign, scale, byte order, member; the list reversed or one record short.
void add_member_faults(std::vector<Fault>& out, const Probed& p, std::size_t output);

// ---- mistakes in the inputs of a pass
/// Whole uniforms exchanged.
void add_whole_mixups(std::vector<Fault>& out, const Probed& p);
/// Exchanged, permuted, transposed or differently encoded uniforms, for those that the pass uses.
void add_uniform_mixups(std::vector<Fault>& out, const Probed& p, const std::set<std::string>& used);
/// Each float of a uniform as 1, doubled and halved, for passes that cannot be traced.
void add_uniform_values(std::vector<Fault>& out, const Probed& p);
/// The same with each of these values, which are fitted to what a port stored.
void add_uniforms_of_values(std::vector<Fault>& out, const Probed& p, const std::vector<float>& values);
/// Inputs exchanged, shifted, with another address mode, level or encoding; the other variant's formula. Without `images`: only inputs that
/// are records.
void add_input_mixups(std::vector<Fault>& out, const Probed& p, bool images = true);
/// Coarser mip levels in place of level 0 of an image.
void add_level_faults(std::vector<Fault>& out, const Probed& p);
/// Inputs multiplied by 2 or 1/2.
void add_scaled_inputs(std::vector<Fault>& out, const Probed& p);
/// Texels loaded by integers from the wrong place: farther or diagonal neighbours, exchanged axes, another channel, another rule at the
/// border.
void add_tap_faults(std::vector<Fault>& out, const Probed& p);
/// Common errors in each named literal or uniform: left out, sign changed, doubled. A guard against division by zero is only left out.
void add_named_constants(std::vector<Fault>& out, const Constants& constants, bool literals);
/// Rare errors in each constant: one more, times pi, in degrees.
void add_odd_constants(std::vector<Fault>& out, const Probed& p, const Constants& constants);

// ---- mistakes in the pass text, at nodes that the probes met; at most `most`. `known`: the constants that the probes were made with
/// Wrong order of steps: an old value in place of the new one, a factor applied too early or too late.
void add_order_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most = 600);
/// Parts combined differently: exchanged, mapped or blended otherwise, another curve. `all`: more invocations, with other paths through the
/// pass, in which functions have other arguments.
void add_edit_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most,
                     const std::vector<Probe>& all);
struct Solvable;
struct Workers;
/// Substitutions that explain all of a few texels. First solves for an operand, a result or the components of a vector: the numbers that
/// would give what the port stored, if any. Then compares these with values of the invocation, uniforms and small numbers.
void add_solved_substitutions(std::vector<Fault>& out, const Probed& p, const std::vector<Solvable>& texels,
                              const std::vector<float>& known, const Workers& workers);

// ---- mistakes that need no search: they reproduce the port's values or do not. `port`: the stored outputs, in the order of the case's
// outputs
/// Rows of another pitch; an image rotated by 180 degrees.
void add_layout_faults(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port);
/// The effect of another format or of blending: 10 and 11 bits, no subnormal halves, colours multiplied by alpha.
void add_format_faults(std::vector<Fault>& out, const Probed& p, const std::vector<capture::Array>& port);
/// A buffer that is read while it is written: neighbours hold new values. Also its two levels exchanged, only at the texel itself.
void add_in_place_faults(std::vector<Fault>& out, const Probed& p, const std::vector<capture::Array>& port);
/// A hash based on fractions computed in half precision, at texel `at` and all others.
void add_hash_faults(std::vector<Fault>& out, const Probed& p, Texel at);
/// All of these. The arguments must outlive the faults.
inline std::vector<Fault> decidable_faults(const Probed& p, const std::vector<capture::Array>& port, Texel at) {
  std::vector<Fault> out;
  add_layout_faults(out, p.c, port);
  add_format_faults(out, p, port);
  add_in_place_faults(out, p, port);
  add_hash_faults(out, p, at);
  return out;
}

}  // namespace rainref::faults
