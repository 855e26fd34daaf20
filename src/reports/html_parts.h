// The parts of the page, each a piece of HTML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reports/html.h"

namespace rainref::reports {

/// "is-fail", "is-pass": the class of a status in the style sheet.
std::string status_class(judge::Status status);
/// The status in its colour.
std::string status_pill(judge::Status status);

/// The passes and what flows between them, as SVG; a node links to its pass.
std::string graph_html(const judge::PortJudgement& judgement, const std::vector<capture::PackEdge>& edges);

/// A table of rows that are HTML already; the first `words` columns are words, the others numbers.
std::string table_html(std::string_view css_class, const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       std::size_t words);

/// Everything about one pass. Draws pictures while `budget` lasts, and takes what it used.
std::string pass_html(const judge::PassJudgement& pass, const judge::PortJudgement& judgement, const PageSource& source,
                      std::size_t& budget);

/// The pictures of one output, if wanted, and its worst elements; and what the pictures cost in bytes.
struct ViewerHtml {
  std::string html;
  std::size_t bytes = 0;
};
ViewerHtml viewer_html(const judge::CaseJudgement& c, const judge::OutputJudgement& output, const OutputBuffers& buffers,
                       bool with_pictures);

/// Where the pictures and worst elements of an output stand on the page.
std::string place_of(const judge::CaseJudgement& c, const judge::OutputJudgement& output);
/// The outputs of a case that are shown, what fails worst first: of a case that fails, what fails; of another, all.
std::vector<const judge::OutputJudgement*> shown_outputs(const judge::CaseJudgement& c);

/// The cases of a pass that get pictures: see pictured_failures.
std::vector<const judge::CaseJudgement*> pictured_cases(const judge::PassJudgement& pass);

namespace detail {
/// A file of assets.
std::string_view report_asset(std::string_view name);
}  // namespace detail

}  // namespace rainref::reports
