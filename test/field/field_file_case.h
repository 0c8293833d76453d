#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "oracle/file_versions.h"
#include "oracle/files.h"
#include "oracle/open_shapes.h"
#include "oracle/random.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::test {

/// A mesh, options of its fields, and a directory for their files.
class FieldFileCase : public testing::Test {
 protected:
  FieldFileCase() { options_.cells = 24; }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::size_t fileCount() const {
    namespace fs = std::filesystem;
    return std::distance(fs::directory_iterator(directory_.path()), fs::directory_iterator());
  }

  FieldOptions adaptive() const {
    FieldOptions options;
    options.max_error = 0.004;
    return options;
  }

  const TemporaryDirectory directory_;
  FieldOptions options_;
  TriangleMesh mesh_ = torusMesh(0.2, 0.08, 32, 16);
};

inline void expectSame(const DistanceField& a, const DistanceField& b) {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const Vector3d p = uniformIn(random, {Vector3d::Constant(-0.5), Vector3d::Constant(0.5)});
    ASSERT_EQ(a.sample(p).value, b.sample(p).value);
    ASSERT_EQ(a.sample(p).error, b.sample(p).error);
  }
  EXPECT_EQ(a.band(), b.band());
  EXPECT_EQ(a.errorBound(), b.errorBound());
  EXPECT_EQ(a.moved(), b.moved());
}

}  // namespace sdf_ccd::test
