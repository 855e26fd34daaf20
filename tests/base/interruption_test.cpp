// A signal undoes what was begun, newest first, and the process dies of that signal.
#include "base/interruption.h"

#include <memory>
#include <thread>

#include "base/child_process.h"
#include "base/signals.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

/// Appends to a file, so that another process can see the order.
void note(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::app) << text; }

TEST(Interruption, UndoesTheNewestFirstAndDiesOfTheSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const Signpost ready;
    ChildProcess child([&] {
      undo_when_interrupted();
      const Undo first([&] { note(folder / "done", "first "); });
      const Undo broken([] { throw std::runtime_error("no"); });
      auto over = std::make_unique<Undo>([&] { note(folder / "done", "over "); });
      const Undo last([&] { note(folder / "done", "last "); });
      over.reset();
      ready.reach();
      return sleep_for_ever();
    });
    ready.await();
    EXPECT_EQ(child.end(signal), -signal);
    EXPECT_EQ(contents(folder / "done"), "last first ");
  }
}

// `timeout` sends its signal to the process and to its group.
TEST(Interruption, ASecondSignalDoesNotCutTheCleaningShort) {
  const TemporaryFolder folder;
  const Signpost ready;
  ChildProcess child([&] {
    undo_when_interrupted();
    const Undo undo([&] {
      ::kill(::getpid(), SIGTERM);
      ::kill(::getpid(), SIGINT);
      note(folder / "done", "all");
    });
    ready.reach();
    return sleep_for_ever();
  });
  ready.await();
  EXPECT_EQ(child.end(SIGINT), -SIGINT);
  EXPECT_EQ(contents(folder / "done"), "all");
}

TEST(Interruption, WhatIsIgnoredStaysIgnored) {
  ChildProcess child([] {
    ::signal(SIGHUP, SIG_IGN);
    undo_when_interrupted();
    const Undo undo([] { ::_exit(7); });
    ::kill(::getpid(), SIGHUP);
    std::this_thread::yield();
    return 0;
  });
  EXPECT_EQ(child.wait(), 0);
}

TEST(Interruption, WaitsForAScopeThatMayNotBeCut) {
  const TemporaryFolder folder;
  ChildProcess child([&] {
    undo_when_interrupted();
    const Undo undo([&] { note(folder / "done", "undone"); });
    {
      const Uninterrupted outer, inner;
      ::kill(::getpid(), SIGTERM);
      for (int i = 0; i < 1000; ++i) std::this_thread::yield();
      note(folder / "done", "made ");
    }
    return sleep_for_ever();
  });
  EXPECT_EQ(child.wait(), -SIGTERM);
  EXPECT_EQ(contents(folder / "done"), "made undone");
}

TEST(Interruption, AProgramThatIsStartedTakesSignalsAsEver) {
  ChildProcess child([] {
    undo_when_interrupted();
    ChildProcess grandchild([] {
      take_signals_again();
      ::execl("/bin/sh", "sh", "-c", "kill -TERM $$; exit 5", static_cast<char*>(nullptr));
      return 98;
    });
    return grandchild.wait() == -SIGTERM ? 0 : 1;
  });
  EXPECT_EQ(child.wait(), 0);
}

}  // namespace
}  // namespace rainref
