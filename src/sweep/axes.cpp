#include "sweep/axes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/path_text.h"
#include "base/read_file.h"

namespace rainref::sweep {
namespace {

using scene::RawEntry;
using scene::RawValue;

/// Largest size of a file of cases [byte].
constexpr std::uint64_t longest_cases = std::uint64_t{256} << 20;

[[noreturn]] void refuse(const SourceLocation& at, const std::string& key, const std::string& message) {
  throw Error(ExitCode::usage, at, fmt::format("axes.{}: {}", key, message));
}

bool is_number(const RawValue& v) { return std::holds_alternative<std::int64_t>(v.data) || std::holds_alternative<double>(v.data); }
double number(const RawValue& v) {
  const auto* whole = std::get_if<std::int64_t>(&v.data);
  return whole ? static_cast<double>(*whole) : std::get<double>(v.data);
}

Axis list_axis(const std::string& key, const RawValue& list) {
  Axis axis{{key}, {}};
  for (const RawValue& v : std::get<std::vector<RawValue>>(list.data)) axis.rows.push_back({{key, v, v.at}});
  return axis;
}

// ---- { from, to, count } -------------------------------------------------------------------------------------------------
struct RangeKeys {
  std::optional<RawValue> from, to, count;
};
struct Range {
  RawValue from, to;
  std::int64_t count;
};
Range range_of(const std::string& key, const RangeKeys& said, const SourceLocation& at) {
  if (!said.from) refuse(at, key, "expected 'from' beside 'count', found none");
  if (!said.count) refuse(at, key, "expected 'count' beside 'from', found none");
  for (const auto& [word, value] : {std::pair{"from", &*said.from}, std::pair{"to", said.to ? &*said.to : nullptr}}) {
    if (value && (!is_number(*value) || !std::isfinite(number(*value))))
      refuse(value->at, fmt::format("{}.{}", key, word), fmt::format("expected a number, found {}", value->text()));
  }
  const auto* count = std::get_if<std::int64_t>(&said.count->data);
  if (!count || *count < 1 || *count > most_cells)
    refuse(said.count->at, key + ".count", fmt::format("expected a whole number from 1 to {}, found {}", most_cells, said.count->text()));
  RawValue to;
  if (said.to) {
    to = *said.to;
    if (*count == 1 && number(to) != number(*said.from))
      refuse(said.count->at, key + ".count", "expected at least 2 where from and to differ, found 1");
  } else if (const auto* whole = std::get_if<std::int64_t>(&said.from->data)) {
    if (*whole > INT64_MAX - *count) refuse(said.from->at, key + ".from", fmt::format("expected less, found {}", *whole));
    to.data = *whole + *count - 1;
  } else {
    refuse(at, key, "expected 'to' beside a 'from' that is no whole number, found none");
  }
  return {*said.from, to, *count};
}

// ---- CSV -------------------------------------------------------------------------------------------------------------------
/// Fields of one line, separated by commas; "" around a field with commas, "" twice for a quote.
std::vector<std::string> fields(std::string_view line, const SourceLocation& at) {
  std::vector<std::string> out{""};
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      out.back() += line[++i];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  if (is_quoted) throw Error(ExitCode::usage, at, "expected a quote at the end of a field, found the end of the line");
  for (std::string& field : out) {
    const std::size_t first = field.find_first_not_of(" \t"), last = field.find_last_not_of(" \t");
    field = first == std::string::npos ? "" : field.substr(first, last + 1 - first);
  }
  return out;
}

Axis cases_axis(const std::filesystem::path& file, std::int64_t most_rows) {
  const std::vector<std::byte> bytes = read_file(file, {longest_cases, ExitCode::usage});
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  Axis axis;
  for (int number = 1; !rest.empty(); ++number) {
    const SourceLocation at{path_text(file), number};
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.starts_with('#')) continue;
    const std::vector<std::string> found = fields(line, at);
    if (axis.keys.empty()) {
      axis.keys = found;
      std::set<std::string> heads;
      for (const std::string& key : found) {
        if (key.empty()) throw Error(ExitCode::usage, at, "expected a key as the head of each column, found ''");
        if (!heads.insert(key).second) throw Error(ExitCode::usage, at, fmt::format("{}: is there twice", key));
      }
      continue;
    }
    if (found.size() != axis.keys.size())
      throw Error(ExitCode::usage, at, fmt::format("expected {} fields as the head has, found {}", axis.keys.size(), found.size()));
    if (static_cast<std::int64_t>(axis.rows.size()) == most_rows)
      throw Error(ExitCode::usage, at,
                  fmt::format("expected at most {} cases, for a plan has at most {} cells, found more", most_rows, most_cells));
    std::vector<scene::Override>& row = axis.rows.emplace_back();
    for (std::size_t i = 0; i < found.size(); ++i) row.push_back({axis.keys[i], found[i], at});
  }
  if (axis.rows.empty()) throw Error(ExitCode::usage, SourceLocation{path_text(file)}, "expected a head and at least one case, found none");
  return axis;
}

}  // namespace

