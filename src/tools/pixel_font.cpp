#include "pixel_font.h"

#include <array>
#include <map>

namespace sdf_ccd::tools {
namespace {

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
      {'e', {"   ", "###", "###", "#  ", "###"}}, {'m', {"   ", "   ", "###", "###", "# #"}},
      {'x', {"   ", "# #", " # ", "# #", "   "}}, {'y', {"# #", "# #", "###", "  #", "## "}},
      {'z', {"   ", "###", " ##", "## ", "###"}}};
  return all;
}

}  // namespace

void drawText(Image& image, int column, int row, const std::string& text, int size) {
  for (const char c : text) {
    const auto glyph = glyphs().find(c);
    for (int y = 0; glyph != glyphs().end() && y < kGlyphHeight * size; ++y) {
      for (int x = 0; x < 3 * size; ++x) {
        if (glyph->second[y / size][x / size] == '#') image.set(column + x, row + y, Color{0, 0, 0});
      }
    }
    column += kGlyphWidth * size;
  }
}

}  // namespace sdf_ccd::tools
