// Mistakes in what a pass is given and what becomes of what it gives, beyond those that `mutate` makes: asked by the diagnosis
// alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

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
/// What becomes of the numbers of finished record list `output`: another sign, scale, end, member; the list itself reversed or one short.
void add_member_faults(std::vector<Fault>& out, const Probed& p, std::size_t output);
/// Coarser levels where the first one of an image is meant.
void add_level_faults(std::vector<Fault>& out, const Probed& p);
/// Inputs that count twice or half.
void add_scaled_inputs(std::vector<Fault>& out, const Probed& p);
/// Values encoded, clamped or packed on their way to the store; one of several outputs turned or shifted; pixel centres.
void add_output_mixups(std::vector<Fault>& out, const Probed& p, const capture::PassCase* before);
/// Each literal, or each uniform, by its name, as what is often written for it: left out, with the other sign, doubled.
void add_named_constants(std::vector<Fault>& out, const Constants& constants, bool literals);
/// Each constant as what is rarely written for it: one more, times pi, in degrees.
void add_odd_constants(std::vector<Fault>& out, const Probed& p, const Constants& constants);
/// Texels loaded by integers, read from elsewhere: farther or diagonal neighbours, exchanged axes, another channel, another
/// rule at the border.
void add_tap_faults(std::vector<Fault>& out, const Probed& p);

}  // namespace rainref::faults
