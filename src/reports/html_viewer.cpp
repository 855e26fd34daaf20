// Reference, port, difference and verdict of one output, side by side.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "capture/difference.h"
#include "image/code_range.h"
#include "judge/quantities.h"
#include "reports/figures.h"
#include "reports/html_parts.h"
#include "reports/markup.h"
#include "reports/pictures.h"

namespace rainref::reports {
namespace {

using judge::CaseJudgement;
using judge::Failure;
using judge::OutputJudgement;

constexpr std::size_t shown_outliers = 12, shown_fields = 40;
constexpr int small_columns = 320;  // wider pictures stand two in a row, where a browser would leave out pixels of four

std::string base64(const std::vector<std::byte>& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0u; };
    const unsigned word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string pane(std::string_view kind, const std::vector<std::byte>& png, const View& v, std::string_view caption) {
  const int columns = (v.width + v.thinned - 1) / v.thinned, rows = (v.height + v.thinned - 1) / v.thinned;
  return fmt::format(
      "<figure class=\"pane {0}\"><div class=\"window\" style=\"--ratio:{1}/{2}\"><div class=\"layer\"><img width=\"{1}\" height=\"{2}\" "
      "alt=\"{0}\" src=\"data:image/png;base64,{3}\"></div></div>"
      "<figcaption>{4}</figcaption></figure>\n",
      kind, columns, rows, base64(png), caption);
}

/// Blocks of colour, one for each doubling, from the lowest difference to the highest.
std::string scale_bar(const View& v) {
  if (v.largest == 0) return "<b>port − reference</b> no difference";
  const int steps = std::bit_width(v.largest);
  std::string blocks;
  const auto block = [&](std::int64_t codes) {
    blocks += fmt::format("<i style=\"background:{}\"></i>", difference_colour(codes, v.largest));
  };
  for (int k = steps - 1; k >= 0; --k) block(-(std::int64_t{1} << k));
  block(0);
  for (int k = 0; k < steps; ++k) block(std::int64_t{1} << k);
  return fmt::format(
      "<b>port − reference</b> <span class=\"bar\"><span>−{0}</span><span class=\"blocks\">{1}</span><span>+{0} code{2}</span></span>",
      v.largest, blocks, v.largest == 1 ? "" : "s");
}

std::string verdict_legend(const OutputJudgement& o) {
  constexpr std::array<const char*, 4> words{"equal", "inside", "atypical", "outside"};
  std::string out = "<b>verdict</b> of texels ";
  for (int k = 0; k < 4; ++k) {
    const auto count = std::count(o.map.begin(), o.map.end(), k);
    out += fmt::format("<span class=\"key\"><i style=\"background:{}\"></i>{} {}</span> ", verdict_colour(k), count,
                       words[static_cast<std::size_t>(k)]);
  }
  return out;
}

/// Whether a view shows a channel.
bool shows(const View& v, const std::string& channel) {
  const std::string label = v.label.substr(0, v.label.find(','));
  return label == channel || (label == "alpha" && channel == "w") || (label == "colour" && channel != "w");
}

std::string view_html(const View& v, const OutputJudgement& o, bool opens) {
  std::string out = fmt::format(
      "<div class=\"view\"{} data-label=\"{}\" data-x0=\"{}\" data-y0=\"{}\" data-width=\"{}\" data-height=\"{}\" "
      "data-thinned=\"{}\">\n<div "
      "class=\"panes{}\">\n",
      opens ? " data-open" : "", marked_up(v.label), v.x0, v.y0, v.width, v.height, v.thinned,
      v.width / v.thinned > small_columns ? " large" : "");
  const std::string scale = marked_up(v.scale) + (v.has_nan ? "; <span class=\"nan\">magenta: not a number</span>" : "");
  out += pane("reference", v.reference, v, "<b>reference</b> " + scale);
  out += pane("port", v.port, v, "<b>port</b> same scale");
  out += pane("difference", v.difference, v, scale_bar(v));
  out += pane("verdict", v.verdict, v, verdict_legend(o));
  out += "</div>\n";
  if (v.thinned > 1)
    out += fmt::format(
        "<p class=\"remark\">One pixel for {0}×{0} texels: reference and port show the first of them, difference and verdict the "
        "worst.</p>\n",
        v.thinned);
  return out + "</div>\n";
}

std::string outliers_html(const OutputJudgement& o) {
  if (o.failing == 0) return "";
  std::vector<std::vector<std::string>> rows;
  const judge::QuantityJudgement* worst = worst_quantity(o);
  bool is_marked = false;
  for (const Failure& f : o.worst) {
    const FailureText t = failure_text(o, f);
    const bool opens = !is_marked && worst && worst->name == channel_name(f.channel);
    is_marked |= opens;
    rows.push_back({fmt::format("<button class=\"place\"{} data-x=\"{}\" data-y=\"{}\">{}</button>", opens ? " data-open" : "", f.x, f.y,
                                marked_up(t.place)),
                    t.got, t.accepted, t.expected, f.not_a_number ? "not a number" : fmt::format("{}", f.distance), marked_up(t.value)});
  }
  const std::vector<std::string> head{"place (column, row).channel", "got", "accepted", "expected", "codes off", "off by"};
  const auto part = [&](std::size_t begin, std::size_t end) {
    return table_html("outliers", head,
                      {rows.begin() + static_cast<std::ptrdiff_t>(begin), rows.begin() + static_cast<std::ptrdiff_t>(end)}, 1);
  };
  std::string out = fmt::format("<h4>The worst {} of {} elements outside</h4>\n", rows.size(), o.failing) +
                    part(0, std::min(shown_outliers, rows.size()));
  if (rows.size() > shown_outliers)
    out +=
        fmt::format("<details><summary>{} more</summary>{}</details>\n", rows.size() - shown_outliers, part(shown_outliers, rows.size()));
  return out;
}

/// Where a record lies, or null. A keyed list is in any order: its records are found by their id, if they have one.
const std::byte* record_at(const capture::Array& a, bool keyed, std::uint32_t index) {
  const std::size_t size = a.element_bytes(), count = a.levels[0].size() / size;
  const auto id = std::find_if(a.record.members.begin(), a.record.members.end(), [](const scene::Member& m) { return m.name == "id"; });
  if (!keyed || id == a.record.members.end()) return index < count ? a.levels[0].data() + index * size : nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t found;
    std::memcpy(&found, a.levels[0].data() + i * size + id->offset, sizeof found);
    if (found == index) return a.levels[0].data() + i * size;
  }
  return nullptr;
}

/// Of a keyed list: the fields that are outside, by how far.
std::string fields_html(const OutputJudgement& o, const OutputBuffers& b) {
  const std::vector<judge::Quantity> fields = judge::quantities_of(b.expected);
  std::vector<std::vector<std::string>> rows;
  for (const Failure& f : o.worst) {
    const FailureText t = failure_text(o, f);
    const std::byte* want = record_at(b.expected.array, true, static_cast<std::uint32_t>(f.x));
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const judge::Quantity& q) { return q.name == f.field; });
    const bool is_expected = want && field != fields.end();
    rows.push_back({fmt::format("{}", static_cast<std::uint32_t>(f.x)), marked_up(f.field), t.got, t.accepted,
                    is_expected ? enclosed::code_text(field->kind, enclosed::ordered_code(field->kind, want + field->offset)) : "",
                    f.not_a_number ? "not a number" : fmt::format("{}", f.distance), marked_up(t.value)});
  }
  const std::size_t shown = std::min<std::size_t>(rows.size(), shown_fields);
  std::string out = fmt::format("<h4>{} of {} fields outside, of {}</h4>\n", o.failing, o.elements, shape_text(o));
  if (!rows.empty())
    out += table_html("outliers", {"record", "field", "got", "accepted", "expected", "codes off", "off by"},
                      {rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(shown)}, 2);
  if (rows.size() > shown) out += fmt::format("<p class=\"remark\">{} more fields are not shown.</p>\n", rows.size() - shown);
  return out;
}

