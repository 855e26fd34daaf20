// Expressions of a pass as text, as a shader writes them, with gaps where parts are left out. Only this file interprets such texts.
#pragma once

#include <cstdint>
#include <string>

#include "faults/edits.h"
#include "faults/probe.h"

namespace rainref::faults {

/// Text of a node, at most 60 characters if possible; cached in the probe.
std::string words_for(const Probe& p, std::int32_t node);
/// The same, as deep as needed to be informative, at most 80 characters.
std::string shortened(const Probe& p, std::int32_t node);
/// Text of an expression in the terms of the pass, at most about 80 characters.
std::string text_of(const Probe& p, const Expression& e);
/// Text of a value after a change: "1 - damping", "abs(x)".
std::string changed_text(perturbed::Change change, const std::string& text);
/// Adds parentheses if it is more than one word.
std::string closed(const std::string& text);
/// Name of a rounding or nonlinear function: "floor", "sqrt"; "" for others.
const char* bend_name(perturbed::Op op);
/// The same for all functions, bounds with their limit: "min with x".
std::string function_text(const Probe& p, const perturbed::Trace::Node& n);
/// "multiplies", "divides", "is added to", "is taken from"; else "bounds".
const char* verb_of(perturbed::Op op);
/// "(1, 0)", "the texel itself".
std::string offset_text(int dx, int dy);

/// Number of parts left out: "...".
int gaps(const std::string& text);
/// True if it consists of gaps and signs only.
bool says_nothing(const std::string& text);
bool has_brackets(const std::string& text);
bool offers_choice(const std::string& text);
/// True if it contains a fraction: x - floor(x).
bool has_fraction(const std::string& text);
/// True if a vector component occurs before the first gap.
bool names_component_before_gap(const std::string& text);
/// The name at the beginning of a text, without its component.
std::string first_name(const std::string& text);
/// The first word.
std::string first_word(const std::string& text);

/// Mip level in a case's id: "blur_pyramid/f1.L2"; -1: none.
int mip_level(const std::string& case_id);

// Names of leaves.
bool is_number(const std::string& name);
bool is_of_list(const std::string& name);
/// True for a number that is a function of several numbers: "f(width, height)".
bool is_made(const std::string& name);
/// Adds one more number to such a function.
std::string made_of_too(const std::string& name, const std::string& other);
/// True if a name is a member of the uniforms, or a function of it.
bool names_member(const std::string& name, const std::string& member);
/// Image of a channel's name; "" for others.
std::string image_of_channel(const std::string& name);

// Replace what differs between the components of a vector, so that equal texts can be found.
/// Replaces column and row by a component, as for a texel's position.
std::string with_columns(const std::string& text);
/// Replaces the vector components `first` to `last` by one name.
std::string of_any_component(std::string text, char first = 'x', char last = 'z');
/// Replaces all components and axes by one name and sign.
std::string of_any_axis(const std::string& text);
/// Makes offsets to either side equal: x - shift as x + shift.
std::string of_either_side(std::string text);

}  // namespace rainref::faults
