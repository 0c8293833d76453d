#include "common/settings/settings_reader.h"

#include <gtest/gtest.h>

#include "common/settings/yaml_settings.h"
#include "oracle/failure.h"

namespace sdf_ccd::settings_reader_test {

const char* const kSettings = R"(
rate: 30
max_latency: -0.5
field: {cells: 64}
contact: {normal: fiel}
world:
- {xyz: [1, 2.5, 3]}
- {xyz: "0 0 1"}
stiffness: 1.0e8
typo: 1
)";

template <class Read>
std::string errorOf(const Read& read) {
  return test::failureOf<std::runtime_error>(read);
}

TEST(SettingsReader, ReadsNumbersGroupsAndLists) {
  SettingsReader reader(parseYaml(kSettings), "/monitor");
  EXPECT_EQ(reader.number("rate", 1.0), 30.0);  // an integer is also a number
  EXPECT_EQ(reader.positive("max_cycle", 2.0), 2.0);
  EXPECT_EQ(reader.number("stiffness", 1.0), 1e8);  // a text in YAML
  EXPECT_EQ(reader.group("field").integer("cells", {}, 1), 64);
  EXPECT_FALSE(reader.group("shell").has("spacing"));
  EXPECT_EQ(reader.list("world")[0].vector("xyz", Vector3d::Zero()), Vector3d(1.0, 2.5, 3.0));
  const std::vector<std::string> unread = reader.unread();
  ASSERT_EQ(unread.size(), 3u);
  EXPECT_EQ(unread[0].find("/monitor/contact"), 0u) << unread[0];
  EXPECT_EQ(unread[1], "/monitor/max_latency, known names: max_cycle and shell");
}

TEST(SettingsReader, ErrorsNameParameterAndValue) {
  SettingsReader reader(parseYaml(kSettings), "/monitor");
  EXPECT_EQ(errorOf([&] { reader.positive("max_latency", 1.0); }),
            "line 3: parameter /monitor/max_latency is -0.5, expected a positive number");
  EXPECT_EQ(errorOf([&] {
              reader.group("contact").choice("normal", {"field", "shell"});
            }),
            "line 5: parameter /monitor/contact/normal is fiel, expected one of field shell");
  EXPECT_EQ(errorOf([&] { reader.list("world")[1].vector("xyz", Vector3d::Zero()); }),
            "line 8: parameter /monitor/world[1]/xyz is 0 0 1, expected three finite numbers");
  EXPECT_EQ(errorOf([&] { reader.flag("rate", true); }),
            "line 2: parameter /monitor/rate is 30, expected true or false");
  EXPECT_EQ(errorOf([&] { reader.text("rate", ""); }), "line 2: parameter /monitor/rate is 30, expected a string");
  EXPECT_EQ(errorOf([&] { reader.text("name"); }), "line 2: parameter /monitor/name is missing, expected a string");
}

TEST(SettingsReader, ValuesAreShownAsYamlHasThem) {
  SettingsReader reader(parseYaml("{points: 1.0e+9, flag: true, list: [1, {key: text}]}"), "");
  EXPECT_EQ(errorOf([&] { reader.integer("points", 0, 0); }),
            "line 1: parameter points is 1e+09, expected an integer of at least 0");
  EXPECT_EQ(errorOf([&] { reader.positive("flag"); }), "line 1: parameter flag is true, expected a positive number");
  EXPECT_EQ(errorOf([&] { reader.text("list"); }), "line 1: parameter list is [1, {key: text}], expected a string");
}

TEST(SettingsReader, NumbersKeepTheirLimits) {
  SettingsReader reader(parseYaml("{zero: 0, minus: -1, half: 0.5, many: 11, none: .nan, all: .inf}"), "");
  EXPECT_EQ(reader.notNegative("zero"), 0.0);
  EXPECT_EQ(reader.integer("many", {}, 11, 11), 11);
  EXPECT_EQ(reader.positive("unset", 2.0), 2.0);
  for (const char* key : {"zero", "minus", "none", "all", "unset"})
    EXPECT_NE(errorOf([&] { reader.positive(key); }), "") << key;
  for (const char* key : {"minus", "none", "all", "unset"})
    EXPECT_NE(errorOf([&] { reader.notNegative(key); }), "") << key;
  for (const char* key : {"none", "all", "unset"}) EXPECT_NE(errorOf([&] { reader.number(key); }), "") << key;
  for (const char* key : {"half", "many", "minus", "unset"})
    EXPECT_NE(errorOf([&] { reader.integer(key, {}, 0, 10); }), "") << key;
}

TEST(SettingsReader, NamesAreShortAndMessagesToo) {
  const std::string fair(256, 'x');
  SettingsReader reader(Setting{Setting::Group{
                            {"fair", {fair}}, {"long", {std::string(1 << 20, 'x')}}, {"lines", {std::string("a\nb")}}}},
                        "/monitor");
  EXPECT_EQ(reader.name("fair"), fair);
  EXPECT_EQ(reader.name("none", "world"), "world");
  for (const char* key : {"long", "lines"}) {
    const std::string error = errorOf([&] { reader.name(key); });
    EXPECT_NE(error.find("expected at most 256 bytes without control characters"), std::string::npos) << error;
    EXPECT_LT(error.size(), 600u);
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  EXPECT_LT(errorOf([&] { reader.positive("long"); }).size(), 600u);
}

TEST(SettingsReader, NoSettingsGiveDefaults) {
  SettingsReader reader(Setting(), "/monitor");
  EXPECT_EQ(reader.number("rate", 7.0), 7.0);
  EXPECT_TRUE(reader.list("world").empty());
  EXPECT_TRUE(reader.unread().empty());
}

TEST(SettingsReader, AMisspeltNameIsRefusedWithItsNearest) {
  SettingsReader reader(parseYaml("spacin: 0.1\nraduis: 1\ncell: 5\n"), "");
  reader.positive("spacing", 1.0);
  EXPECT_EQ(errorOf([&] { reader.positive("radius"); }),
            "line 1: parameter radius is missing, expected a positive number; is it raduis?");
  reader.integer("cell", 0, 0);
  reader.number("raduis");
  EXPECT_EQ(errorOf([&] { reader.finish(); }), "line 1: unknown parameter spacin, did you mean spacing?");
  reader.has("spacin");
  EXPECT_EQ(reader.unread().size(), 1u) << "to ask for a setting is not to read it";
}

}  // namespace sdf_ccd::settings_reader_test
