// Makes the texts of causes from the catalogue and the names of a cause.
#include <algorithm>
#include <iterator>

#include "faults/text.h"
#include "faults/what.h"

namespace rainref::faults {
namespace {

using namespace trait;

struct Entry {
  int weight;
  unsigned traits;
  const char *head, *rest, *sentence;
};
constexpr Entry entries[] = {
#define CAUSE(kind, weight, traits, head, rest, sentence) {weight, traits, head, rest, sentence},
#include "faults/catalogue.inc"
#undef CAUSE
};
static_assert(std::size(entries) == static_cast<std::size_t>(Kind::count));
const Entry& entry_of(const What& what) { return entries[static_cast<std::size_t>(what.kind)]; }

/// Text after a name, and after a sentence.
constexpr const char* reaches[][2] = {
    {"", ""},
    {"", " (one of {0} alike, number {1})"},
    {", in both components", ", and so in the other component"},
    {", in all components", ", and so in the other components"},
    {"", ", in u and v"},
    {", in each such place", ", and so in all {0} places that are made alike: a function that is called several times"},
    {", in each such place", ", wherever it is made alike: a function that is called several times"},
    {", in each such place", ", in every round of a loop"},
    {", in each such place", ", and so wherever a vector is made alike: a function that is called several times"},
    {", in all of these sums", ", and so in the other sums of these weights"},
    {", {0} of {1} alone", ", in channel {0} of {1}"},
    {": {0} alone", ""},
};
static_assert(std::size(reaches) == static_cast<std::size_t>(Reach::count));

/// Number of the argument {0} at a position of a text; -1: a letter.
int part_at(const char* at) { return at[0] == '{' && at[1] >= '0' && at[1] <= '9' && at[2] == '}' ? at[1] - '0' : -1; }
std::string filled(const char* text, const std::vector<std::string>& of) {
  std::string out;
  while (*text) {
    const int part = part_at(text);
    if (part < 0) {
      out += *text++;
      continue;
    }
    if (static_cast<std::size_t>(part) < of.size()) out += of[static_cast<std::size_t>(part)];
    text += 3;
  }
  return out;
}
/// The arguments that a name shows.
std::vector<const std::string*> parts_of_name(const What& what) {
  std::vector<const std::string*> out;
  for (const char* text : {entry_of(what).head, entry_of(what).rest})
    for (; *text; ++text)
      if (const int part = part_at(text); part >= 0 && static_cast<std::size_t>(part) < what.of.size())
        out.push_back(&what.of[static_cast<std::size_t>(part)]);
  return out;
}
const char* const* reach_of(const What& what) { return reaches[static_cast<std::size_t>(what.reach)]; }

}  // namespace

bool What::is(unsigned traits) const { return (entry_of(*this).traits & traits) != 0; }

std::string name_of(const What& what) {
  if (!what.name.empty()) return what.name;
  return filled(entry_of(what).head, what.of) + filled(entry_of(what).rest, what.of) + filled(reach_of(what)[0], what.where);
}
std::string sentence_of(const What& what) {
  if (!what.name.empty()) return what.sentence;
  return filled(entry_of(what).sentence, what.of) + filled(reach_of(what)[1], what.where);
}
std::string head_of(const What& what) {
  if (*entry_of(what).head) return filled(entry_of(what).head, what.of);
  return what.head.empty() && !what.of.empty() ? what.of[0] : what.head;
}
int weight_of(const What& what) {
  const Entry& entry = entry_of(what);
  if (!what.is_literal) return entry.weight;
  // A wrongly typed literal is more plausible than a wrong uniform; another formula for it is less plausible.
  return (entry.traits & fitted) != 0 ? entry.weight - 1 : entry.weight == 0 ? 2 : entry.weight;
}
int gaps_in_name(const What& what) {
  int out = 0;
  for (const std::string* part : parts_of_name(what)) out += gaps(*part);
  return out;
}
bool names_plain_numbers(const What& what) {
  const std::vector<const std::string*> parts = parts_of_name(what);
  return std::none_of(parts.begin(), parts.end(),
                      [](const std::string* part) { return gaps(*part) > 0 || has_brackets(*part) || offers_choice(*part); });
}

const char* address_words(Address address) {
  constexpr const char* words[] = {"clamped", "repeated", "mirrored", "0"};
  return words[static_cast<std::size_t>(address)];
}

}  // namespace rainref::faults
