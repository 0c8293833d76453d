#include "sdf_ccd/field/file_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "sdf_ccd/geometry/cancel.h"

namespace sdf_ccd {
namespace {

/// A directory in which somebody holds the lock of the file "thing".
class FileCacheTest : public ::testing::Test {
 protected:
  FileCacheTest() {
    char name[] = "/tmp/file_cache_test.XXXXXX";
    directory_ = mkdtemp(name);
    lock_ = ::open((directory_ + "/thing.lock").c_str(), O_RDWR | O_CREAT, 0644);
    flock(lock_, LOCK_EX);
  }
  ~FileCacheTest() override {
    ::close(lock_);
    std::filesystem::remove_all(directory_);
  }

  FileCache::Actions actions() {
    return {[](const std::string&) {}, [this] { is_made_ = true; }, [this](const std::string&) { is_saved_ = true; }};
  }

  std::string directory_;
  int lock_;
  bool is_made_ = false, is_saved_ = false;
};

TEST_F(FileCacheTest, WhoWaitsForALockCanBeCancelled) {
  std::atomic<bool> asked{false};
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    asked = true;
  });
  const CancelScope scope(asked);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(FileCache(directory_).get("thing", actions()), Cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  other.join();
  EXPECT_FALSE(is_made_);
}

TEST_F(FileCacheTest, ALockThatIsNeverFreedIsNotWaitedForForEver) {
  const CacheOutcome outcome = FileCache(directory_, 0.1).get("thing", actions());
  EXPECT_TRUE(is_made_);
  EXPECT_FALSE(is_saved_);
  EXPECT_NE(outcome.warning.find("another process has held it for 0.1 s"), std::string::npos) << outcome.warning;
}

TEST_F(FileCacheTest, ALockThatIsFreedInTimeIsTaken) {
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    flock(lock_, LOCK_UN);
  });
  const CacheOutcome outcome = FileCache(directory_).get("thing", actions());
  other.join();
  EXPECT_EQ(outcome.warning, "");
  EXPECT_TRUE(is_saved_);
}

}  // namespace
}  // namespace sdf_ccd
