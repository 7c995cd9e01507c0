// SPDX-License-Identifier: MIT
#include "render/text.h"

#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

namespace elbowroom {
namespace {

constexpr const char* kInter = "/usr/share/fonts/opentype/inter/";
constexpr const char* kInterOther = "/usr/share/fonts/truetype/inter/";
constexpr const char* kDejaVu = "/usr/share/fonts/truetype/dejavu/";
constexpr const char* kLiberation = "/usr/share/fonts/truetype/liberation/";
constexpr std::uintmax_t kLargestFile = 64u << 20;

std::vector<std::uint32_t> decode_utf8(std::string_view text) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xc2 ? 0
                               : lead < 0xe0 ? 2
                               : lead < 0xf0 ? 3
                               : lead < 0xf5 ? 4
                                             : 0;
    std::uint32_t code = length == 1 ? lead : length == 0 ? 0 : lead & (0xffu >> (length + 1));
    bool valid = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; valid && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      valid = (next & 0xc0u) == 0x80u;
      code = (code << 6) | (next & 0x3fu);
    }
    out.push_back(valid ? code : std::uint32_t{'?'});
    i += valid ? length : 1;
  }
  return out;
}

struct Face {
  std::filesystem::path file;
  std::vector<unsigned char> bytes;
  stbtt_fontinfo info{};
  double units_per_em = 1000;
};

bool load_face(const std::filesystem::path& file, Face& face) {
  std::error_code failed;
  const auto size = std::filesystem::file_size(file, failed);
  if (failed || size < 12 || size > kLargestFile) return false;
  std::ifstream in(file, std::ios::binary);
  face.bytes.resize(size);
  in.read(reinterpret_cast<char*>(face.bytes.data()), static_cast<std::streamsize>(size));
  if (!in) return false;
  const int offset = stbtt_GetFontOffsetForIndex(face.bytes.data(), 0);
  if (offset < 0 || stbtt_InitFont(&face.info, face.bytes.data(), offset) == 0) return false;
  face.file = file;
  face.units_per_em = 1.0 / static_cast<double>(stbtt_ScaleForMappingEmToPixels(&face.info, 1.0f));
  return true;
}

}  // namespace

struct Font::Data {
  std::vector<Face> faces;  // in order of preference

  struct Glyph {
    const Face* face = nullptr;
    int index = 0;
    double shift = 0;    // ems, to the right
    double advance = 0;  // ems
  };
  Glyph glyph(std::uint32_t code) const;
  double digit_width = 0;  // ems; the widest of the first face

  template <typename Visit>
  double lay_out(std::string_view text, double size, const Visit& visit) const;
};

Font::Data::Glyph Font::Data::glyph(std::uint32_t code) const {
  Glyph glyph;
  for (const std::uint32_t wanted : {code, std::uint32_t{'?'}}) {
    for (const auto& face : faces) {
      glyph.index = stbtt_FindGlyphIndex(&face.info, static_cast<int>(wanted));
      if (glyph.index == 0) continue;
      glyph.face = &face;
      int advance = 0;
      stbtt_GetGlyphHMetrics(&face.info, glyph.index, &advance, nullptr);
      glyph.advance = advance / face.units_per_em;
      if (wanted >= '0' && wanted <= '9' && digit_width > 0) {
        glyph.shift = 0.5 * (digit_width - glyph.advance);
        glyph.advance = digit_width;
      }
      return glyph;
    }
  }
  return glyph;
}

template <typename Visit>
double Font::Data::lay_out(std::string_view text, double size, const Visit& visit) const {
  double pen = 0;
  Glyph previous;
  for (const auto code : decode_utf8(text)) {
    const Glyph next = glyph(code);
    if (next.face == nullptr) continue;
    if (previous.face == next.face && next.shift == 0 && previous.shift == 0) {
      pen += size * stbtt_GetGlyphKernAdvance(&next.face->info, previous.index, next.index) /
             next.face->units_per_em;
    }
    visit(next, pen + size * next.shift);
    pen += size * next.advance;
    previous = next;
  }
  return pen;
}

