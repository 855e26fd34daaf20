#include "port_dump/encoding.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/number_text.h"
#include "port_dump/port_info.h"

namespace rainref::port_dump {
namespace {

using Form = ChannelSource::Form;

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// A source's text from left to right.
class SourceText {
 public:
  explicit SourceText(std::string_view text) : rest_(text) {}
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }
  bool at_end() const { return rest_.empty(); }
  bool at_number() const { return !rest_.empty() && (is_digit(rest_[0]) || rest_[0] == '.'); }
  bool take(char c) {
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// digits[.digits][e[+-]digits]
  std::optional<double> number() {
    std::size_t end = 0;
    while (end < rest_.size() && (is_digit(rest_[end]) || rest_[end] == '.')) ++end;
    if (end < rest_.size() && rest_[end] == 'e') {
      std::size_t digits = end + 1;
      if (digits < rest_.size() && (rest_[digits] == '+' || rest_[digits] == '-')) ++digits;
      while (digits < rest_.size() && is_digit(rest_[digits])) end = ++digits;
    }
    return number_from<double>(taken(end));
  }
  /// [file.]channel
  bool channel(ChannelTerm& term) {
    std::size_t end = 0;
    while (end < rest_.size() && (is_of_name(rest_[end]) || rest_[end] == '.')) ++end;
    std::string_view name = taken(end);
    if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) {
      term.file = name.substr(0, dot);
      if (term.file.empty() || !std::all_of(term.file.begin(), term.file.end(), is_of_name)) return false;
      name.remove_prefix(dot + 1);
    }
    if (name.size() != 1) return false;
    for (const std::string_view names : {"xyzw", "rgba"})
      if (const std::size_t at = names.find(name); at != std::string_view::npos) {
        term.channel = static_cast<int>(at);
        return true;
      }
    return false;
  }

 private:
  std::string_view taken(std::size_t count) {
    const std::string_view out = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return out;
  }
  std::string_view rest_;
};

/// A number, a channel, or a number times a channel, after its sign. False if the source has no room for it.
bool parse_part(SourceText& text, double sign, ChannelSource& source, bool& has_bias, bool& is_scaled) {
  double factor = sign;
  if (text.at_number()) {
    const std::optional<double> number = text.number();
    if (!number) return false;
    factor *= *number;
    text.skip_blanks();
    if (!text.take('*')) {
      if (has_bias) return false;
      has_bias = true;
      source.bias = factor;
      return true;
    }
    text.skip_blanks();
    is_scaled = true;
  }
  ChannelTerm term;
  term.scale = factor;
  if (factor == 0 || source.terms.size() == ChannelSource::most_terms || !text.channel(term)) return false;
  source.terms.push_back(std::move(term));
  return true;
}

}  // namespace

bool parse_source(std::string_view written, ChannelSource& source) {
  source = {};
  source.terms.clear();
  SourceText text(written);
  bool has_bias = false, is_scaled = false;
  for (bool is_first = true; is_first || !text.at_end(); is_first = false) {
    text.skip_blanks();
    const bool is_minus = text.take('-');
    if (!is_minus && !is_first && !text.take('+')) return false;
    text.skip_blanks();
    if (!parse_part(text, is_minus ? -1 : 1, source, has_bias, is_scaled)) return false;
    text.skip_blanks();
  }
  if (source.terms.empty()) return false;
  const bool is_one = source.terms.size() == 1 && !is_scaled;
  const double scale = source.terms.front().scale;
  source.form = is_one && !has_bias                       ? (scale < 0 ? Form::negated : Form::plain)
                : is_one && scale < 0 && source.bias == 1 ? Form::complement
                                                          : Form::computed;
  return true;
}

std::string buffer_of(std::string_view stem) {
  const std::string_view name = stem.substr(stem.find('.') + 1);
  return std::string(name.substr(0, name.find('.')));
}

std::vector<std::string> stems_of(std::string_view stem, const PortInfo& port) {
  const std::string buffer = buffer_of(stem);
  const auto own = port.encodings.find(buffer);
  if (own == port.encodings.end() || own->second.channels.empty()) return {std::string(stem)};
  std::vector<std::string> out;
  for (const ChannelSource& source : own->second.channels)
    for (const ChannelTerm& term : source.terms) {
      std::string file(stem);
      if (!term.file.empty()) file.replace(stem.find('.') + 1, buffer.size(), term.file);
      if (std::find(out.begin(), out.end(), file) == out.end()) out.push_back(std::move(file));
    }
  return out;
}

}  // namespace rainref::port_dump