/// Records have no picture: the fields that differ, record by record.
std::string records_html(const OutputJudgement& o, const OutputBuffers& b) {
  if (o.failing == 0) return "";
  if (o.counted == judge::Counted::fields) return fields_html(o, b);
  std::vector<std::vector<std::string>> rows;
  for (const Failure& f : o.worst) {
    const auto index = static_cast<std::uint32_t>(f.x);
    const std::byte *want = record_at(b.expected.array, false, index), *have = record_at(b.port, false, index);
    if (!want || !have) {
      rows.push_back({fmt::format("{}", index), "", want ? "missing" : "not expected", ""});
      continue;
    }
    for (const scene::Member& m : b.expected.array.record.members) {
      for (int k = 0; k < m.components; ++k) {
        const std::size_t at = m.offset + 4 * static_cast<std::size_t>(k);
        if (!std::equal(want + at, want + at + 4, have + at))
          rows.push_back({fmt::format("{}", index), marked_up(m.components == 1 ? m.name : m.name + "." + channel_name(k)),
                          capture::scalar_text(have + at, m.scalar), capture::scalar_text(want + at, m.scalar)});
      }
    }
  }
  const std::size_t shown = std::min<std::size_t>(rows.size(), shown_fields);
  std::string out =
      fmt::format("<h4>Records that differ: {} of {}</h4>\n", o.failing, o.elements) +
      table_html("outliers", {"record", "field", "got", "expected"}, {rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(shown)}, 2);
  if (rows.size() > shown) out += fmt::format("<p class=\"remark\">{} more fields are not shown.</p>\n", rows.size() - shown);
  return out;
}

}  // namespace

ViewerHtml viewer_html(const CaseJudgement& c, const OutputJudgement& o, const OutputBuffers& buffers, bool with_pictures) {
  ViewerHtml out;
  const std::string title = fmt::format("<h3 id=\"{}\">{}/out.{} <span class=\"dim\">{}</span></h3>\n", marked_up(place_of(c, o)),
                                        marked_up(c.id), marked_up(o.name), shape_text(o));
  if (o.records) {
    const std::string differing = records_html(o, buffers);
    if (!differing.empty()) out.html = title + differing;
    return out;
  }
  const std::vector<View> views = with_pictures ? views_of(o, buffers.expected, buffers.port) : std::vector<View>();
  const std::string outliers = outliers_html(o);
  if (views.empty() && outliers.empty()) return out;
  out.html = title + fmt::format("<div class=\"viewer\" tabindex=\"0\" role=\"group\" aria-label=\"Pictures of {}/out.{}\">\n",
                                 marked_up(c.id), marked_up(o.name));
  const judge::QuantityJudgement* worst = worst_quantity(o);
  const auto opening = std::find_if(views.begin(), views.end(), [&](const View& v) { return worst && shows(v, worst->name); });
  for (const View& v : views) {
    out.html += view_html(v, o, opening != views.end() && &v == &*opening);
    out.bytes += v.bytes();
  }
  out.html += outliers + "</div>\n";
  return out;
}

}  // namespace rainref::reports
