#include "common/setting_keys.h"

#include <gtest/gtest.h>

namespace sdf_ccd::setting_keys_test {

TEST(SettingKeys, TellsWhichWereNotRead) {
  SettingKeys keys({"radius", "xyz", "raduis"});
  keys.read("xyz");
  keys.read("frame");
  EXPECT_TRUE(keys.isSet("xyz") && keys.isRead("xyz"));
  EXPECT_FALSE(keys.isSet("frame") || keys.isRead("radius"));
  EXPECT_EQ(keys.unread(), (SettingKeys::Names{"radius", "raduis"}));
}

TEST(SettingKeys, SuggestsKnownKeysThatAreNotSet) {
  SettingKeys keys({"spacin", "cells"});
  keys.know("spacing");
  keys.read("cells");
  EXPECT_EQ(keys.suggestionFor("spacin"), ", did you mean spacing?");
  EXPECT_EQ(keys.suggestionFor("cell"), ", known names: spacing") << "cells is set already";
  EXPECT_EQ(keys.unread(), SettingKeys::Names{"spacin"}) << "to know a key is not to read it";
}

TEST(SettingKeys, FindsTheMisspellingOfAMissingKey) {
  SettingKeys keys({"raduis", "length"});
  keys.read("length");
  EXPECT_EQ(keys.misspellingOf("radius"), "raduis");
  EXPECT_EQ(keys.misspellingOf("length"), "") << "it is set";
  EXPECT_EQ(keys.misspellingOf("lenght"), "") << "length was read, as itself";
}

}  // namespace sdf_ccd::setting_keys_test
