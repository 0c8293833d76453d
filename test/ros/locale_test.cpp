// The nodelet runs in others' processes, which may have chosen a locale.
#include <gtest/gtest.h>

#include "common/settings/settings_reader.h"
#include "common/settings/yaml_settings.h"
#include "oracle/files.h"
#include "oracle/german_locale.h"
#include "robot/moveit_scene.h"
#include "ros/parameters/world_file.h"

namespace sdf_ccd::locale_test {

class RosLocale : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    test::writeText(directory_ / name, text);
    return (directory_ / name).string();
  }

  const test::TemporaryDirectory directory_;
};

TEST_F(RosLocale, YamlIsTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  const test::GermanLocale german;
  SettingsReader reader(parseYaml("a: 1.5\nb: -2.5e-3\nc: 1.5e3\nd: 12345"), "/monitor");
  EXPECT_EQ(reader.number("a"), 1.5);
  EXPECT_EQ(reader.number("b"), -2.5e-3);
  EXPECT_EQ(reader.number("c"), 1500.0);  // a text in YAML
  EXPECT_EQ(reader.integer("d", {}, 1), 12345);
  const auto world =
      loadWorldFile(write("w.yaml", "world:\n  - {name: q, type: sphere, radius: 0.125, xyz: [1.5, 0.25, 0.75]}\n"));
  ASSERT_EQ(world.size(), 1u);
  EXPECT_EQ(world[0].X_frame_B.translation(), Vector3d(1.5, 0.25, 0.75));
  EXPECT_EQ(std::get<Sphere>(std::get<Primitive>(world[0].shapes[0].shape)).radius, 0.125);
}

TEST_F(RosLocale, ASavedWorldIsTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  BodyDescription body;
  body.name = "q";
  body.X_frame_B.translation() = Vector3d(1.5, 0.25, -1234567.75);
  body.geometry.push_back({Primitive(Sphere{0.125}), Isometry3d::Identity(), "sphere"});
  const std::string plain = moveitScene({body});
  const test::GermanLocale german;
  EXPECT_EQ(moveitScene({body}), plain);
  const std::vector<WorldObject> read = parseMoveitScene(plain);
  EXPECT_EQ(read.at(0).X_frame_B.translation(), Vector3d(1.5, 0.25, -1234567.75));
  EXPECT_EQ(std::get<Sphere>(std::get<Primitive>(read[0].shapes.at(0).shape)).radius, 0.125);
}

}  // namespace sdf_ccd::locale_test
