#include "common/files/file_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "oracle/files.h"
#include "sdf_ccd/cancel.h"

namespace sdf_ccd::file_cache_test {

/// A directory in which somebody holds the lock of the file "thing".
class FileCacheTest : public ::testing::Test {
 protected:
  FileCacheTest() {
    lock_ = ::open((directory_ + "/thing.lock").c_str(), O_RDWR | O_CREAT, 0644);
    flock(lock_, LOCK_EX);
  }
  ~FileCacheTest() override { ::close(lock_); }

  FileCache::Actions actions() {
    return {[](const std::string&) {}, [this] { is_made_ = true; }, [this](const std::string&) { is_saved_ = true; }};
  }

  const test::TemporaryDirectory temporary_;
  const std::string directory_ = temporary_.string();
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

TEST_F(FileCacheTest, WhatIsThereNeedsNoLock) {
  std::ofstream(directory_ + "/thing") << "made";
  const CacheOutcome outcome = FileCache(directory_).get("thing", actions());
  EXPECT_TRUE(outcome.from_cache);
  EXPECT_EQ(outcome.warning, "");
  EXPECT_FALSE(is_made_);
}

TEST_F(FileCacheTest, WhatIsDamagedIsReadOnce) {
  flock(lock_, LOCK_UN);
  std::ofstream(directory_ + "/thing") << "damaged";
  int read = 0;
  FileCache::Actions damaged = actions();
  damaged.load = [&](const std::string&) {
    ++read;
    throw std::runtime_error("damaged");
  };
  const CacheOutcome outcome = FileCache(directory_).get("thing", damaged);
  EXPECT_EQ(read, 1);
  EXPECT_TRUE(is_saved_);
  EXPECT_EQ(outcome.warning, "rebuilt: damaged");
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

/// A cache of its own, whose files are text.
class TextCacheTest : public ::testing::Test {
 protected:
  CacheOutcome get(const std::string& name, std::size_t max_bytes = FileCache::kMaxBytes) {
    made_ = false;
    return FileCache(directory_, 1.0, max_bytes)
        .get(name, {[](const std::string&) {}, [this] { made_ = true; },
                    [](const std::string& path) { std::ofstream(path) << std::string(1000, 'x'); }});
  }
  bool has(const std::string& name) const { return std::filesystem::exists(directory_ + "/" + name); }
  void setAge(const std::string& name, int hours) const {
    std::filesystem::last_write_time(directory_ + "/" + name,
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
  }

  const test::TemporaryDirectory temporary_;
  const std::string base_ = temporary_.string(), directory_ = base_ + "/cache";
  bool made_ = false;
};

TEST_F(TextCacheTest, IsItsOwnersAlone) {
  EXPECT_EQ(get("a.field").file, "a.field");
  struct stat status {};
  ASSERT_EQ(::stat(directory_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u);
  EXPECT_TRUE(get("a.field").from_cache);
  EXPECT_EQ(get("a.field").file, "a.field");
  ASSERT_EQ(::chmod(directory_.c_str(), 0777), 0);
  const CacheOutcome outcome = get("a.field");
  EXPECT_TRUE(made_);
  EXPECT_FALSE(outcome.from_cache);
  EXPECT_EQ(outcome.file, "");
  EXPECT_NE(outcome.warning.find("other users can write to it"), std::string::npos) << outcome.warning;
}

TEST_F(TextCacheTest, FilesThatOthersMayWriteToAreMadeAgain) {
  get("a.field");
  for (const mode_t mode : {0666, 0602}) {
    ASSERT_EQ(::chmod((directory_ + "/a.field").c_str(), mode), 0);
    const CacheOutcome outcome = get("a.field");
    EXPECT_TRUE(made_);
    EXPECT_EQ(outcome.warning, "rebuilt: " + directory_ + "/a.field: other users can write to it");
  }
}

TEST_F(TextCacheTest, SaysWhatBelongsToAnotherUser) {
  if (::geteuid() != 0) return;  // only root can give files away
  constexpr uid_t kAnother = 65534;
  get("a.field");
  ASSERT_EQ(::chown((directory_ + "/a.field").c_str(), kAnother, -1), 0);
  EXPECT_EQ(get("a.field").warning, "rebuilt: " + directory_ + "/a.field: belongs to another user");
  ASSERT_EQ(::chown(directory_.c_str(), kAnother, -1), 0);
  EXPECT_EQ(get("a.field").warning, "cache unavailable: " + directory_ + ": belongs to another user");
}

TEST_F(TextCacheTest, FilesOfAGroupAreItsMembersToo) {
  if (::geteuid() != 0) return;  // only root can give files to a group that it is not in
  get("a.field");
  const std::string file = directory_ + "/a.field";
  ASSERT_EQ(::chmod(file.c_str(), 0664), 0);
  EXPECT_TRUE(get("a.field").from_cache);  // the process's own group
  ASSERT_EQ(::chown(file.c_str(), -1, 65534), 0);
  EXPECT_EQ(get("a.field").warning, "rebuilt: " + file + ": other users can write to it");
}

TEST_F(TextCacheTest, OthersCannotHoldALock) {
  get("a.field");
  struct stat status {};
  ASSERT_EQ(::stat((directory_ + "/a.field.lock").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST_F(TextCacheTest, LinksAreNotFollowed) {
  get("a.field");
  std::ofstream(base_ + "/elsewhere") << "mine";
  std::filesystem::create_symlink(base_ + "/elsewhere", directory_ + "/b.field");
  const CacheOutcome outcome = get("b.field");
  EXPECT_TRUE(made_);
  EXPECT_NE(outcome.warning.find("is a symbolic link"), std::string::npos) << outcome.warning;
  std::filesystem::create_symlink(base_ + "/elsewhere", directory_ + "/c.field.lock");
  EXPECT_NE(get("c.field").warning.find("cache unavailable"), std::string::npos);
}

TEST_F(TextCacheTest, WhatWasNotUsedForLongestGoes) {
  for (const char* name : {"a.field", "b.field", "c.shell"}) get(name);
  setAge("a.field", 3);
  setAge("b.field", 5);
  setAge("c.shell", 4);
  std::ofstream(directory_ + "/b.field.doubt") << "doubt";
  std::ofstream(directory_ + "/notes.txt") << std::string(5000, 'x');
  std::ofstream(directory_ + "/a.field.abcdef") << "left";
  setAge("a.field.abcdef", 2);
  EXPECT_TRUE(get("b.field").from_cache);  // used now
  get("d.field", 2500);
  EXPECT_TRUE(has("b.field") && has("b.field.doubt") && has("d.field") && has("notes.txt"));
  EXPECT_FALSE(has("a.field") || has("c.shell") || has("c.shell.lock") || has("a.field.abcdef"));
}

}  // namespace sdf_ccd::file_cache_test
