#include "scene/key_guess.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "rainref/error.h"
#include "scene/key_groups.h"

namespace rainref::scene {
namespace {

// Longer names are not compared with the valid ones, because the edit distance takes time proportional to its length times each valid
// length.
constexpr std::size_t longest_guess = 128;
constexpr std::size_t most_offered = 3;

using Words = std::vector<std::string>;

/// Words in lower case, without digits and units; "dropSize" has two.
Words words_of(std::string_view text) {
  const auto is_in = [](char c, char first, char last) { return c >= first && c <= last; };
  Words out{""};
  bool was_small = false;
  for (const char c : text) {
    const bool is_capital = is_in(c, 'A', 'Z'), is_small = is_in(c, 'a', 'z');
    if ((!is_capital && !is_small) || (is_capital && was_small)) out.emplace_back();
    if (is_capital || is_small) out.back() += is_capital ? static_cast<char>(c - 'A' + 'a') : c;
    was_small = is_small;
  }
  std::erase_if(out, [](const std::string& w) { return w.empty() || w == "deg" || w == "a" || w == "of" || w == "the"; });
  return out;
}

/// The word without its ending and in one spelling, so that "droplets", "drying" and "reflectivity" meet "drop", "dries" and "reflects".
std::string stem(std::string word) {
  for (const auto& [other, one] :
       {std::pair{"color", "colour"}, {"gray", "grey"}, {"center", "centre"}, {"droplet", "drop"}, {"raindrop", "drop"}})
    if (word.starts_with(other)) word.replace(0, std::string_view(other).size(), one);
  if (word.ends_with("ies")) word.replace(word.size() - 3, 3, "y");
  for (const std::string_view end : {"ivity", "ation", "ness", "ance", "ion", "ing", "ity", "ive", "es", "ed", "s", "e"}) {
    if (!word.ends_with(end) || word.size() < end.size() + 3) continue;
    word.erase(word.size() - end.size());
    break;
  }
  if (word.ends_with("i")) word.back() = 'y';
  return word;
}
std::set<std::string> stems_of(const Words& words) {
  std::set<std::string> out;
  for (const std::string& w : words) out.insert(stem(w));
  return out;
}

/// By the stem of what is said: the stems of what is meant.
const std::map<std::string, std::set<std::string>>& synonyms() {
  static const std::map<std::string, std::set<std::string>> all{
#define WORD(said, meant) {stem(#said), stems_of(words_of(meant))},
#include "scene/synonyms.inc"
#undef WORD
  };
  return all;
}
/// Words that may stand in a name without a counterpart in the key, and in a key without one in the name.
bool says_little(const std::string& stem_of_word) {
  static const std::set<std::string> all = stems_of(
      {"amount", "camera", "display", "level", "on", "parameter", "picture", "render", "run", "scene", "setting", "value", "world"});
  return all.contains(stem_of_word);
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }
bool is_near(const std::string& wrong, const std::string& right) { return !nearest_name(wrong, {&right, 1}).empty(); }

/// What a key says, in stems. The name of the effect in it says nothing.
struct Said {
  std::set<std::string> last, table, sentence;

