// Children of a supervisor: started with what they need, ended with their parent.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <string>

#include "core/errors.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vpdr/supervisor/child_process.hpp"

namespace vpdr::tool {
namespace {

using namespace std::chrono_literals;
using vpdr::testing::TemporaryFolder;

constexpr int kPatienceMs = 60'000;

TEST(ChildProcess, OutputAndErrorsAreInTheLog) {
  const TemporaryFolder folder;
  ChildProcess child("echo", "/bin/sh", {"-c", "echo out; echo err >&2; exit 7"},
                     folder.path() / "log");
  EXPECT_EQ(child.wait(60s), 7);
  EXPECT_EQ(child.last_lines(5), "  out\n  err\n");
}

TEST(ChildProcess, WhatCannotBeStartedIsNamed) {
  const TemporaryFolder folder;
  try {
    ChildProcess child("nobody", folder.path() / "nobody", {}, folder.path() / "log");
    FAIL() << "it started";
  } catch (const FileFault& fault) {
    EXPECT_NE(std::string(fault.what()).find("nobody: cannot be started: No such file"),
              std::string::npos)
        << fault.what();
  }
  EXPECT_THROW(ChildProcess("true", "/bin/true", {}, folder.path() / "none" / "log"), FileFault);
}

TEST(ChildProcess, ChildrenOfAKilledParentEndInOrder) {
  const TemporaryFolder folder;
  const auto fifo = folder.path() / "ready";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    const std::string script = "trap 'echo ended in order; exit 0' TERM; echo ready >" +
                               fifo.string() + "; while :; do sleep 0.1; done";
    const ChildProcess child("sh", "/bin/sh", {"-c", script}, folder.path() / "log");
    const pid_t pid = child.pid();
    if (write(ends[1], &pid, sizeof pid) != sizeof pid) _exit(1);
    for (;;) pause();
  }
  pid_t child = -1;
  ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  ASSERT_GE(descriptor, 0);
  std::string word;
  std::ifstream(fifo) >> word;
  ASSERT_EQ(word, "ready");
  pollfd ended{descriptor, POLLIN, 0};
  EXPECT_EQ(poll(&ended, 1, 0), 0) << "it ended by itself";
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  EXPECT_EQ(poll(&ended, 1, kPatienceMs), 1) << "it goes on without its parent";
  std::stringstream log;
  log << std::ifstream(folder.path() / "log").rdbuf();
  EXPECT_NE(log.str().find("ended in order\n"), std::string::npos) << log.str();
  close(descriptor);
  close(ends[0]);
  close(ends[1]);
}

}  // namespace
}  // namespace vpdr::tool
