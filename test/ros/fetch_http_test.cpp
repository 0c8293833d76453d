#include "ros/world/fetch_http.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "ros/world/describe_scene.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd::fetch_http_test {

using test::failureOf;
using Clock = std::chrono::steady_clock;

/// A local server that answers one request by the given function.
class Server {
 public:
  explicit Server(const std::function<void(int)>& answer) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(socket_, 4), 0);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, answer] {
      const int client = ::accept(socket_, nullptr, nullptr);
      if (client < 0) return;
      char request[4096];
      [[maybe_unused]] const ssize_t count = ::recv(client, request, sizeof request, 0);
      answer(client);
      ::close(client);
    });
  }
  ~Server() {
    ::shutdown(socket_, SHUT_RDWR);
    thread_.join();
    ::close(socket_);
  }

  std::string uri() const { return "http://127.0.0.1:" + std::to_string(port_) + "/link.stl"; }

 private:
  int socket_;
  int port_ = 0;
  std::thread thread_;
};

bool send(int client, const std::string& bytes) {
  return ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

class FetchHttp : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("no_proxy", "*", 1); }
};

TEST_F(FetchHttp, GivesTheContent) {
  const std::string bytes(100'000, 'x');
  const Server server([&](int client) {
    send(client, "HTTP/1.0 200 OK\r\nContent-Length: " + std::to_string(bytes.size()) + "\r\n\r\n" + bytes);
  });
  EXPECT_EQ(fetchHttp(server.uri()), bytes);
}

TEST_F(FetchHttp, IsOnlyDoneWhereItIsAllowed) {
  const ResourceLoader loader = makeResourceLoader(nullptr, "", false);
  for (const char* scheme : {"http", "https"}) {
    const std::string uri = std::string(scheme) + "://127.0.0.1:1/link.stl";
    EXPECT_EQ(failureOf([&] { loader(uri); }),
              uri +
                  ": http and https are only downloaded if the parameter allow_http is true (sdf_ccd reads it from "
                  "--config)");
  }
  const std::string long_uri = "http://127.0.0.1:1/" + std::string(1 << 20, 'a');
  EXPECT_LT(failureOf([&] { loader(long_uri); }).size(), 1000u);
  EXPECT_LT(failureOf([&] { makeResourceLoader(nullptr, "", true)(long_uri); }).size(), 1000u);
  EXPECT_EQ(failureOf([&] {
              makeResourceLoader(nullptr, "", true)("http://127.0.0.1:1/a.stl");
            }).rfind("http://127.0.0.1:1/a.stl: ", 0),
            0u);
}

TEST_F(FetchHttp, SilentServerIsLeftInTime) {
  std::atomic<bool> done{false};
  const auto wait = [&](int) {
    while (!done) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  {
    const Server server(wait);
    EXPECT_EQ(failureOf([&] { fetchHttp(server.uri(), {0.5}); }), "not downloaded within 0.5 s");
    done = true;
  }
  done = false;
  const Server server(wait);
  std::atomic<bool> asked{false};
  Clock::time_point start;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    start = Clock::now();
    asked = true;
  });
  {
    const CancelScope scope(asked);
    EXPECT_THROW(fetchHttp(server.uri()), Cancelled);
  }
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 0.15);
  canceller.join();
  done = true;
}

TEST_F(FetchHttp, EndlessContentIsLeftAtTheLimit) {
  const Server server([](int client) {
    const std::string chunk(1 << 16, 'x');
    for (bool good = send(client, "HTTP/1.0 200 OK\r\n\r\n"); good;) good = send(client, chunk);
  });
  const std::string reason = failureOf([&] { fetchHttp(server.uri(), {20.0, 1 << 20}); });
  EXPECT_NE(reason, "");
  EXPECT_LT(reason.size(), 1000u);
}

TEST_F(FetchHttp, WithoutTheProgramNothingIsFetched) {
  ::setenv("SDF_CCD_FETCH", "/no/such/program", 1);
  EXPECT_EQ(failureOf([] { fetchHttp("http://127.0.0.1:1/a.stl"); }),
            "/no/such/program cannot be started: No such file or directory");
  ::unsetenv("SDF_CCD_FETCH");
}

}  // namespace sdf_ccd::fetch_http_test