  Said(const Parameter& p, const std::string& effect)
      : last(stems_of(words_of(last_part(p.key)))), sentence(stems_of(words_of(p.sentence))) {
    if (const std::string of = table_of(p.key); of != effect) table = stems_of(words_of(of));
  }
  bool has(const std::string& word) const { return last.contains(word) || table.contains(word) || sentence.contains(word); }
  /// How much a word of a name agrees with the key; 0: not at all.
  double agreement(const std::string& word) const {
    if (last.contains(word)) return 5;
    if (table.contains(word)) return 4;
    const auto found = synonyms().find(word);
    const auto means = [&](const std::set<std::string>& in) {
      return found != synonyms().end() &&
             std::any_of(found->second.begin(), found->second.end(), [&](const auto& w) { return in.contains(w); });
    };
    return means(last) ? 4 : means(table) ? 3 : sentence.contains(word) ? 2 : means(sentence) ? 1 : 0;
  }
  /// How many words the key has beside these, and beside what they may mean.
  std::int64_t surplus(const std::set<std::string>& covered) const {
    const auto is_spare = [&](const std::string& w) { return !covered.contains(w) && !says_little(w); };
    return std::count_if(last.begin(), last.end(), is_spare) + std::count_if(table.begin(), table.end(), is_spare);
  }
};

/// The name with the slips in its words corrected: each word that no key has becomes the nearest one.
Words corrected(const Words& words, std::span<const Parameter> parameters) {
  Words known;
  for (const Parameter& p : parameters)
    for (std::string& w : words_of(p.key)) known.push_back(std::move(w));
  const std::set<std::string> stems = stems_of(known);
  Words out = words;
  for (std::string& w : out) {
    if (w.size() < 4 || stems.contains(stem(w)) || synonyms().contains(stem(w))) continue;
    if (const std::string near = nearest_name(w, known); !near.empty()) w = near;
  }
  return out;
}

/// The keys that agree with all words, and share one of several. `is_table`: the words are a table's name, so only keys that have them in
/// their last part are meant.
std::vector<std::string> keys_of_words(const Words& words, const std::string& effect, std::span<const Parameter> parameters,
                                       bool is_table) {
  const std::set<std::string> said = stems_of(words);
  std::set<std::string> covered = stems_of(words_of(effect));
  for (const std::string& w : said) {
    covered.insert(w);
    if (const auto found = synonyms().find(w); found != synonyms().end()) covered.insert(found->second.begin(), found->second.end());
  }
  struct Found {
    double score;
    std::string key;
  };
  std::vector<Found> found;
  for (const Parameter& p : parameters) {
    if (!repeated_table(table_of(p.key)).empty()) continue;
    const Said key(p, effect);
    if (is_table && !std::includes(key.last.begin(), key.last.end(), said.begin(), said.end())) continue;
    double sum = 0;
    bool agrees = true, shares = std::count_if(said.begin(), said.end(), [](const std::string&w) { return !says_little(w); }) < 2;
    for (const std::string& w : said) {
      const double agreement = key.agreement(w);
      agrees &= agreement > 0 || (says_little(w) && said.size() > 1);
      shares |= key.has(w) && !says_little(w);
      sum += agreement;
    }
    const double least = 1.5 * static_cast<double>(said.size());  // a word of the sentence alone, beside a synonym in it
    if (agrees && shares && sum >= least) found.push_back({sum - 0.75 * static_cast<double>(key.surplus(covered)), p.key});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.score > b.score; });
  std::vector<std::string> keys;
  for (const Found& f : found)
    if (keys.size() < most_offered && f.score >= found.front().score - 1) keys.push_back(f.key);
  return keys;
}

/// The key of the same table that differs by a slip; or "".
std::string slipped(const std::string& name, std::span<const Parameter> parameters) {
  std::vector<std::string> near;
  for (const Parameter& p : parameters)
    if (is_near(table_of(name), table_of(p.key)) && is_near(last_part(name), last_part(p.key))) near.push_back(p.key);
  return nearest_name(name, near);
}

}  // namespace

std::vector<std::string> keys_meant(const std::string& name, const std::string& effect, std::span<const Parameter> parameters) {
  if (name.size() > longest_guess) return {};
  const auto has = [&](const std::string& key) {
    return std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.key == key; });
  };
  if (has(name + ".on")) return {name + ".on"};
  if (!table_of(name).empty())
    if (std::string key = slipped(name, parameters); !key.empty()) return {std::move(key)};
  Words words = words_of(table_of(name) == effect ? last_part(name) : name);
  if (words.empty()) return {};
  const bool is_table = std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& p) { return table_of(p.key) == name; });
  std::vector<std::string> keys = keys_of_words(words, effect, parameters, is_table);
  return keys.empty() && !is_table ? keys_of_words(corrected(words, parameters), effect, parameters, false) : keys;
}

std::string did_you_mean_key(const std::string& name, const std::string& effect, std::span<const Parameter> parameters) {
  const std::vector<std::string> keys = keys_meant(name, effect, parameters);
  std::string out;
  for (std::size_t k = 0; k < keys.size(); ++k)
    out += fmt::format("{}'{}'", k == 0 ? "; did you mean " : k + 1 < keys.size() ? ", " : " or ", keys[k]);
  if (!keys.empty()) return out + "?";
  if (name.size() > longest_guess) return "";
  const std::set<std::string> said = stems_of(words_of(name));
  for (const Parameter& p : parameters) {
    const std::string table = table_of(p.key);
    const std::set<std::string> words = stems_of(words_of(table));
    if (table == name ||
        (table != effect && !words.empty() && repeated_table(table).empty() &&
         std::includes(said.begin(), said.end(), words.begin(), words.end()) && std::none_of(words.begin(), words.end(), says_little)))
      return fmt::format("; `rainref describe {} {}` lists that group", effect, table);
  }
  return "";
}

}  // namespace rainref::scene
