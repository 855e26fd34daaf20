// The printed formula is the judged formula: every pass, written from the documents alone, is judged PASS; the documents still hold each
// line that it was written from; and no line of a formula is left out.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "documents/judged_written.h"
#include "shipped_packs.h"

namespace rainref::documents {
namespace {

std::vector<std::string> lines_of(std::istream&& text) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}
std::vector<std::string> lines_of_document(const std::string& document) {
  std::ifstream file(rainref::test::source_folder() + "/" + document);
  EXPECT_TRUE(file.good()) << document;
  return lines_of(std::move(file));
}
std::vector<std::string> lines_of_text(const std::string& text) { return lines_of(std::istringstream(text)); }

/// The lines of a text that a document has not.
std::vector<std::string> missing_lines(const std::vector<std::string>& document, const std::string& text) {
  std::vector<std::string> missing;
  for (const std::string& line : lines_of_text(text))
    if (std::find(document.begin(), document.end(), line) == document.end()) missing.push_back(line);
  return missing;
}

// A changed formula is one whose function must be written again.
TEST(PrintedFormulas, StandInTheirDocuments) {
  std::map<std::string, std::vector<std::string>> documents;
  const auto check = [&](const From& from, const std::string& whose) {
    std::vector<std::string>& document = documents[from.document];
    if (document.empty()) document = lines_of_document(from.document);
    ASSERT_FALSE(from.text.empty());
    for (const std::string& line : missing_lines(document, from.text))
      ADD_FAILURE() << from.document << ", " << whose << ": no longer has the line\n" << line;
  };
  check(rules_of_all_passes, "every pass");
  for (const Written& w : all_written()) {
    EXPECT_FALSE(w.from.empty()) << w.pass;
    for (const From& from : w.from) check(from, w.packs[0] + " " + w.pass);
  }
  EXPECT_EQ(documents.size(), 6u);
}
TEST(PrintedFormulas, WouldBeMissedWithAnotherConstantOrOrder) {
  const std::vector<std::string> document{"a = 2 (b + c)", "d = a · .5"};
  EXPECT_EQ(missing_lines(document, "a = 2 (b + c)\nd = a · .5"), std::vector<std::string>());
  EXPECT_EQ(missing_lines(document, "a = 2 (b + c)\nd = a · .6"), std::vector<std::string>{"d = a · .6"});
  EXPECT_EQ(missing_lines(document, "a = 2 (c + b)"), std::vector<std::string>{"a = 2 (c + b)"});
  EXPECT_EQ(missing_lines(document, "a = 2 (b"), std::vector<std::string>{"a = 2 (b"});
}

/// The lines of fenced blocks that name no language: formulas.
std::vector<std::string> formulas_of(const std::string& document) {
  std::vector<std::string> formulas;
  bool is_fenced = false, is_formula = false;
  for (const std::string& line : lines_of_document(document)) {
    if (line.starts_with("```")) {
      is_fenced = !is_fenced;
      is_formula = is_fenced && line == "```";
    } else if (is_formula) {
      formulas.push_back(line);
    }
  }
  return formulas;
}

// A new line of a formula is one that no function evaluates.
TEST(PrintedFormulas, AreAllEvaluated) {
  std::map<std::string, std::set<std::string>> evaluated;
  for (const Written& w : all_written())
    for (const From& from : w.from)
      for (const std::string& line : lines_of_text(from.text)) evaluated[from.document].insert(line);
  int checked = 0;
  for (const std::string& effect : rainref::test::packed_effects()) {
    const std::string document = "docs/effects/" + effect + ".md";
    for (const std::string& line : formulas_of(document)) {
      EXPECT_TRUE(evaluated[document].contains(line)) << document << ": no function evaluates\n" << line;
      ++checked;
    }
  }
  EXPECT_GT(checked, 200);
}

class PrintedFormulasOf : public testing::TestWithParam<rainref::test::PackPasses> {
 protected:
  const Pack pack{small_packs / GetParam().name};
  const std::string effect_and_variant = GetParam().effect_and_variant();
};

TEST_P(PrintedFormulasOf, AreThereForEachPass) {
  for (const std::string& pass : GetParam().passes) EXPECT_TRUE(written(effect_and_variant, pass)) << pass << " is written by nobody";
}

// Under ieee to the bit: the printed order of operations is the judged one.
TEST_P(PrintedFormulasOf, AreJudgedRight) {
  for (const char* profile : {"vulkan", "ieee"}) expect_pass(judged(pack, without_mistake, profile, GetParam().passes), effect_and_variant);
}

// What no port is judged by is compared here: floats in the printed order give the same bits.
TEST_P(PrintedFormulasOf, GiveTheDataToTheBit) {
  for (const PackCase& entry : pack.cases) {
    const Written* w = written(effect_and_variant, entry.pass);
    if (!w || !w->wrong.empty() || !GetParam().has(entry.pass)) continue;
    const PassCase c = pack.read(entry);
    const std::vector<capture::Array> arrays = given(*w, pack, c, "");
    for (std::size_t o = 0; o < arrays.size(); ++o) {
      EXPECT_EQ(c.outputs[o].judge, capture::Judge::input_only) << entry.pass;
      EXPECT_EQ(arrays[o].levels, c.outputs[o].array.levels) << c.folder() << ' ' << c.outputs[o].name;
    }
  }
}

TEST_P(PrintedFormulasOf, AreJudgedWrongWithOneWrongConstant) {
  const auto wrong_constant = [](const Written& w) { return w.wrong; };
  const PortJudgement j = judged(pack, wrong_constant, "vulkan", GetParam().passes);
  int wrong = 0;
  for (const PassJudgement& p : j.passes) {
    const Written* w = written(effect_and_variant, p.pass);
    if (!w || w->wrong.empty()) continue;
    EXPECT_EQ(p.status, Status::fail) << p.pass << ": " << w->wrong << ' ' << name(p.status) << ' ' << p.reason;
    ++wrong;
  }
  EXPECT_GT(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(SmallPacks, PrintedFormulasOf, testing::ValuesIn(rainref::test::proven_packs()), rainref::test::name_of_pack_test);

}  // namespace
}  // namespace rainref::documents
