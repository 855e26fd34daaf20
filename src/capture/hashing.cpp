#include "capture/hashing.h"

#include <algorithm>

#include <fmt/format.h>

namespace rainref::capture {
namespace {

void add_buffer(Hasher& hasher, const BufferView& buffer) {
  if (buffer.parts.size() == 1 && buffer.parts.front()->format() == buffer.format) {  // stored rows are used directly
    for (int y = 0; y < buffer.height(); ++y) hasher.add(std::span(buffer.parts.front()->row_bytes(y), buffer.row_bytes()));
    return;
  }
  std::vector<std::byte> row(buffer.row_bytes());
  for (int y = 0; y < buffer.height(); ++y) {
    buffer.copy_row(y, row.data());
    hasher.add(row);
  }
}

}  // namespace

Hash128 hash_of(const BufferView& buffer) {
  Hasher hasher;
  add_buffer(hasher, buffer);
  return hasher.finish();
}

std::string HashLine::text() const { return fmt::format("{} {} {} {}", frame, pass, buffer, hash.text()); }

void HashRecorder::pass(const PassCall& call) {
  auto time = std::find_if(times_.begin(), times_.end(), [&](const Time& t) { return t.pass == call.pass; });
  if (time == times_.end()) time = times_.insert(times_.end(), {std::string(call.pass)});
  time->seconds += call.seconds;
  ++time->calls;
  if (!hashing_) return;
  for (const PassOutput& output : call.outputs) {
    auto open = std::find_if(open_.begin(), open_.end(),
                             [&](const Open& o) { return o.frame == call.frame && o.pass == call.pass && o.buffer == output.name; });
    if (open == open_.end()) {
      open = open_.insert(open_.end(), {call.frame, std::string(call.pass), std::string(output.name), std::make_unique<Hasher>()});
    }
    if (const auto* buffer = std::get_if<BufferView>(&output.content))
      add_buffer(*open->hasher, *buffer);
    else
      open->hasher->add(std::get<RecordView>(output.content).bytes());
  }
}

std::vector<HashLine> HashRecorder::take_lines() {
  std::vector<HashLine> lines;
  for (const Open& o : open_) {
    lines.push_back({o.frame, o.pass, o.buffer, o.hasher->finish()});
    scene_.add(lines.back().text());
    scene_.add("\n");
  }
  open_.clear();
  return lines;
}

}  // namespace rainref::capture
