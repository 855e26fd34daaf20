// The graph of passes: columns by the longest way from a pass that takes from none, rows in the order of execution.
#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "reports/figures.h"
#include "reports/html_parts.h"
#include "reports/markup.h"

namespace rainref::reports {
namespace {

using judge::PassJudgement;
using judge::PortJudgement;

constexpr int node_width = 190, node_height = 56, row_gap = 40, margin = 12;
constexpr int legible_width = 860;  // [px] A wider graph shrinks to the page, down to this
constexpr double letter = 6.6;      // of an edge's label [px]

struct Node {
  const PassJudgement* pass;
  int column = 0, row = 0, x = 0, y = 0;
};
struct Edge {
  const Node *from, *to;
  bool previous;
  std::string label;  // the inputs, "hit, normal"
};

std::vector<Node> placed(const PortJudgement& j, const std::vector<capture::PackEdge>& edges) {
  std::vector<Node> nodes;
  for (const PassJudgement& p : j.passes) nodes.push_back({&p});
  const auto find = [&](const std::string& name) {
    return std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.pass->pass == name; });
  };
  // Passes come in the order of execution, so what a pass takes from this run is placed before it.
  std::map<int, int> rows;
  for (Node& n : nodes) {
    for (const capture::PackEdge& e : edges)
      if (const auto from = find(e.from); e.pass == n.pass->pass && !e.previous && from != nodes.end() && &*from != &n)
        n.column = std::max(n.column, from->column + 1);
    n.row = rows[n.column]++;
  }
  return nodes;
}

std::vector<Edge> merged(const std::vector<Node>& nodes, const std::vector<capture::PackEdge>& edges) {
  std::vector<Edge> out;
  for (const capture::PackEdge& e : edges) {
    const auto find = [&](const std::string& name) {
      return std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.pass->pass == name; });
    };
    const auto from = find(e.from), to = find(e.pass);
    if (from == nodes.end() || to == nodes.end()) continue;
    const auto same =
        std::find_if(out.begin(), out.end(), [&](const Edge& o) { return o.from == &*from && o.to == &*to && o.previous == e.previous; });
    if (same != out.end())
      same->label += ", " + e.input;
    else
      out.push_back({&*from, &*to, e.previous, e.input});
  }
  return out;
}

std::string label_at(double x, double y, const std::string& text) {
  return fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", x, y, marked_up(text));
}

std::string edge_svg(const Edge& e, int top, int bottom) {
  const int x0 = e.from->x + node_width, y0 = e.from->y + node_height / 2, x1 = e.to->x, y1 = e.to->y + node_height / 2;
  const char* css = e.previous ? "edge previous" : "edge";
  if (e.from == e.to) {  // a loop above the node
    const int x = e.from->x + node_width / 2, y = e.from->y;
    return fmt::format("<path class=\"{}\" d=\"M{} {}C{} {} {} {} {} {}\"/>", css, x + 28, y, x + 44, y - 34, x - 44, y - 34, x - 28, y) +
           label_at(x, y - 30, e.label);
  }
  const int span = e.to->column - e.from->column;
  if (span == 1 && !e.previous) {
    return fmt::format("<path class=\"{}\" d=\"M{} {}C{} {} {} {} {} {}\"/>", css, x0, y0, (x0 + x1) / 2, y0, (x0 + x1) / 2, y1, x1 - 2,
                       y1) +
           label_at((x0 + x1) / 2.0, (y0 + y1) / 2.0 - 6, e.label);
  }
  // Around the nodes between: forward below them, backward above.
  const int from = e.from->x + node_width / 2 + (span > 0 ? 20 : -20), to = e.to->x + node_width / 2 + (span > 0 ? -20 : 20);
  const int turn = e.previous ? top - 26 : bottom + 22 + 12 * (span - 1);
  const int start = e.previous ? e.from->y : e.from->y + node_height, end = e.previous ? e.to->y - 2 : e.to->y + node_height + 2;
  return fmt::format("<path class=\"{}\" d=\"M{} {}C{} {} {} {} {} {}\"/>", css, from, start, from, turn + (turn - start) / 3, to,
                     turn + (turn - end) / 3, to, end) +
         label_at((from + to) / 2.0, turn - 2, e.label);
}

std::string node_svg(const Node& n, bool first_bad) {
  const PassJudgement& p = *n.pass;
  const Figures f = figures_of(p);
  const std::string detail =
      f.elements == 0
          ? name(p.status)
          : fmt::format("{} · {}", name(p.status), f.failing == 0 ? "0 outside" : share_text(f.failing, f.invocations) + " outside");
  const int middle = n.x + node_width / 2;
  return fmt::format(
      "<a href=\"#pass-{}\"><g class=\"node {}{}\"><title>{}</title><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"8\"/>"
      "<text class=\"name\" x=\"{}\" y=\"{}\">{}</text><text class=\"state\" x=\"{}\" y=\"{}\">{}</text></g></a>",
      marked_up(p.pass), status_class(p.status), first_bad ? " first" : "", marked_up(p.formula), n.x, n.y, node_width, node_height, middle,
      n.y + 24, marked_up(p.pass), middle, n.y + 43, marked_up(detail));
}

}  // namespace

std::string graph_html(const PortJudgement& j, const std::vector<capture::PackEdge>& edges) {
  std::vector<Node> nodes = placed(j, edges);
  double longest = 0;
  int columns = 0, rows = 0, reach = 0;
  bool previous = false;
  for (const Edge& e : merged(nodes, edges)) {
    const int span = e.to->column - e.from->column;
    if (span == 1) longest = std::max(longest, letter * static_cast<double>(e.label.size()));
    if (span > 1) reach = std::max(reach, 40 + 16 * (span - 1));
    previous |= e.previous;
  }
  const int gap = std::max(60, static_cast<int>(longest) + 30), top = margin + (previous ? 40 : 0);
  for (Node& n : nodes) {
    n.x = margin + n.column * (node_width + gap);
    n.y = top + n.row * (node_height + row_gap);
    columns = std::max(columns, n.column + 1);
    rows = std::max(rows, n.row + 1);
  }
  const int bottom = top + rows * node_height + (rows - 1) * row_gap, width = 2 * margin + columns * node_width + (columns - 1) * gap,
            height = bottom + reach + margin;
  std::string svg = fmt::format(
      "<div class=\"scroll\"><svg class=\"graph\" viewBox=\"0 0 {} {}\" style=\"max-width:{}px;min-width:{}px\" role=\"group\" "
      "aria-label=\"Passes and what flows between them\">"
      "<defs><marker id=\"arrow\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto\"><path "
      "d=\"M0 0L8 4L0 8z\"/></marker></defs>",
      width, height, width, std::min(width, legible_width));
  for (const Edge& e : merged(nodes, edges)) svg += edge_svg(e, top, bottom);
  for (const Node& n : nodes) svg += node_svg(n, n.pass->pass == j.first_bad_pass);
  return svg + "</svg></div>\n";
}

}  // namespace rainref::reports
