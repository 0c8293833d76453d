#include "ros/parameters/parameter_reader.h"

#include <gtest/gtest.h>

#include "oracle/failure.h"

namespace sdf_ccd::parameter_reader_test {

XmlRpc::XmlRpcValue tree() {
  XmlRpc::XmlRpcValue tree;
  tree["rate"] = 30;
  tree["max_latency"] = -0.5;
  tree["field"]["cells"] = 64;
  tree["contact"]["normal"] = std::string("fiel");
  tree["world"][0]["xyz"][0] = 1;
  tree["world"][0]["xyz"][1] = 2.5;
  tree["world"][0]["xyz"][2] = 3;
  tree["world"][1]["xyz"] = std::string("0 0 1");
  tree["stiffness"] = std::string("1.0e8");
  tree["typo"] = 1;
  return tree;
}

template <class Read>
std::string errorOf(const Read& read) {
  return test::failureOf<ParameterError>(read);
}

TEST(ParameterReader, ReadsNumbersGroupsAndLists) {
  ParameterReader reader(tree(), "/monitor");
  EXPECT_EQ(reader.number("rate", 1.0), 30.0);  // an integer is also a number
  EXPECT_EQ(reader.positive("max_cycle", 2.0), 2.0);
  EXPECT_EQ(reader.number("stiffness", 1.0), 1e8);  // a text in YAML
  EXPECT_EQ(reader.group("field").integer("cells", 0, 1), 64);
  EXPECT_FALSE(reader.group("shell").has("spacing"));
  EXPECT_EQ(reader.list("world")[0].vector("xyz", Vector3d::Zero()), Vector3d(1.0, 2.5, 3.0));
  const std::vector<std::string> unread = reader.unread();
  ASSERT_EQ(unread.size(), 3u);
  EXPECT_EQ(unread[0].find("/monitor/contact"), 0u) << unread[0];
  EXPECT_EQ(unread[1], "/monitor/max_latency, known names: max_cycle and shell");
}

TEST(ParameterReader, ErrorsNameParameterAndValue) {
  ParameterReader reader(tree(), "/monitor");
  EXPECT_EQ(errorOf([&] { reader.positive("max_latency", 1.0); }),
            "parameter /monitor/max_latency is -0.5, expected a positive number");
  EXPECT_EQ(errorOf([&] {
              reader.group("contact").choice("normal", {"field", "shell"}, 0);
            }),
            "parameter /monitor/contact/normal is fiel, expected one of field shell");
  EXPECT_EQ(errorOf([&] { reader.list("world")[1].vector("xyz", Vector3d::Zero()); }),
            "parameter /monitor/world[1]/xyz is 0 0 1, expected three numbers");
  EXPECT_EQ(errorOf([&] { reader.flag("rate", true); }), "parameter /monitor/rate is 30, expected true or false");
  EXPECT_EQ(errorOf([&] { reader.text("rate", ""); }), "parameter /monitor/rate is 30, expected a string");
  EXPECT_EQ(errorOf([&] { reader.fail("name", "a string"); }), "parameter /monitor/name is missing, expected a string");
}

TEST(ParameterReader, ValuesAreShownAsYamlHasThem) {
  XmlRpc::XmlRpcValue tree;
  tree["points"] = 1e9;
  tree["flag"] = true;
  tree["list"][0] = 1;
  tree["list"][1]["key"] = std::string("text");
  ParameterReader reader(tree, "~");
  EXPECT_EQ(errorOf([&] { reader.integer("points", 0, 0); }),
            "parameter ~/points is 1e+09, expected an integer of at least 0");
  EXPECT_EQ(errorOf([&] { reader.positive("flag", 1.0); }), "parameter ~/flag is true, expected a finite number");
  EXPECT_EQ(errorOf([&] { reader.text("list", ""); }), "parameter ~/list is [1, {key: text}], expected a string");
}

TEST(ParameterReader, NamesAreShortAndMessagesToo) {
  XmlRpc::XmlRpcValue tree;
  tree["fair"] = std::string(256, 'x');
  tree["long"] = std::string(1 << 20, 'x');
  tree["lines"] = std::string("a\nb");
  ParameterReader reader(tree, "/monitor");
  EXPECT_EQ(reader.name("fair", ""), std::string(256, 'x'));
  EXPECT_EQ(reader.name("none", "world"), "world");
  for (const char* key : {"long", "lines"}) {
    const std::string error = errorOf([&] { reader.name(key, ""); });
    EXPECT_NE(error.find("expected at most 256 bytes without control characters"), std::string::npos) << error;
    EXPECT_LT(error.size(), 600u);
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  EXPECT_LT(errorOf([&] { reader.positive("long", 1.0); }).size(), 600u);
}

TEST(ParameterReader, NoParametersGiveDefaults) {
  ParameterReader reader(XmlRpc::XmlRpcValue(), "/monitor");
  EXPECT_EQ(reader.number("rate", 7.0), 7.0);
  EXPECT_TRUE(reader.list("world").empty());
  EXPECT_TRUE(reader.unread().empty());
}

}  // namespace sdf_ccd::parameter_reader_test
