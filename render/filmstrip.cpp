// SPDX-License-Identifier: MIT
#include "render/filmstrip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/offscreen_context.h"
#include "render/text.h"

namespace elbowroom {
namespace {

// House colours (the backdrop's are in Style).
constexpr Rgb kPage = 0x16181d;
constexpr Rgb kLine = 0x2d323d;
constexpr Rgb kText = 0xe6e9ef;
constexpr Rgb kQuiet = 0x9aa3b2;

constexpr int kMostFrames = 400;
constexpr std::int64_t kMostPixels = 120'000'000;

// All lengths in pixels, scale applied.
struct Layout {
  int columns = 1, lines = 1;  // a line: one chunk of times for one row
  int frame_width = 0, frame_height = 0;
  int margin = 0, gap = 0, header = 0, label = 0, caption = 0;
  int width = 0, height = 0;
  double unit = 1;  // one pixel at scale 1
};

std::string time_text(double t) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f s", t);
  return text;
}

Error bad_request(const std::string& what, const std::string& remedy) {
  return Error{what, "filmstrip", remedy};
}

std::optional<Error> check(const FilmstripRequest& request) {
  if (request.rows.empty() || request.times.empty()) {
    return bad_request("there is nothing to draw", "give at least one time");
  }
  for (const auto& row : request.rows) {
    if (row.world == nullptr) return bad_request("a row has no world", "open a scene first");
  }
  for (const double t : request.times) {
    if (!std::isfinite(t)) return bad_request("a time is not a number", "give times in seconds");
  }
  if (request.rows.size() * request.times.size() > kMostFrames) {
    return bad_request("that is more than " + std::to_string(kMostFrames) + " frames",
                       "give fewer times");
  }
  if (!std::isfinite(request.scale) || request.scale < 0.25 || request.scale > 8) {
    return bad_request("the scale is out of range", "give one between 0.25 and 8");
  }
  for (const int length : {request.frame_width, request.frame_height}) {
    if (length < 0 || length > 4096 || (length > 0 && length < 32)) {
      return bad_request("the frame's size is out of range", "give 32 to 4096 pixels");
    }
  }
  return std::nullopt;
}

Layout lay_out(const FilmstripRequest& request, double aspect) {
  Layout layout;
  const int count = static_cast<int>(request.times.size());
  layout.columns = std::clamp(request.columns > 0 ? request.columns : std::min(count, 6), 1, count);
  const int chunks = (count + layout.columns - 1) / layout.columns;
  layout.lines = chunks * static_cast<int>(request.rows.size());
  const double unit = layout.unit = request.scale;
  const auto pixels = [unit](double length) {
    return static_cast<int>(std::lround(unit * length));
  };

  // Unless asked for, frames fill a page about 1600 wide, in a height that reads well.
  double height = request.frame_height, width = request.frame_width;
  if (height == 0 && width == 0) {
    const double room = (1600.0 - 2 * 28 - 14.0 * (layout.columns - 1)) / layout.columns;
    height = std::clamp(room / aspect, 200.0, 520.0);
    width = height * aspect;
  } else if (height == 0) {
    height = width / aspect;
  } else if (width == 0) {
    width = height * aspect;
  }
  layout.frame_width = std::max(pixels(width), 16);
  layout.frame_height = std::max(pixels(height), 16);
  layout.margin = pixels(28);
  layout.gap = pixels(14);
  layout.caption = pixels(34);
  layout.header = request.title.empty() && request.caption.empty()   ? 0
                  : request.title.empty() || request.caption.empty() ? pixels(44)
                                                                     : pixels(70);
  const bool labelled = std::any_of(request.rows.begin(), request.rows.end(),
                                    [](const auto& row) { return !row.label.empty(); });
  layout.label = labelled ? pixels(32) : 0;
  layout.width =
      2 * layout.margin + layout.columns * layout.frame_width + (layout.columns - 1) * layout.gap;
  layout.height = 2 * layout.margin - pixels(8) + layout.header +
                  layout.lines * (layout.label + layout.frame_height + layout.caption) +
                  (layout.lines - 1) * pixels(6);
  return layout;
}

std::vector<float> limb_parts(const World& world, const FilmstripRequest& request) {
  std::vector<float> parts;
  const auto actor = static_cast<std::size_t>(std::max(request.actor, 0));
  if (actor >= world.actors.size() || !world.actors[actor].model || request.limb.empty()) {
    return parts;
  }
  parts.resize(world.actors[actor].model->skeleton.joints.size(), 0.0f);
  for (const int node : request.limb) {
    if (node >= 0 && node < static_cast<int>(parts.size())) {
      parts[static_cast<std::size_t>(node)] = 1.0f;
    }
  }
  return parts;
}

// One frame's picture, in the layout's frame size.
Result<Picture> draw_frame(SceneRenderer& renderer, const FilmstripRequest& request,
                           const FilmstripRow& row, std::size_t time, const Shot& shot,
                           const Layout& layout) {
  std::vector<ActorState> states, ghost_states;
  world_state_at(*row.world, request.times[time], states);
  Frame frame;
  frame.world = row.world;
  frame.states = &states;
  frame.size = shot.size;
  frame.ground = shot.ground;
  frame.trails = row.trails;
  if (time < row.contacts.size()) frame.contacts = row.contacts[time];
  const auto actor = static_cast<std::size_t>(std::max(request.actor, 0));
  const auto parts = limb_parts(*row.world, request);
  if (!parts.empty() && row.limb_strength > 0) {
    frame.looks.resize(actor + 1);
    frame.looks[actor].emphasis = parts;
    frame.looks[actor].emphasis_colour = row.limb_colour;
    frame.looks[actor].emphasis_strength = row.limb_strength;
  }
  if (row.ghost != nullptr && actor < row.ghost->actors.size()) {
    world_state_at(*row.ghost, request.times[time], ghost_states);
    Ghost ghost;
    ghost.actor = &row.ghost->actors[actor];
    ghost.state = &ghost_states[actor];
    ghost.colour = request.style.ghost;
    ghost.parts = parts;
    frame.ghosts.push_back(ghost);
  }
  // A very large frame is fine enough as it is.
  const bool fine = request.fine && layout.frame_width * layout.frame_height < 4'000'000;
  const int factor = fine ? 2 : 1;
  frame.pixel_scale = layout.unit * factor;
  const auto drawn = renderer.draw(frame, shot.cameras[time], request.style,
                                   {factor * layout.frame_width, factor * layout.frame_height});
  if (!drawn) return drawn.error();
  Picture picture = renderer.read();
  return fine ? halved(picture) : picture;
}

struct Fonts {
  Font regular = Font::load(Weight::regular);
  Font medium = Font::load(Weight::medium);
  Font semibold = Font::load(Weight::semibold);
};

// Shortens text with an ellipsis until it fits.
std::string fitting(const Font& font, std::string text, double size, double room) {
  if (font.width(text, size) <= room) return text;
  while (!text.empty() && font.width(text + "…", size) > room) {
    text.pop_back();
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0u) == 0x80u) {
      text.pop_back();
    }
  }
  return text + "…";
}