Font Font::load(Weight weight) {
  const char* inter = weight == Weight::regular  ? "Inter-Regular"
                      : weight == Weight::medium ? "Inter-Medium"
                                                 : "Inter-SemiBold";
  const bool bold = weight == Weight::semibold;
  std::vector<std::filesystem::path> files;
  for (const char* folder : {kInter, kInterOther}) {
    for (const char* ending : {".otf", ".ttf"}) {
      files.push_back(std::string(folder) + inter + ending);
    }
  }
  files.push_back(std::string(kDejaVu) + (bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf"));
  files.push_back(std::string(kLiberation) +
                  (bold ? "LiberationSans-Bold.ttf" : "LiberationSans-Regular.ttf"));
  return load_files(files);
}

Font Font::load_files(const std::vector<std::filesystem::path>& files) {
  auto data = std::make_shared<Data>();
  data->faces.reserve(files.size());  // stb keeps pointers into each face's bytes
  for (const auto& file : files) {
    Face face;
    if (load_face(file, face)) data->faces.push_back(std::move(face));
  }
  Font font;
  if (data->faces.empty()) return font;
  for (std::uint32_t digit = '0'; digit <= '9'; ++digit) {
    const int index = stbtt_FindGlyphIndex(&data->faces[0].info, static_cast<int>(digit));
    int advance = 0;
    if (index != 0) stbtt_GetGlyphHMetrics(&data->faces[0].info, index, &advance, nullptr);
    data->digit_width = std::max(data->digit_width, advance / data->faces[0].units_per_em);
  }
  font.data_ = std::move(data);
  return font;
}

bool Font::found() const { return data_ != nullptr; }

std::filesystem::path Font::file() const {
  return found() ? data_->faces.front().file : std::filesystem::path();
}

double Font::width(std::string_view text, double size) const {
  if (!found()) return 0;
  return data_->lay_out(text, size, [](const Data::Glyph&, double) {});
}

double Font::cap_height(double size) const {
  if (!found()) return 0;
  const Face& face = data_->faces.front();
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetCodepointBox(&face.info, 'H', &x0, &y0, &x1, &y1);
  return size * y1 / face.units_per_em;
}

double Font::line_height(double size) const {
  if (!found()) return 0;
  const Face& face = data_->faces.front();
  int ascent = 0, descent = 0, gap = 0;
  stbtt_GetFontVMetrics(&face.info, &ascent, &descent, &gap);
  return size * (ascent - descent + gap) / face.units_per_em;
}

double Font::draw(Picture& picture, double x, double y, std::string_view text, double size,
                  Rgb colour) const {
  if (!found() || !(size > 0) || size > 1000) return 0;
  return data_->lay_out(text, size, [&](const Data::Glyph& glyph, double pen) {
    const float scale = static_cast<float>(size / glyph.face->units_per_em);
    const double left = x + pen;
    const double whole_x = std::floor(left), whole_y = std::floor(y);
    int width = 0, height = 0, dx = 0, dy = 0;
    unsigned char* bitmap = stbtt_GetGlyphBitmapSubpixel(
        &glyph.face->info, scale, scale, static_cast<float>(left - whole_x),
        static_cast<float>(y - whole_y), glyph.index, &width, &height, &dx, &dy);
    if (bitmap == nullptr) return;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        picture.blend(static_cast<int>(whole_x) + dx + column, static_cast<int>(whole_y) + dy + row,
                      colour, bitmap[row * width + column] / 255.0);
      }
    }
    stbtt_FreeBitmap(bitmap, nullptr);
  });
}

const char* font_remedy() {
  return "install the Debian package fonts-inter (or fonts-dejavu-core)";
}

}  // namespace elbowroom
