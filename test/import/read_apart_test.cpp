#include "mesh/import/read_apart.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <thread>

#include "import/fake_reader.h"
#include "mesh/import/read_answer.h"
#include "oracle/failure.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"
#include "sdf_ccd/cancel.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::read_apart_test {

using Clock = std::chrono::steady_clock;

const std::string kBox = test::binaryStl(test::boxMesh({1, 2, 3}), "box");

std::string failureOf(const std::string& format, const std::string& bytes) {
  return test::failureOf([&] { readSandboxed(format, bytes); });
}

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A zigzag polygon without area, for which ear clipping takes minutes.
std::string longReading() {
  std::string off = "OFF\n10000 1 0\n", face = "10000";
  for (int i = 0; i < 10000; ++i) {
    const double angle = 0.01 * i * (i % 2 ? 1 : -1);
    off += std::to_string(std::cos(angle) * (1 + i)) + " " + std::to_string(std::sin(angle) * (1 + i % 97)) + " 0\n";
    face += " " + std::to_string(i);
  }
  return off + face + "\n";
}

/// Runs `action` in a child process, where it may change signals, files and limits. @return its result.
bool inProcess(const std::function<bool()>& action) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    bool good = false;
    try {
      good = action();
    } catch (...) {
    }
    ::_exit(good ? 0 : 1);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Child processes of a process that are not reaped yet.
std::vector<pid_t> childrenOf(pid_t pid) {
  std::vector<pid_t> children;
  std::error_code error;
  for (std::filesystem::directory_iterator task("/proc/" + std::to_string(pid) + "/task", error), end;
       !error && task != end; task.increment(error)) {
    std::ifstream list(task->path() / "children");
    for (pid_t child; list >> child;) children.push_back(child);
  }
  return children;
}

