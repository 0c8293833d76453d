// Loads and unloads the nodelet like a manager; tests how long that takes and what it leaves behind.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <random>
#include <thread>

#include <nodelet/loader.h>
#include <ros/ros.h>

#include "oracle/busy_machine.h"
#include "oracle/files.h"
#include "sdf_ccd/MonitorState.h"
#include "sdf_ccd/Plan.h"

namespace sdf_ccd::unload_test {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kSoon = 0.2;  // [s]
const char* const kName = "/monitor";

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Memory allocated in all heaps of this process [MB]. The number of its pages is less reliable: how the heaps fill
/// depends on which thread allocated what, and differs by a megabyte from run to run.
double allocatedMemory() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / 1e6;
}

class UnloadTest : public ::testing::Test {
 protected:
  UnloadTest() {
    states_ =
        node_.subscribe<MonitorState>(std::string(kName) + "/state", 100, [this](const MonitorState::ConstPtr& state) {
          const std::lock_guard<std::mutex> lock(mutex_);
          reasons_ += state->reason + "\n";
          changed_.notify_all();
        });
  }

  void load(double accuracy) {  // 0: keep the present settings
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      reasons_.clear();
    }
    const ros::NodeHandle monitor(kName);
    monitor.setParam("cache_directory", cache_);
    if (accuracy > 0.0) {
      monitor.setParam("contact/accuracy", accuracy);
    } else {
      monitor.deleteParam("contact");
    }
    ASSERT_TRUE(loader_.load(kName, "sdf_ccd/CollisionMonitor", {}, {}));
  }

  /// @return the time it takes [s].
  double unload() {
    const Clock::time_point start = Clock::now();
    EXPECT_TRUE(loader_.unload(kName));
    return secondsSince(start);
  }

  void waitFor(const std::string& word) {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool is_said =
        changed_.wait_for(lock, std::chrono::seconds(60), [&] { return reasons_.find(word) != std::string::npos; });
    ASSERT_TRUE(is_said) << word << " is not among\n" << reasons_;
  }

  ros::NodeHandle node_;
  ros::Subscriber states_;
  nodelet::Loader loader_{false};
  const test::TemporaryDirectory temporary_;
  const std::string cache_ = temporary_.string();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string reasons_;  // of all states, one per line
};

TEST_F(UnloadTest, EndsSoonWhileItBuilds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment(0.0, 4.0);
  for (int i = 0; i < 12; ++i) {
    load(1.2e-3);
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    EXPECT_LT(unload(), kSoon * test::slowness());
  }
}

TEST_F(UnloadTest, EndsSoonWhileAnotherProcessHoldsTheCache) {
  load(5e-3);
  waitFor("waiting for transforms");
  unload();
  std::vector<int> locks;
  for (const auto& entry : fs::directory_iterator(cache_)) {
    if (entry.path().extension() != ".lock") continue;
    locks.push_back(::open(entry.path().c_str(), O_RDWR));
    flock(locks.back(), LOCK_EX);
  }
  ASSERT_FALSE(locks.empty());
  load(5e-3);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_LT(unload(), kSoon * test::slowness());
  for (const int lock : locks) ::close(lock);
}

TEST_F(UnloadTest, LeavesNothingBehind) {
  std::vector<double> sizes;
  for (int i = 0; i < 24; ++i) {
    load(0.0);
    waitFor("waiting for transforms");
    EXPECT_LT(unload(), kSoon * test::slowness());
    sizes.push_back(allocatedMemory());
  }
  std::string text;
  for (const double size : sizes) text += std::to_string(size) + " ";
  // Memory that is allocated once per process or thread comes first.
  const double early = *std::max_element(sizes.begin() + 8, sizes.begin() + 16);
  const double late = *std::max_element(sizes.begin() + 16, sizes.end());
  EXPECT_LT(late, early + 0.05) << text;
}

/// Two robots of the same kind in one manager, distinguished by namespaces and the prefix of their frames.
TEST_F(UnloadTest, TwoOfAKindShareTheirBodies) {
  const std::vector<std::string> names = {"/left/monitor", "/right/monitor"};
  std::map<std::string, Plan> plans;
  std::map<std::string, std::string> frames;
  std::vector<ros::Subscriber> subscribers;
  for (const std::string& name : names) {
    subscribers.push_back(node_.subscribe<Plan>(name + "/plan", 10, [&, name](const Plan::ConstPtr& plan) {
      const std::lock_guard<std::mutex> lock(mutex_);
      plans[name] = *plan;
      changed_.notify_all();
    }));
    subscribers.push_back(
        node_.subscribe<MonitorState>(name + "/state", 100, [&, name](const MonitorState::ConstPtr& state) {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (state->reason == "waiting for transforms") frames[name] = state->header.frame_id;
          changed_.notify_all();
        }));
  }
  std::vector<double> memory = {allocatedMemory()};
  for (const std::string& name : names) {
    const ros::NodeHandle monitor(name);
    monitor.setParam("cache", false);
    monitor.setParam("contact/accuracy", 2e-3);
    monitor.setParam("tf_prefix", name.substr(1, name.find('/', 1) - 1));
    ASSERT_TRUE(loader_.load(name, "sdf_ccd/CollisionMonitor", {}, {}));
    std::unique_lock<std::mutex> lock(mutex_);
    const auto has_all = [&] {
      const std::vector<PlanBody>& bodies = plans[name].bodies;
      const bool awaits_forces = std::any_of(bodies.begin(), bodies.end(), [](const PlanBody& body) {
        return body.field.state == PlanPart::AWAITED || body.shell.state == PlanPart::AWAITED;
      });
      return !bodies.empty() && !awaits_forces && frames.count(name) > 0;
    };
    ASSERT_TRUE(changed_.wait_for(lock, std::chrono::seconds(60), has_all));
    lock.unlock();
    ::malloc_trim(0);
    memory.push_back(allocatedMemory());
  }
  EXPECT_EQ(frames["/left/monitor"], "left/base");
  EXPECT_EQ(frames["/right/monitor"], "right/base");
  const auto count = [&](const std::string& name, const std::string& field) {
    const std::vector<PlanBody>& bodies = plans[name].bodies;
    return std::count_if(bodies.begin(), bodies.end(),
                         [&](const PlanBody& body) { return body.field.text.find(field) != std::string::npos; });
  };
  EXPECT_GT(count("/left/monitor", "built"), 0);
  EXPECT_EQ(count("/right/monitor", "built"), 0) << "nothing is made twice";
  EXPECT_GE(count("/right/monitor", "shared"), count("/left/monitor", "built"));
  RecordProperty("first_kb", static_cast<int>(1e3 * (memory[1] - memory[0])));
  RecordProperty("second_kb", static_cast<int>(1e3 * (memory[2] - memory[1])));
  EXPECT_LT(memory[2] - memory[1], 0.3 * (memory[1] - memory[0]));
  EXPECT_TRUE(loader_.unload(names[0]));
  EXPECT_TRUE(loader_.unload(names[1]));
}

}  // namespace sdf_ccd::unload_test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "unload_test");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
