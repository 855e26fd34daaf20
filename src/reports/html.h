// A judgement as one page for the eye: no network, no other file, light and dark, keyboard and mouse.
#pragma once

#include <cstddef>
#include <string>

#include "judge/verdict.h"
#include "reports/source.h"

namespace rainref::reports {

/// Pictures stop when they come to this many bytes of PNG, those of failing passes first; the page says what is left out.
inline constexpr std::size_t picture_budget = std::size_t{32} << 20;
/// Of a pass at most this many failing cases get pictures, the first and those with most failures; and one that passes.
inline constexpr std::size_t pictured_failures = 4;

/// The whole page.
std::string report_html(const judge::PortJudgement& judgement, const PageSource& source);

}  // namespace rainref::reports
