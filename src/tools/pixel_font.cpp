#include "pixel_font.h"

#include <array>
#include <cstring>
#include <map>

namespace sdf_ccd::tools {
namespace {

constexpr int kBlankWidth = 2;

using Glyph = std::array<const char*, kGlyphHeight>;

const std::map<char, Glyph>& glyphs() {
  static const std::map<char, Glyph> all = {
      {'0', {"###", "# #", "# #", "# #", "###"}}, {'1', {" # ", "## ", " # ", " # ", "###"}},
      {'2', {"###", "  #", "###", "#  ", "###"}}, {'3', {"###", "  #", "###", "  #", "###"}},
      {'4', {"# #", "# #", "###", "  #", "  #"}}, {'5', {"###", "#  ", "###", "  #", "###"}},
      {'6', {"###", "#  ", "###", "# #", "###"}}, {'7', {"###", "  #", "  #", "  #", "  #"}},
      {'8', {"###", "# #", "###", "# #", "###"}}, {'9', {"###", "# #", "###", "  #", "###"}},
      {'-', {"   ", "   ", "###", "   ", "   "}}, {'+', {"   ", " # ", "###", " # ", "   "}},
      {'.', {"   ", "   ", "   ", "   ", " # "}}, {'=', {"   ", "###", "   ", "###", "   "}},
      {'e', {"   ", "###", "###", "#  ", "###"}}, {'m', {"     ", "     ", "#### ", "# # #", "# # #"}},
      {'x', {"# #", "# #", " # ", "# #", "# #"}}, {'y', {"# #", "# #", "###", "  #", "## "}},
      {'z', {"###", "  #", " # ", "#  ", "###"}}};
  return all;
}

}  // namespace

void drawText(Image& image, int column, int row, const std::string& text, int size) {
  for (const char c : text) {
    const auto glyph = glyphs().find(c);
    const int width = glyph == glyphs().end() ? kBlankWidth : static_cast<int>(std::strlen(glyph->second[0]));
    for (int y = 0; glyph != glyphs().end() && y < kGlyphHeight * size; ++y) {
      for (int x = 0; x < width * size; ++x) {
        if (glyph->second[y / size][x / size] == '#') image.set(column + x, row + y, Color{0, 0, 0});
      }
    }
    column += (width + 1) * size;
  }
}

}  // namespace sdf_ccd::tools
