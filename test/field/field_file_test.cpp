#include "sdf_ccd/field.h"

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "common/files/checked_file.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/field_file_case.h"
#include "field/opening_caps.h"
#include "field/uniform/sparse_grid.h"
#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/mended_file.h"
#include "oracle/open_shapes.h"
#include "oracle/random.h"

namespace sdf_ccd::field_file_test {

namespace fs = std::filesystem;
using test::expectSame;

class FieldFile : public test::FieldFileCase {
 protected:
  void expectDamageIsNoticed(const FieldOptions& options) const;
};

TEST_F(FieldFile, RoundTripIsExact) {
  const DistanceField field = buildField(mesh_, options_);
  saveField(field, path("a.field"));
  const DistanceField loaded = loadField(path("a.field"));
  expectSame(field, loaded);
  EXPECT_EQ(loaded.bytes(), field.bytes());
  EXPECT_EQ(fileCount(), 1U) << "a temporary file was left";
  EXPECT_TRUE(isCheckedFile(path("a.field"), "field"));
  EXPECT_FALSE(isCheckedFile(path("a.field"), "shell"));
}

TEST_F(FieldFile, AdaptiveRoundTripIsExact) {
  const DistanceField field = buildField(mesh_, adaptive());
  saveField(field, path("a.field"));
  const DistanceField loaded = loadField(path("a.field"));
  expectSame(field, loaded);
  for (std::size_t i = 0; i < field.cells(); ++i) {
    ASSERT_EQ(FieldAccess::adaptive(field)->arrays().leaf_errors[i],
              FieldAccess::adaptive(loaded)->arrays().leaf_errors[i]);
  }
}

TEST_F(FieldFile, KeepsOpenings) {
  const TriangleMesh bin = test::binMesh(0.3);
  for (const FieldOptions& options : {options_, adaptive()}) {
    const DistanceField field = buildField(bin, options);
    saveField(field, path("bin.field"));
    const DistanceField loaded = loadField(path("bin.field"));
    expectSame(field, loaded);
    ASSERT_TRUE(FieldAccess::openings(field) && FieldAccess::openings(loaded));
    EXPECT_EQ(FieldAccess::openings(loaded)->mesh().vertices, FieldAccess::openings(field)->mesh().vertices);
    EXPECT_EQ(FieldAccess::openings(loaded)->mesh().triangles, FieldAccess::openings(field)->mesh().triangles);
    EXPECT_EQ(FieldAccess::openings(loaded)->reach(), FieldAccess::openings(field)->reach());
    saveField(buildField(mesh_, options), path("closed.field"));
    EXPECT_FALSE(loadField(path("closed.field")).hasOpenings());
  }
}

/// The files have valid checksums.
TEST_F(FieldFile, BadOpeningsAreRefused) {
  for (const FieldOptions& options : {options_, adaptive()}) {
    saveField(buildField(test::binMesh(0.3), options), path("a.field"));
    const std::string kind = options.max_error ? "adaptive field" : "field";
    const std::size_t first = options.max_error ? 7 : 4;  // of the three sections
    const test::EditedFile good(path("a.field"), kind, test::kFieldVersion);
    const auto loadWith = [&](std::size_t section, auto change) {
      good.write(path("b.field"), [&](auto& sections) { change(sections[first + section]); });
      return loadField(path("b.field"));
    };
    const auto put = [](auto value) { return [value](std::string& bytes) { test::put(value, 0, bytes); }; };
    EXPECT_TRUE(loadWith(0, put(0.3)).hasOpenings());
    for (const double x : {0.4, -1e300, HUGE_VAL, std::nan("")}) EXPECT_THROW(loadWith(0, put(x)), std::runtime_error);
    for (const std::int32_t i : {-1, 6, 1 << 30}) EXPECT_THROW(loadWith(1, put(i)), std::runtime_error) << i;
    for (const double x : {-1e-9, HUGE_VAL, std::nan("")}) EXPECT_THROW(loadWith(2, put(x)), std::runtime_error) << x;
    for (std::size_t section = 0; section < 3; ++section) {
      for (const std::size_t size : {0, 4, 8}) {
        EXPECT_THROW(loadWith(section, [&](std::string& bytes) { bytes.resize(size); }), std::runtime_error);
      }
    }
  }
}

TEST_F(FieldFile, AdaptiveFileOfAnotherVersionIsRefused) {
  const int value = 7;
  writeCheckedFile(path("old"), {"adaptive field", 1}, {{&value, sizeof value}});
  EXPECT_TRUE(isFieldFile(path("old")));
  EXPECT_THROW(loadField(path("old")), std::runtime_error);
}

void FieldFile::expectDamageIsNoticed(const FieldOptions& options) const {
  saveField(buildField(mesh_, options), path("a.field"));
  const std::string good = test::readText(path("a.field"));
  test::Random random(2);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    if (i % 3 == 0) {
      bad.resize(random() % good.size());
    } else if (i % 3 == 1) {
      bad[random() % good.size()] ^= char(1 << random() % 8);
    } else {
      bad[random() % 200] ^= char(1 + random() % 255);
    }
    test::writeText(path("b.field"), bad);
    const std::string failure = test::failureOf([&] { loadField(path("b.field")); });
    EXPECT_NE(failure.find("b.field"), std::string::npos) << "damage " << i << ": \"" << failure << "\"";
  }
}

