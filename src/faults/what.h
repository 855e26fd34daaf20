// What a mistake is: its kind, what of the pass it speaks of, and how far it reaches. All that is decided of causes is decided by these
// and by the columns of the catalogue; their words are made of them, in words.cpp alone.
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
  count  ///< how many there are
};
/// The kind that lies so far behind another one.
constexpr Kind behind(Kind first, int by) { return static_cast<Kind>(static_cast<int>(first) + by); }

/// What the diagnosis asks about a kind: bits of the column `traits`.
namespace trait {
constexpr unsigned none = 0;
constexpr unsigned solved = 1;       ///< found by solving for what the port stored
constexpr unsigned fitted = 2;       ///< a number fitted to what the port stored
constexpr unsigned odd = 4;          ///< a number that has another value for which there is no plain reason
constexpr unsigned uniform = 8;      ///< a uniform itself is wrong
constexpr unsigned set_at_all = 16;  ///< a uniform or flag that is not set: the plainest of these
constexpr unsigned unset = 32;       ///< a uniform that is zero
constexpr unsigned channel = 64;     ///< a channel of an input that has another sign, is taken from 1, or counts as 0
constexpr unsigned lost = 128;       ///< a list that lacks the very records that the port lost
constexpr unsigned empty = 256;      ///< nothing is written
constexpr unsigned late = 512;       ///< a list that is as it was before the pass
constexpr unsigned bare = 1024;      ///< its weight says all, whatever its words leave out
constexpr unsigned lookup = 2048;    ///< how an image is looked up, wherever it is
}  // namespace trait

/// Where a mistake is made beside the place that its words name.
enum class Reach : std::uint8_t {
  one,
  one_alike,      ///< one of {0} alike, number {1}
  both,           ///< both components of a vector
  all,            ///< all components
  in_u_and_v,     ///< both coordinates of a lookup
  each_call,      ///< all {0} places that are made alike
  wherever,       ///< wherever a place is made alike
  each_round,     ///< every round of a loop
  each_vector,    ///< wherever a vector is made alike
  all_sums,       ///< all sums of the same weights
  channel_alone,  ///< channel {0} of {1}
  image_alone,    ///< one image, {0}
  count
};

struct What {
  Kind kind = Kind::drawn;
  std::vector<std::string> of = {};  ///< names and expressions of the pass, and numbers, as the catalogue counts them
  Reach reach = Reach::one;
  std::vector<std::string> where = {};   ///< what the reach speaks of
  std::string head = {};                 ///< the word that its name begins with, where that is not all of of[0]
  bool is_literal = false;               ///< of a number: it stands in the pass text as it is
  std::string name = {}, sentence = {};  ///< of a draw: its own words

  bool is(unsigned traits) const;
  bool is_of_all_components() const { return reach == Reach::all; }
  /// A place that is met several times, as a function of the text that is called: one mistake there by another name.
  bool is_of_each_place() const { return reach >= Reach::each_call && reach <= Reach::each_vector; }
  /// Of how an image is looked up wherever it is: the mistake stands where that is done for all.
  bool is_of_function() const { return is(trait::lookup); }
  /// A number that has another value without a plain reason.
  bool is_odd_number() const { return is(trait::odd) && reach == Reach::one; }
};

/// Its words: "term left out: damping" and what to look for in the port. Causes of one name are the same cause.
std::string name_of(const What& what);
std::string sentence_of(const What& what);
/// By what its name begins with causes are of one sort, of which one is said before others.
std::string head_of(const What& what);
/// The column of the catalogue.
int weight_of(const What& what);
/// Parts of expressions that its name leaves out.
int gaps_in_name(const What& what);
/// Whether its name speaks of numbers as they are, and not of what is computed.
bool names_plain_numbers(const What& what);

/// "clamped", "repeated", "mirrored", "0": what an image is beyond its edge.
const char* address_words(Address address);

}  // namespace rainref::faults