pid_t waitForChild(pid_t of) {
  const auto start = Clock::now();
  while (childrenOf(of).empty() && secondsSince(start) < 5.0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  // Until the child has called exec(), it is a copy of the host.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  return childrenOf(of).empty() ? -1 : childrenOf(of).front();
}

using ReadApart = test::FakeReader;

TEST_F(ReadApart, GivesTheMesh) {
  EXPECT_EQ(readSandboxed("stl", kBox).mesh.triangles.size(), 12u);
  EXPECT_NEAR(signedVolume(readSandboxed("stl", kBox).mesh), 48.0, 1e-9);
}

TEST_F(ReadApart, WhateverEndsTheReaderIsAnErrorThatSaysSo) {
  fake("kill -SEGV $$");
  EXPECT_EQ(failureOf("stl", kBox), "the reader crashed (SIGSEGV)");
  fake("kill -ABRT $$");
  EXPECT_EQ(failureOf("stl", kBox), "the reader crashed (SIGABRT)");
  fake("kill -XCPU $$");
  EXPECT_NE(failureOf("stl", kBox).find("the reader was stopped: it needed more than 5"), std::string::npos);
  fake("kill -KILL $$");
  EXPECT_NE(failureOf("stl", kBox).find("killed (SIGKILL)"), std::string::npos);
  fake("exit 3");
  EXPECT_EQ(failureOf("stl", kBox), "the reader was stopped: it needed more than 512 MiB");
  fake("exit 7");
  EXPECT_EQ(failureOf("stl", kBox), "the reader ended without an answer (exit code 7)");
}

TEST_F(ReadApart, WithoutTheProgramNothingIsRead) {
  ::setenv("SDF_CCD_READER", "/no/such/reader", 1);
  EXPECT_EQ(failureOf("stl", kBox), "/no/such/reader cannot be started: No such file or directory");
  EXPECT_EQ(test::failureOf([] { parseMesh(kBox, "a.stl"); }),
            "a.stl: /no/such/reader cannot be started: No such file or directory");
}

TEST_F(ReadApart, AnswersAreNotBelieved) {
  const auto answer = [&](const ReadAnswer& head, const std::string& rest) {
    write("answer", std::string(reinterpret_cast<const char*>(&head), sizeof head) + rest);
    fake("exec cat '" + (directory_ / "answer").string() + "'");
    return failureOf("stl", kBox);
  };
  const auto bytesOf = [](const auto& values) {
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  std::vector<double> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<std::int32_t> triangle = {0, 1, 2};
  ReadAnswer head;
  head.vertices = 3;
  head.triangles = 1;
  EXPECT_EQ(answer(head, bytesOf(corners) + bytesOf(triangle)), "");
  EXPECT_NE(answer(head, bytesOf(corners)).find("without an answer"), std::string::npos);
  EXPECT_NE(answer({}, "").find("no triangle"), std::string::npos);
  for (const std::int32_t bad : {3, -1, std::numeric_limits<std::int32_t>::max()}) {
    triangle[1] = bad;
    EXPECT_NE(answer(head, bytesOf(corners) + bytesOf(triangle)).find("refers to vertex"), std::string::npos);
  }
  triangle[1] = 1;
  corners[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(answer(head, bytesOf(corners) + bytesOf(triangle)).find("not finite"), std::string::npos);
  ReadAnswer other = head;
  other.magic += 1;
  EXPECT_NE(answer(other, "").find("another version"), std::string::npos);
  other = head;
  other.vertices = ~std::uint64_t{0};
  EXPECT_NE(answer(other, "").find("needed more than"), std::string::npos);
  other.vertices = std::uint64_t{1} << 25;  // 768 MB
  EXPECT_NE(answer(other, "").find("needed more than"), std::string::npos);
  other.vertices = std::uint64_t{1} << 24;  // 512 MB are announced, but memory is taken only for data that arrives
  EXPECT_NE(answer(other, "").find("without an answer"), std::string::npos);
  other = {};
  other.reason_bytes = ~std::uint64_t{0};
  EXPECT_EQ(answer(other, std::string(5000, '\033')), std::string(1000, '?'));
  fake("exec cat /dev/zero");
  EXPECT_NE(failureOf("stl", kBox).find("another version"), std::string::npos);
}

TEST_F(ReadApart, SilentReaderIsLeftWhenCancelled) {
  fake("exec sleep 100");
  std::atomic<bool> asked{false};
  Clock::time_point start;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    start = Clock::now();
    asked = true;
  });
  const CancelScope scope(asked);
  EXPECT_THROW(readSandboxed("stl", kBox), Cancelled);
  canceller.join();
  EXPECT_LT(secondsSince(start), 0.15);
  EXPECT_TRUE(childrenOf(::getpid()).empty());
}

TEST_F(ReadApart, ManyThreadsAtOnce) {
  std::atomic<int> good{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      const double width = 1.0 + i;
      const std::string bytes = test::binaryStl(test::boxMesh({width, 1, 1}), "box");
      for (int round = 0; round < 20; ++round) {
        good += std::abs(signedVolume(readSandboxed("stl", bytes).mesh) - 8.0 * width) < 1e-6;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 160);
  EXPECT_TRUE(childrenOf(::getpid()).empty());
}

TEST_F(ReadApart, WhateverTheHostDoesWithSignalsAndStandardFiles) {
  const auto reads = [] { return readSandboxed("stl", kBox).mesh.triangles.size() == 12; };
  EXPECT_TRUE(inProcess([&] { return ::signal(SIGCHLD, SIG_IGN) != SIG_ERR && reads(); }));
  EXPECT_TRUE(inProcess([&] { return ::signal(SIGPIPE, SIG_DFL) != SIG_ERR && reads(); }));
  EXPECT_TRUE(inProcess([&] {
    sigset_t all;
    ::sigfillset(&all);
    return ::pthread_sigmask(SIG_BLOCK, &all, nullptr) == 0 && reads();
  }));
  for (unsigned closed = 1; closed < 8; ++closed) {
    EXPECT_TRUE(inProcess([&] {
      for (int file = 0; file < 3; ++file) {
        if (closed >> file & 1) ::close(file);
      }
      return reads() && reads();
    })) << closed;
  }
  // A child of the host that ends meanwhile is not reaped by the library.
  EXPECT_TRUE(inProcess([&] {
    const pid_t other = ::fork();
    if (other == 0) ::_exit(5);
    const bool good = reads();
    int status = 0;
    return ::waitpid(other, &status, 0) == other && WEXITSTATUS(status) == 5 && good;
  }));
}

TEST_F(ReadApart, WhereProcessesAndFilesAreUsedUpItSaysSo) {
  EXPECT_TRUE(inProcess([] {
    const struct rlimit none = {3, 3};
    ::setrlimit(RLIMIT_NOFILE, &none);
    return failureOf("stl", kBox).find("Too many open files") != std::string::npos;
  }));
  if (::getuid() != 0) GTEST_SKIP() << "only root can become a user whose processes are used up";
  EXPECT_TRUE(inProcess([] {
    const struct rlimit none = {0, 0};
    ::setrlimit(RLIMIT_NPROC, &none);
    if (::setuid(65534) != 0) return false;
    return failureOf("stl", kBox).find("cannot be started: ") != std::string::npos;
  }));
}

TEST_F(ReadApart, ReaderThatIsKilledMidReadIsAnError) {
  const std::string bytes = longReading();
  std::thread killer([] {
    const pid_t child = waitForChild(::getpid());
    if (child > 0) ::kill(child, SIGKILL);
  });
  EXPECT_NE(failureOf("off", bytes).find("killed (SIGKILL)"), std::string::npos);
  killer.join();
}

TEST_F(ReadApart, ReaderEndsWithItsHost) {
  const pid_t host = ::fork();
  if (host == 0) {
    failureOf("off", longReading());
    ::_exit(0);
  }
  const pid_t child = waitForChild(host);
  ASSERT_GT(child, 0);
  ::kill(host, SIGKILL);
  ::waitpid(host, nullptr, 0);
  const auto start = Clock::now();
  const auto isAlive = [&] {
    std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
    std::string number, name, state;
    return stat >> number >> name >> state && state != "Z";
  };
  while (isAlive() && secondsSince(start) < 2.0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_LT(secondsSince(start), 1.0);
}

TEST_F(ReadApart, MemoryIsBounded) {
  // 2,000 triangles, instantiated 90,000 times.
  std::string nodes;
  for (int i = 0; i < 300; ++i) nodes += "<instance_node url=\"#many\"/>";
  std::string many = "<node id=\"many\">";
  for (int i = 0; i < 300; ++i) many += test::kDaeInstance;
  many += "</node>";
  const std::string bomb = test::dae(test::icosphere(1.0, 3), "", many + "<node>" + nodes + "</node>");
  EXPECT_EQ(failureOf("dae", bomb), "the reader was stopped: it needed more than " +
                                        std::to_string(512 + 32 * bomb.size() / (1 << 20)) + " MiB");
}

TEST_F(ReadApart, ComputingIsBounded) {
  const auto start = Clock::now();
  EXPECT_NE(failureOf("off", longReading()).find(" s of computing"), std::string::npos);
  EXPECT_LT(secondsSince(start), 60.0);
}

}  // namespace sdf_ccd::read_apart_test
