// A judgement as one HTML page. It needs no network and no other file, has a light and a dark form, and obeys keyboard and mouse.
#pragma once

#include <string>
#include <string_view>

#include "judge/verdict.h"
#include "reports/source.h"

namespace rainref::reports {

/// The whole page. It contains report_json() and buffers_json(), which its script shows (assets/report.js), and report_text() for browsers
/// without scripts. `exit_code` is that of the run.
std::string report_html(const judge::PortJudgement& judgement, int exit_code, const PageSource& source);

namespace detail {
/// A file of assets.
std::string_view report_asset(std::string_view name);
}  // namespace detail

}  // namespace rainref::reports
