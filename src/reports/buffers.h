// What the page shows besides the judgement: pictures of stored outputs, and fields of records.
#pragma once

#include <cstddef>
#include <string>

#include "judge/verdict.h"
#include "reports/source.h"

namespace rainref::reports {

/// Limit of the total size of PNG pictures [byte]. Failing passes come first; the page says what is left out.
inline constexpr std::size_t picture_budget = std::size_t{32} << 20;

/// One object for `assets/report.js`:
///   picture_budget, pictured_failures   as here and in figures.h
///   verdict_colours                     of the verdict map: equal, inside, atypical, outside
///   passes                              for each pass its Shown outputs (figures.h) that can be read again, in order
/// An output is {case, output} and, for an image, {views, verdicts, is_left_out}: its views (pictures.h) with pictures as data URIs and the
/// scale's colours from the lowest difference to the highest, the number of texels with each verdict, and whether the budget was used up. A
/// failing list has {rows, more}: texts of the first fields outside, [record, field, got, accepted, expected, codes off, off by], or for a
/// list judged by bits [record, field, got, expected], and the number of further fields.
std::string buffers_json(const judge::PortJudgement& judgement, const PageSource& source);

}  // namespace rainref::reports
