// What the page shows beside the judgement: pictures of what a port stored, and fields of its records.
#pragma once

#include <cstddef>
#include <string>

#include "judge/verdict.h"
#include "reports/source.h"

namespace rainref::reports {

/// Pictures stop when they come to this many bytes of PNG, those of failing passes first; the page says what is left out.
inline constexpr std::size_t picture_budget = std::size_t{32} << 20;

/// One object for `assets/report.js`:
///   picture_budget, pictured_failures   as here and in figures.h
///   verdict_colours                     of the verdict map: equal, inside, atypical, outside
///   passes                              of each pass its Shown outputs (figures.h) that can be read again, in their order
/// An output is {case, output} and, of an image, {views, verdicts, is_left_out}: its views (pictures.h) with pictures as data URIs
/// and the scale's colours from the lowest difference to the highest, how many texels have each verdict, whether the budget was
/// spent. A list that fails has {rows, more}: texts of the first fields outside, [record, field, got, accepted, expected,
/// codes off, off by], or of a list judged by bits [record, field, got, expected], and how many follow.
std::string buffers_json(const judge::PortJudgement& judgement, const PageSource& source);

}  // namespace rainref::reports