// The line under a frame: its time, and what is known of contacts.
void draw_caption(Picture& page, const Fonts& fonts, const FilmstripRequest& request,
                  const FilmstripRow& row, std::size_t time, const Layout& layout, int x, int y) {
  const double unit = layout.unit;
  const double baseline = y + 23 * unit;
  fonts.medium.draw(page, x + 2 * unit, baseline, time_text(request.times[time]), 15 * unit, kText);
  if (row.contacts.empty()) return;
  const bool contact = time < row.contacts.size() && !row.contacts[time].empty();
  const std::string text = contact ? "contact" : "clear";
  const Rgb colour = contact ? request.style.problem : request.style.good;
  const double width = fonts.medium.width(text, 13.5 * unit);
  const double left = x + layout.frame_width - width - 2 * unit;
  fonts.medium.draw(page, left, baseline, text, 13.5 * unit, colour);
  // A filled dot is a contact, an open one none: the colour is not the only sign.
  const double side = 9 * unit, dot_x = left - side - 6 * unit,
               dot_y = baseline - side - 0.5 * unit;
  if (contact) {
    fill_rounded(page, dot_x, dot_y, side, side, 0.5 * side, colour);
  } else {
    outline_rounded(page, dot_x, dot_y, side, side, 0.5 * side, 1.6 * unit, colour);
  }
}

