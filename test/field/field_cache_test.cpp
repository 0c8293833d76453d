#include "field/field_cache.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "field/field_file_case.h"
#include "oracle/files.h"
#include "oracle/open_shapes.h"

namespace sdf_ccd::field_cache_test {

namespace fs = std::filesystem;
using test::expectSame;

class FieldCache : public test::FieldFileCase {};

TEST_F(FieldCache, BuildsOnceAndRebuildsDamage) {
  const FileCache cache(path("cache"));
  const CachedField first = cachedField(cache, mesh_, options_);
  EXPECT_FALSE(first.outcome.from_cache);
  EXPECT_EQ(first.outcome.warning, "");
  const CachedField second = cachedField(cache, mesh_, options_);
  EXPECT_TRUE(second.outcome.from_cache);
  expectSame(first.field, second.field);

  const std::string file = path("cache/") + fieldFileName(mesh_, options_);
  std::string bytes = test::readText(file);
  bytes[bytes.size() / 2] ^= 1;
  test::writeText(file, bytes);
  const CachedField third = cachedField(cache, mesh_, options_);
  EXPECT_FALSE(third.outcome.from_cache);
  EXPECT_NE(third.outcome.warning.find("damaged"), std::string::npos);
  expectSame(first.field, third.field);
  EXPECT_TRUE(cachedField(cache, mesh_, options_).outcome.from_cache);
}

/// A cached file is identified by its name: if two are swapped, neither is used.
TEST_F(FieldCache, FilesUnderOthersNamesAreMadeAgain) {
  const TriangleMesh box = test::boxMesh({0.2, 0.1, 0.1});
  const FileCache cache(directory_.string());
  for (const FieldOptions& options : {options_, adaptive()}) {
    const CachedField ring = cachedField(cache, mesh_, options);
    const std::string names[] = {fieldFileName(mesh_, options), fieldFileName(box, options)};
    cachedField(cache, box, options);
    fs::rename(path(names[0]), path("swapped"));
    fs::rename(path(names[1]), path(names[0]));
    fs::rename(path("swapped"), path(names[1]));
    EXPECT_NO_THROW(loadField(path(names[0])));
    const CachedField again = cachedField(cache, mesh_, options);
    EXPECT_FALSE(again.outcome.from_cache);
    EXPECT_NE(again.outcome.warning.find("was made from other data: its key is \"" + names[1]), std::string::npos)
        << again.outcome.warning;
    expectSame(ring.field, again.field);
    EXPECT_TRUE(cachedField(cache, mesh_, options).outcome.from_cache);
    EXPECT_FALSE(cachedField(cache, box, options).outcome.from_cache);
  }
}

TEST_F(FieldCache, KeyIsTheContent) {
  const std::string name = fieldFileName(mesh_, options_);
  TriangleMesh moved = mesh_;
  moved.vertices[5].x() = std::nextafter(moved.vertices[5].x(), 1.0);
  EXPECT_NE(fieldFileName(moved, options_), name);
  EXPECT_NE(fieldFileName(scaled(mesh_, {1, 1, 2}), options_), name);
  FieldOptions finer = options_;
  finer.cells = 25;
  EXPECT_NE(fieldFileName(mesh_, finer), name);
  FieldOptions wider = options_;
  wider.band = 0.1;
  EXPECT_NE(fieldFileName(mesh_, wider), name);
  EXPECT_EQ(fieldFileName(mesh_, options_), name);
}

TEST_F(FieldCache, FieldsAreHeldToTheLimitOfBytes) {
  const FileCache cache(path("cache"));
  const std::size_t bytes = cachedField(cache, mesh_, options_).field.bytes();
  options_.max_bytes = bytes;
  EXPECT_TRUE(cachedField(cache, mesh_, options_).outcome.from_cache);
  options_.max_bytes = bytes - 1;
  EXPECT_THROW(cachedField(cache, mesh_, options_), std::length_error);
}

TEST_F(FieldCache, ThatCannotBeWrittenCostsOnlyTheSaving) {
  test::writeText(path("file"), "in the way");
  const CachedField field = cachedField(FileCache(path("file/below")), mesh_, options_);
  EXPECT_FALSE(field.outcome.from_cache);
  EXPECT_NE(field.outcome.warning.find("cache unavailable"), std::string::npos);
  expectSame(field.field, buildField(mesh_, options_));
}

TEST_F(FieldCache, TwoProcessesBuildOnce) {
  // Child processes compete for the same field; each reports whether it found the field in the cache.
  options_.cells = 60;
  setenv("SDF_CCD_TEST_CACHE", path("cache").c_str(), 1);
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      execl("/proc/self/exe", "test_field", "--gtest_filter=FieldCacheChild.LooksUpTheCache", nullptr);
      _exit(99);
    }
    children.push_back(child);
  }
  unsetenv("SDF_CCD_TEST_CACHE");
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  int built = 0, loaded = 0;
  for (const auto& entry : fs::directory_iterator(path("cache"))) {
    built += entry.path().extension() == ".built";
    loaded += entry.path().extension() == ".loaded";
  }
  EXPECT_EQ(built, 1);
  EXPECT_EQ(loaded, 2);
}

/// One process of TwoProcessesBuildOnce; does nothing when run by itself.
TEST(FieldCacheChild, LooksUpTheCache) {
  const char* directory = std::getenv("SDF_CCD_TEST_CACHE");
  if (!directory) return;
  FieldOptions options;
  options.cells = 60;
  const CachedField field = cachedField(FileCache(directory), test::torusMesh(0.2, 0.08, 32, 16), options);
  std::ofstream(std::string(directory) + "/" + std::to_string(getpid()) +
                (field.outcome.from_cache ? ".loaded" : ".built"));
  EXPECT_EQ(field.outcome.warning, "");
}

}  // namespace sdf_ccd::field_cache_test
