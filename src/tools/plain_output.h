#pragma once

#include <iostream>
#include <streambuf>

namespace sdf_ccd::tools {

/// Whether a terminal may take a byte of UTF-8 for a command, alone or after the one before it: of ASCII, or of the
/// second control set, U+0080 to U+009F.
inline bool isControl(char before, char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < ' ' || byte == 0x7F || (static_cast<unsigned char>(before) == 0xC2 && byte >= 0x80 && byte < 0xA0);
}

/// While it exists, what is written to a stream reaches the terminal without control characters except tabs and line
/// ends: names, paths and values come from files of others, and could otherwise move the cursor, clear the screen or
/// rename the window.
class PlainOutput : public std::streambuf {
 public:
  explicit PlainOutput(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}
  ~PlainOutput() override { stream_.rdbuf(target_); }
  PlainOutput(const PlainOutput&) = delete;
  PlainOutput& operator=(const PlainOutput&) = delete;

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char given = traits_type::to_char_type(c);
    const bool is_plain = given == '\n' || given == '\t' || !isControl(before_, given);
    before_ = given;
    return target_->sputc(is_plain ? given : '?');
  }
  int sync() override { return target_->pubsync(); }

 private:
  std::ostream& stream_;
  std::streambuf* target_;
  char before_ = '\0';
};

}  // namespace sdf_ccd::tools