void draw_header(Picture& page, const Fonts& fonts, const FilmstripRequest& request,
                 const Layout& layout) {
  const double unit = layout.unit, room = layout.width - 2 * layout.margin;
  double y = layout.margin;
  if (!request.title.empty()) {
    y += 19 * unit;
    fonts.semibold.draw(page, layout.margin, y,
                        fitting(fonts.semibold, request.title, 22 * unit, room), 22 * unit, kText);
    y += 26 * unit;
  } else {
    y += 14 * unit;
  }
  if (!request.caption.empty()) {
    fonts.regular.draw(page, layout.margin, y,
                       fitting(fonts.regular, request.caption, 15 * unit, room), 15 * unit, kQuiet);
  }
}

}  // namespace

Style FilmstripRequest::strip_style() {
  Style style;
  style.key_follows_camera = true;
  style.key_elevation = 40;
  return style;
}

Result<Picture> render_filmstrip(SceneRenderer& renderer, const FilmstripRequest& request,
                                 std::vector<std::string>* warnings) {
  if (auto error = check(request)) return *error;
  ShotRequest wanted;
  for (const auto& row : request.rows) {
    wanted.worlds.push_back(row.world);
    for (std::size_t i = 0; i < row.contacts.size() && i < request.times.size(); ++i) {
      wanted.contacts.resize(request.times.size());
      for (const auto& mark : row.contacts[i]) wanted.contacts[i].push_back(mark.place);
    }
  }
  wanted.times = request.times;
  wanted.actor = request.actor;
  wanted.character = request.character;
  wanted.limb = request.limb;
  wanted.forward = request.forward;
  wanted.azimuth = request.azimuth;
  wanted.elevation = request.elevation;
  wanted.focus = request.focus;
  wanted.extent = request.extent;
  wanted.move = request.move;
  const bool sized = request.frame_width > 0 && request.frame_height > 0;
  const double aspect =
      sized ? static_cast<double>(request.frame_width) / request.frame_height : 0.0;
  const Shot shot = plan_shot(renderer, wanted, aspect);
  const Layout layout = lay_out(request, shot.aspect);
  if (std::int64_t{layout.width} * layout.height > kMostPixels) {
    return bad_request("the picture would have more than 120 million pixels",
                       "give fewer times, smaller frames or a smaller scale");
  }
  const Fonts fonts;
  if (warnings != nullptr && !fonts.regular.found()) {
    warnings->push_back(std::string("no font found, the picture has no captions: ") +
                        font_remedy());
  }

  Picture page(layout.width, layout.height, kPage);
  draw_header(page, fonts, request, layout);
  const double radius = 8 * layout.unit;
  int y = layout.margin + layout.header;
  const std::size_t columns = static_cast<std::size_t>(layout.columns);
  for (std::size_t first = 0; first < request.times.size(); first += columns) {
    for (const auto& row : request.rows) {
      if (layout.label > 0) {
        fonts.semibold.draw(page, layout.margin + 2 * layout.unit, y + 18 * layout.unit, row.label,
                            16 * layout.unit, row.label_colour);
      }
      y += layout.label;
      for (std::size_t i = first; i < std::min(first + columns, request.times.size()); ++i) {
        const auto picture = draw_frame(renderer, request, row, i, shot, layout);
        if (!picture) return picture.error();
        const int x =
            layout.margin + static_cast<int>(i - first) * (layout.frame_width + layout.gap);
        paste_rounded(page, *picture, x, y, radius);
        outline_rounded(page, x, y, layout.frame_width, layout.frame_height, radius, layout.unit,
                        kLine);
        draw_caption(page, fonts, request, row, i, layout, x, y + layout.frame_height);
      }
      y += layout.frame_height + layout.caption + static_cast<int>(std::lround(6 * layout.unit));
    }
  }
  return page;
}

Result<Picture> render_filmstrip(const FilmstripRequest& request,
                                 std::vector<std::string>* warnings) {
  if (auto error = check(request)) return *error;
  auto context = OffscreenContext::create();
  if (!context) return context.error();
  auto renderer = SceneRenderer::create();
  if (!renderer) return renderer.error();
  return render_filmstrip(*renderer, request, warnings);
}

}  // namespace elbowroom