std::string unquoted(const std::string& key) {
  std::string out = key;
  std::erase(out, '"');
  std::erase(out, '\'');
  return out;
}

std::vector<RawValue> range(const RawValue& from, const RawValue& to, std::int64_t count) {
  std::vector<RawValue> out;
  const auto* first = std::get_if<std::int64_t>(&from.data);
  const auto* last = std::get_if<std::int64_t>(&to.data);
  const std::int64_t steps = std::max<std::int64_t>(1, count - 1);
  const bool is_whole =
      first && last && std::abs(static_cast<double>(*last) - static_cast<double>(*first)) < 0x1p53 && (*last - *first) % steps == 0;
  for (std::int64_t i = 0; i < count; ++i) {
    RawValue& v = out.emplace_back();
    v.at = from.at;
    if (is_whole)
      v.data = *first + (*last - *first) / steps * i;
    else if (i == count - 1)
      v.data = number(to);
    else
      v.data = number(from) + (number(to) - number(from)) * (static_cast<double>(i) / static_cast<double>(steps));
  }
  return out;
}

std::vector<Axis> axes_from(std::span<const RawEntry> entries, const std::filesystem::path& folder) {
  std::vector<Axis> axes;
  std::set<std::string> keys;
  const auto add = [&](Axis axis, const SourceLocation& at) {
    for (const std::string& key : axis.keys)
      if (!keys.insert(key).second) refuse(at, key, "is there twice");
    axes.push_back(std::move(axis));
  };
  std::vector<std::pair<std::size_t, Range>> ranges;  // with their axes; their rows are made last, after everything is counted
  std::int64_t cells = 1;                             // of the axes so far
  const auto grow = [&](std::int64_t rows, const SourceLocation& at) {
    if (rows > most_cells / cells)
      throw Error(ExitCode::usage, at, fmt::format("axes: expected at most {} cells, found {}", most_cells, cells * rows));
    cells *= rows;
  };
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const RawEntry& e = entries[i];
    const std::string key = unquoted(e.key);
    if (key == "cases") {
      const auto* name = std::get_if<std::string>(&e.value.data);
      if (!name) refuse(e.value.at, key, "expected the name of a CSV file, found " + e.value.text());
      Axis axis = cases_axis(folder / utf8_path(*name), most_cells / cells);
      grow(static_cast<std::int64_t>(axis.rows.size()), e.at);
      add(std::move(axis), e.at);
    } else if (const auto* values = std::get_if<std::vector<RawValue>>(&e.value.data)) {
      if (values->empty()) refuse(e.value.at, key, "expected a value or more, found []");
      grow(static_cast<std::int64_t>(values->size()), e.at);
      add(list_axis(key, e.value), e.at);
    } else {
      const std::size_t dot = key.rfind('.');
      const std::string of = key.substr(0, dot);
      RangeKeys said;
      const auto take = [&](const RawEntry& entry) {
        const std::string whole = unquoted(entry.key);
        const std::string word = whole.substr(whole.rfind('.') + 1);
        if (dot == std::string::npos || whole.rfind('.') != dot || whole.substr(0, dot) != of) return false;
        std::optional<RawValue>* const slot = word == "from"    ? &said.from
                                              : word == "to"    ? &said.to
                                              : word == "count" ? &said.count
                                                                : nullptr;
        if (slot) *slot = entry.value;
        return slot != nullptr;
      };
      if (!take(e)) {
        const std::string word = key.substr(key.rfind('.') + 1);
        const std::vector<std::string> words{"from", "to", "count"};
        refuse(e.value.at, key,
               fmt::format("expected a list, or from, to and count, found {}{}", e.value.text(),
                           dot == std::string::npos ? "" : did_you_mean(word, words)));
      }
      while (i + 1 < entries.size() && take(entries[i + 1])) ++i;
      const Range& r = ranges.emplace_back(axes.size(), range_of(of, said, e.at)).second;
      grow(r.count, e.at);
      add({{of}, {}}, e.at);
    }
  }
  for (const auto& [i, r] : ranges)
    for (const RawValue& v : range(r.from, r.to, r.count)) axes[i].rows.push_back({{axes[i].keys[0], v, r.from.at}});
  return axes;
}

}  // namespace rainref::sweep
