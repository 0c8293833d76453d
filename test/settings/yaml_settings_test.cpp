#include "common/settings/yaml_settings.h"

#include <gtest/gtest.h>

#include "common/settings/settings_reader.h"
#include "oracle/failure.h"
#include "oracle/files.h"

namespace sdf_ccd::yaml_settings_test {

std::string errorOf(const std::string& text) {
  return test::failureOf<std::exception>([&] { parseYaml(text); });
}

/// A member of a group.
const Setting& at(const Setting& group, const std::string& name) {
  return std::get<Setting::Group>(group.value).at(name);
}

/// The values of a list, all of one type.
template <class T>
std::vector<T> listOf(const Setting& setting) {
  std::vector<T> values;
  for (const Setting& item : std::get<Setting::List>(setting.value)) values.push_back(std::get<T>(item.value));
  return values;
}

TEST(YamlSettings, ScalarsAreWhatRosparamTakesThemFor) {
  const Setting tree = parseYaml(
      "flags: [yes, False, ON]\nintegers: [30, -5, 010, 0x10, 0]\nreals: [1., .5, 1.0e+8, -2.5E-3]\n"
      "texts: [1.0e8, 1e5, '30', \"yes\", y, 089, fixed, 3000000000, deg(90)]\ngroup/inner: 1\nempty: {}\nlist: []\n");
  EXPECT_EQ(listOf<bool>(at(tree, "flags")), (std::vector<bool>{true, false, true}));
  EXPECT_EQ(listOf<int>(at(tree, "integers")), (std::vector<int>{30, -5, 8, 16, 0}));
  EXPECT_EQ(listOf<double>(at(tree, "reals")), (std::vector<double>{1.0, 0.5, 1e8, -2.5e-3}));
  EXPECT_EQ(listOf<std::string>(at(tree, "texts")).size(), 9u);
  EXPECT_EQ(std::get<int>(at(at(tree, "group"), "inner").value), 1);
  EXPECT_TRUE(at(tree, "empty").isGroup());
  EXPECT_TRUE(listOf<int>(at(tree, "list")).empty());
}

TEST(YamlSettings, ValuesKnowTheirLine) {
  const Setting tree = parseYaml("rate: 30\n\ncontact:\n  damping: 2\n  list: [1,\n    2]\n");
  EXPECT_EQ(at(tree, "rate").line, 1);
  EXPECT_EQ(at(at(tree, "contact"), "damping").line, 4);
  EXPECT_EQ(std::get<Setting::List>(at(at(tree, "contact"), "list").value)[1].line, 6);
}

TEST(YamlSettings, AliasesAreCopies) {
  const Setting tree = parseYaml("a: &a {x: 1}\nb: *a\nc: [*a, &d 5, *d]\n");
  EXPECT_EQ(std::get<int>(at(at(tree, "b"), "x").value), 1);
  const auto& list = std::get<Setting::List>(at(tree, "c").value);
  EXPECT_EQ(std::get<int>(at(list[0], "x").value), 1);
  EXPECT_EQ(std::get<int>(list[2].value), 5);
  EXPECT_NE(errorOf("a: *b\n"), "");
}

TEST(YamlSettings, NoSettingsAreAnEmptyGroup) {
  for (const char* text : {"", "# nothing\n", "~", "{}"})
    EXPECT_TRUE(std::get<Setting::Group>(parseYaml(text).value).empty()) << text;
}

TEST(YamlSettings, WhatExpandsWithoutEndIsRefused) {
  // Ten aliases of ten aliases each, ten levels deep; a list that contains itself; deeply nested brackets and blocks.
  std::string laughs = "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n", blocks;
  for (int i = 1; i < 10; ++i) {
    const std::string name = "a" + std::to_string(i), before = "*a" + std::to_string(i - 1);
    laughs += name + ": &" + name + " [" + before;
    for (int k = 1; k < 10; ++k) laughs += "," + before;
    laughs += "]\n";
  }
  for (int i = 0; i < 100; ++i) blocks += std::string(i, ' ') + "a:\n";
  std::string signs = "a:\n  ";
  for (int i = 0; i < 10000; ++i) signs += "- ";
  EXPECT_NE(errorOf(laughs).find("more than 100000 values"), std::string::npos) << errorOf(laughs);
  EXPECT_NE(errorOf("world: &a [*a]\n").find("a value contains itself"), std::string::npos);
  EXPECT_NE(errorOf("a: " + std::string(100'000, '[')).find("levels deep"), std::string::npos);
  EXPECT_NE(errorOf(blocks).find("levels deep"), std::string::npos) << errorOf(blocks);
  EXPECT_NE(errorOf(signs + "1\n").find("levels deep"), std::string::npos);
  std::string closed_in_strings, closed_in_comments, slashes;
  for (int i = 0; i < 1000; ++i) {
    closed_in_strings += "[\"]\",\n ";
    closed_in_comments += "[ # ]\n ";
    slashes += "a/";
  }
  for (const std::string& text : {"a: " + closed_in_strings, "a: " + closed_in_comments, "? " + slashes + "a\n: 1\n"})
    EXPECT_NE(errorOf(text).find("nested more than 64 levels deep"), std::string::npos) << errorOf(text);
  std::string shallow = "rate: 30  # [[[\nurdf_parameter: \"";
  EXPECT_EQ(errorOf(shallow + std::string(100, '[') + "\"\n"), "");
}

/// Regular expressions recurse for each byte.
TEST(YamlSettings, NumbersOfAMillionDigitsAreRefused) {
  const std::string digits(1'000'000, '1');
  for (const std::string& number : {digits, "0." + digits, "0x" + digits}) {
    const Setting tree = parseYaml("rate: " + number);
    EXPECT_TRUE(at(tree, "rate").isText());
    const std::string error =
        test::failureOf<std::runtime_error>([&] { SettingsReader(tree, "~").integer("rate", {}, 0); });
    EXPECT_NE(error, "");
    EXPECT_LT(error.size(), 600u);
  }
}

TEST(YamlSettings, AValueIsNoGroup) {
  EXPECT_EQ(errorOf("rate: 30\nrate/x: 1\n"),
            "line 2: parameter rate/x is inside a parameter that is a value, not a group");
  EXPECT_NE(errorOf("rate/x: 1\nrate: 30\n").find("parameter rate is set twice"), std::string::npos);
  EXPECT_NE(errorOf("rate: 30\nrate: 20\n").find("parameter rate is set twice"), std::string::npos);
}

TEST(YamlSettings, DevicesAreRefused) {
  EXPECT_THROW(loadYaml("/dev/zero"), std::runtime_error);
  EXPECT_THROW(loadYaml("/nowhere/monitor.yaml"), std::runtime_error);
}

TEST(YamlSettings, ErrorsNameFileAndLine) {
  EXPECT_EQ(errorOf("rate: 30\nshell:\n"), "line 2: parameter shell has no value");
  EXPECT_EQ(errorOf("rate: [30, ~]\n"), "line 1: a value is missing");
  EXPECT_EQ(errorOf("rate: 30\n? [a, b]\n: 1\n"), "line 2: the name of a parameter is not a string");
  EXPECT_EQ(errorOf("- 1\n"), "line 1: expected parameters, each with its name");
  EXPECT_NE(errorOf("rate: [30\n").find("error at line"), std::string::npos) << errorOf("rate: [30\n");
  const test::TemporaryDirectory directory;
  test::writeText(directory / "a.yaml", "rate:");
  const std::string file = (directory / "a.yaml").string();
  EXPECT_EQ(test::failureOf<std::runtime_error>([&] { loadYaml(file); }),
            file + ": line 1: parameter rate has no value");
}

}  // namespace sdf_ccd::yaml_settings_test