/// The checksum is valid, but the grid's step is not.
TEST_F(FieldFile, BadStepsAreRefused) {
  saveField(buildField(mesh_, options_), path("a.field"));
  const test::EditedFile good(path("a.field"), "field", test::kFieldVersion);
  const auto loadWith = [&](double step) {
    good.write(path("b.field"), [&](auto& sections) {
      test::put(step, sections[0].size() - sizeof step, sections[0]);  // the shape ends with it
    });
    return loadField(path("b.field"));
  };
  EXPECT_EQ(FieldAccess::grid(loadWith(1e-5))->shape().step, 1e-5);
  for (const double step : {0.0, -1e-5, std::nan(""), HUGE_VAL, 1e307, 1.0}) {
    EXPECT_THROW(loadWith(step), std::runtime_error) << step;
  }
}

/// The checksum is valid, but a box beyond the grid's would be searched for a surface that the grid does not hold.
TEST_F(FieldFile, BoxesOfTheSurfaceBeyondTheGridAreRefused) {
  constexpr std::size_t kSurfaceMin = 7 * sizeof(double), kSurfaceMax = 10 * sizeof(double);
  for (const FieldOptions& options : {options_, adaptive()}) {
    saveField(buildField(mesh_, options), path("a.field"));
    const test::EditedFile good(path("a.field"), options.max_error ? "adaptive field" : "field", test::kFieldVersion);
    const auto loadWith = [&](std::size_t offset, double x) {
      good.write(path("b.field"), [&](auto& sections) { test::put(x, offset, sections[0]); });
      return loadField(path("b.field"));
    };
    EXPECT_NO_THROW(loadWith(kSurfaceMin, -0.27));
    EXPECT_THROW(loadWith(kSurfaceMin, -5.0), std::runtime_error);
    EXPECT_THROW(loadWith(kSurfaceMax, 5.0), std::runtime_error);
  }
}

TEST_F(FieldFile, OnceLoadedAFileMayBeCutShort) {
  for (const FieldOptions& options : {options_, adaptive()}) {
    const DistanceField field = buildField(mesh_, options);
    saveField(field, path("a.field"));
    const DistanceField loaded = loadField(path("a.field"));
    fs::resize_file(path("a.field"), 100);
    expectSame(field, loaded);
  }
}

