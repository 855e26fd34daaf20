// Describes a mistake: its kind, the parts of the pass that it concerns, and its reach. Ranking uses only these and the catalogue's
// columns; words.cpp alone makes the texts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rainref/texture.h"

namespace rainref::faults {

/// The kinds of mistakes, in the order of the catalogue.
enum class Kind : std::uint16_t {
#define CAUSE(kind, weight, traits, head, rest, sentence) kind,
#include "faults/catalogue.inc"
#undef CAUSE
  count  ///< number of kinds
};
/// The kind `by` places after `first`.
constexpr Kind behind(Kind first, int by) { return static_cast<Kind>(static_cast<int>(first) + by); }

/// Properties of a kind for the diagnosis: bits of the column `traits`.
namespace trait {
constexpr unsigned none = 0;
constexpr unsigned solved = 1;       ///< found by solving for what the port stored
constexpr unsigned fitted = 2;       ///< a number fitted to what the port stored
constexpr unsigned odd = 4;          ///< a number with another value and no plain reason
constexpr unsigned uniform = 8;      ///< a uniform itself is wrong
constexpr unsigned set_at_all = 16;  ///< a uniform or flag that is not set: the plainest of these
constexpr unsigned unset = 32;       ///< a uniform that is zero
constexpr unsigned channel = 64;     ///< a channel of an input that is negated, subtracted from 1, or counts as 0
constexpr unsigned lost = 128;       ///< a list that lacks exactly the records that the port lost
constexpr unsigned empty = 256;      ///< nothing is written
constexpr unsigned late = 512;       ///< a list that is as before the pass
constexpr unsigned bare = 1024;      ///< only its weight counts, whatever its text leaves out
constexpr unsigned lookup = 2048;    ///< how an image is looked up, at every lookup
constexpr unsigned symptom = 4096;   ///< says what a list lacks, not why: never likely
}  // namespace trait

/// Where else a mistake is made, beside the place that its text names.
enum class Reach : std::uint8_t {
  one,
  one_alike,      ///< one of {0} equal places, number {1}
  both,           ///< both components of a vector
  all,            ///< all components
  in_u_and_v,     ///< both coordinates of a lookup
  each_call,      ///< all {0} equal places
  wherever,       ///< every equal place
  each_round,     ///< every round of a loop
  each_vector,    ///< every equal vector
  all_sums,       ///< all sums of the same weights
  channel_alone,  ///< channel {0} of {1}
  image_alone,    ///< one image, {0}
  count
};

struct What {
  Kind kind = Kind::drawn;
  std::vector<std::string> of = {};  ///< names and expressions of the pass, and numbers, in the catalogue's order
  Reach reach = Reach::one;
  std::vector<std::string> where = {};   ///< arguments of the reach
  std::string head = {};                 ///< the word that its name begins with, if that is not all of of[0]
  bool is_literal = false;               ///< of a number: it is a literal of the pass text
  std::string name = {}, sentence = {};  ///< of a draw: its own texts

  bool is(unsigned traits) const;
  bool is_of_all_components() const { return reach == Reach::all; }
  /// True for one place that is met several times, such as a called function: there the same mistake has another name.
  bool is_of_each_place() const { return reach >= Reach::each_call && reach <= Reach::each_vector; }
  /// True for a mistake in how an image is looked up everywhere: it is in the code shared by all lookups.
  bool is_of_function() const { return is(trait::lookup); }
  /// True for a number that has another value without a plain reason.
  bool is_odd_number() const { return is(trait::odd) && reach == Reach::one; }
};

/// Its name and sentence: "term left out: damping", and what to look for in the port. Causes with one name are the same cause.
std::string name_of(const What& what);
std::string sentence_of(const What& what);
/// Beginning of its name. Only one of the causes with the same beginning is listed first.
std::string head_of(const What& what);
/// From the catalogue's column.
int weight_of(const What& what);
/// Number of expression parts that its name leaves out.
int gaps_in_name(const What& what);
/// True if its name contains plain numbers, not computed values.
bool names_plain_numbers(const What& what);

/// "clamped", "repeated", "mirrored", "0": an image's values beyond its edge.
const char* address_words(Address address);

}  // namespace rainref::faults
