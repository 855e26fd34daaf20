// What a pass computes, as text: expressions as a shader writes them, and what such a text leaves out. The one place that reads texts.
#pragma once

#include <cstdint>
#include <string>

#include "faults/edits.h"
#include "faults/probe.h"

namespace rainref::faults {

/// What a node computes: in at most 60 letters where that can be; kept by the probe.
std::string words_for(const Probe& p, std::int32_t node);
/// The same, as deep as it must be to say something, in at most 80 letters.
std::string shortened(const Probe& p, std::int32_t node);
/// An expression in the words of the pass, at most about 80 letters.
std::string text_of(const Probe& p, const Expression& e);
/// A text with what becomes of its value before it stands elsewhere: "1 - damping", "abs(x)".
std::string changed_text(perturbed::Change change, const std::string& text);
/// In brackets, where it is more than one word.
std::string closed(const std::string& text);
/// What rounds or bends a number: "floor", "sqrt"; "" of others.
const char* bend_name(perturbed::Op op);
/// The same of all functions, bounds with what they bound: "min with x".
std::string function_text(const Probe& p, const perturbed::Trace::Node& n);
/// "multiplies", "divides", "is added to", "is taken from"; else "bounds".
const char* verb_of(perturbed::Op op);
/// "(1, 0)", "the texel itself".
std::string offset_text(int dx, int dy);

/// How many parts it leaves out: "...".
int gaps(const std::string& text);
/// Whether it is made of gaps and signs alone.
bool says_nothing(const std::string& text);
bool has_brackets(const std::string& text);
bool offers_choice(const std::string& text);
/// Whether it has a fraction: x - floor(x).
bool has_fraction(const std::string& text);
/// Whether the component of a vector stands before the first of its gaps.
bool names_component_before_gap(const std::string& text);
/// The name that a text begins with, without its component.
std::string first_name(const std::string& text);
/// The first word.
std::string first_word(const std::string& text);

/// The mip level of a case of this name: "blur_pyramid/f1.L2"; -1: it is of none.
int mip_level(const std::string& case_id);

// Names of leaves.
bool is_number(const std::string& name);
bool is_of_list(const std::string& name);
/// A number that the pass is given as a function of others: "f(width, height)".
bool is_made(const std::string& name);
/// Made of one more number.
std::string made_of_too(const std::string& name, const std::string& other);
/// Whether a name is that of a member of the uniforms, or made of it.
bool names_member(const std::string& name, const std::string& member);
/// The image whose channel it is; "" of others.
std::string image_of_channel(const std::string& name);

// Texts that are alike but for the component of a vector.
/// Column and row as a component, as those of a texel's place.
std::string with_columns(const std::string& text);
/// The components of vectors, which are letters from `first` to `last`, by one name.
std::string of_any_component(std::string text, char first = 'x', char last = 'z');
/// All components and axes by one name and sign.
std::string of_any_axis(const std::string& text);
/// What lies on either side of something: x - shift as x + shift.
std::string of_either_side(std::string text);

}  // namespace rainref::faults