TEST_F(FieldFile, PipesAndDevicesAreRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  for (const std::string& file : {path("pipe"), std::string("/dev/zero")}) {
    EXPECT_FALSE(isFieldFile(file));
    EXPECT_THROW(loadField(file), std::runtime_error);
  }
}

TEST_F(FieldFile, EveryDamageIsNoticed) {
  expectDamageIsNoticed(options_);
}

TEST_F(FieldFile, EveryDamageOfAnAdaptiveFieldIsNoticed) {
  expectDamageIsNoticed(adaptive());
}

/// Large files are checked in pieces whose ends are not those of sections or of the padding between them.
TEST_F(FieldFile, DamageOfLargeFilesIsNoticed) {
  const std::vector<char> first((1 << 20) - 7, 'a'), second((3 << 20) + 5, 'b');
  writeCheckedFile(path("large"), {"test", 1}, {{first.data(), first.size()}, {second.data(), second.size()}});
  const auto file = CheckedFile::open(path("large"), {"test", 1});
  std::size_t count = 0;
  const char* read_back = file->section<char>(1, count);
  EXPECT_EQ(std::vector<char>(read_back, read_back + count), second);
  const std::string good = test::readText(path("large"));
  for (std::size_t at = 100; at < good.size(); at += 200'000) {
    std::string bad = good;
    bad[at] ^= 1;
    test::writeText(path("bad"), bad);
    EXPECT_THROW(CheckedFile::open(path("bad"), {"test", 1}), std::runtime_error) << at;
  }
}

TEST_F(FieldFile, SaysWhatIsWrong) {
  const auto reason = [](const std::string& file) { return test::failureOf([&] { loadField(file); }); };
  EXPECT_NE(reason(path("none")).find("No such file"), std::string::npos);
  EXPECT_NE(reason(directory_.string()).find("not a regular file"), std::string::npos);
  test::writeText(path("empty"), "");
  EXPECT_NE(reason(path("empty")).find("truncated"), std::string::npos);
  test::writeText(path("text"), std::string(1000, 'x'));
  EXPECT_NE(reason(path("text")).find("not a file of sdf_ccd"), std::string::npos);
  const int value = 7;
  writeCheckedFile(path("other"), {"shell", 1}, {{&value, sizeof value}});
  EXPECT_NE(reason(path("other")).find("holds a shell"), std::string::npos);
  writeCheckedFile(path("later"), {"field", 99}, {{&value, sizeof value}});
  EXPECT_NE(reason(path("later")).find("version 99"), std::string::npos);
  writeCheckedFile(path("earlier"), {"field", test::kFieldVersion - 1}, {{&value, sizeof value}});
  EXPECT_NE(reason(path("earlier")).find("version " + std::to_string(test::kFieldVersion - 1)), std::string::npos);
  writeCheckedFile(path("short"), {"field", test::kFieldVersion}, {{&value, sizeof value}});
  EXPECT_NE(reason(path("short")).find("damaged"), std::string::npos);
  EXPECT_THROW(saveField(DistanceField(Primitive(Sphere{1})), path("s")), std::invalid_argument);
  EXPECT_THROW(saveField(buildField(mesh_, options_), path("no/such/folder")), std::runtime_error);
}

TEST_F(FieldFile, NothingStaysOfWhoeverIsKilledWhileWriting) {
  const std::vector<char> data(1 << 22);
  for (int i = 0; i < 30; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      for (int k = 0;; ++k) {
        writeCheckedFile(path(std::to_string(k)), {"field", test::kFieldVersion}, {{data.data(), data.size()}});
      }
    }
    usleep(1000 * (3 + i));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (const auto& entry : fs::directory_iterator(directory_.path())) {
      EXPECT_EQ(entry.path().extension(), "") << entry.path() << " was left";
      EXPECT_NO_THROW(CheckedFile::open(entry.path(), {"field", test::kFieldVersion}));
      fs::remove(entry.path());
    }
  }
}

}  // namespace sdf_ccd::field_file_test
