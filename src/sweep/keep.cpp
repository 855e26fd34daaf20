#include "sweep/keep.h"

#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/number_text.h"

namespace rainref::sweep {
namespace {

constexpr std::array names{"picture", "exr", "buffer", "drops", "hash"};
constexpr std::string_view forms = "'picture', 'exr', 'exr:CHANNEL', 'buffer:NAME', 'drops' or 'hash', with '@every=K' or '@all' behind it";

[[noreturn]] void refuse(const std::string& text, const SourceLocation& at, const std::string& more = "") {
  throw Error(ExitCode::usage, at, fmt::format("keep: expected {}, found '{}'{}", forms, text, more));
}

}  // namespace

std::string Keep::text() const {
  std::string out = names[static_cast<std::size_t>(what)];
  if (!part.empty()) out += ":" + part;
  if (what != What::hash && every > 0) out += every == 1 ? "@all" : fmt::format("@every={}", every);
  return out;
}

std::string Keep::file(std::int64_t frame) const {
  constexpr std::array endings{"png", "exr", "npy", "json", "txt"};
  const std::string stem = !part.empty() ? part : what == What::drops ? "drops" : "picture";
  return fmt::format("{}.{:06}.{}", stem, frame, endings[static_cast<std::size_t>(what)]);
}

Keep keep_from(const std::string& text, const SourceLocation& at) {
  Keep keep;
  keep.at = at;
  const std::size_t sign = text.find('@'), colon = text.substr(0, sign).find(':');
  const std::string word = text.substr(0, std::min(sign, colon));
  const std::vector<std::string> known(names.begin(), names.end());
  std::size_t i = 0;
  while (i < names.size() && word != names[i]) ++i;
  if (i == names.size()) refuse(text, at, did_you_mean(word, known));
  keep.what = static_cast<Keep::What>(i);
  if (colon != std::string::npos) {
    keep.part = text.substr(colon + 1, sign == std::string::npos ? sign : sign - colon - 1);
    if (keep.part.empty() || (keep.what != Keep::What::buffer && keep.what != Keep::What::exr)) refuse(text, at);
  }
  if (keep.what == Keep::What::buffer && keep.part.empty()) refuse(text, at);
  if (sign == std::string::npos) return keep;
  const std::string frames = text.substr(sign + 1);
  if (keep.what == Keep::What::hash) refuse(text, at, "; hashes are of every frame");
  if (frames == "all") {
    keep.every = 1;
  } else {
    const std::string_view number = frames.starts_with("every=") ? std::string_view(frames).substr(6) : std::string_view();
    keep.every = whole_from<std::int64_t>(number).value_or(0);
    if (keep.every < 1 || keep.every > 1000000) refuse(text, at);
  }
  return keep;
}

}  // namespace rainref::sweep
