// SPDX-License-Identifier: MIT
#include "ui/toolkit/icons.h"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace elbowroom {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Draws in a grid from -8 to 8, y downwards.
class Pen {
 public:
  Pen(ImDrawList& list, ImVec2 centre, float size, ImU32 colour)
      : list_(list), centre_(std::round(centre.x), std::round(centre.y)), unit_(size / 16),
        width_(std::max(1.0f, 1.5f * size / 16)), colour_(colour) {}

  ImVec2 at(ImVec2 p) const { return {centre_.x + p.x * unit_, centre_.y + p.y * unit_}; }
  void line(std::initializer_list<ImVec2> points, bool closed = false) const {
    const std::vector<ImVec2> path = mapped(points);
    list_.AddPolyline(path.data(), static_cast<int>(path.size()), colour_,
                      closed ? ImDrawFlags_Closed : ImDrawFlags_None, width_);
  }
  void fill(std::initializer_list<ImVec2> points) const {
    const std::vector<ImVec2> path = mapped(points);
    list_.AddConvexPolyFilled(path.data(), static_cast<int>(path.size()), colour_);
  }
  void ring(ImVec2 centre, float radius) const {
    list_.AddCircle(at(centre), radius * unit_, colour_, 0, width_);
  }
  void disc(ImVec2 centre, float radius) const {
    list_.AddCircleFilled(at(centre), radius * unit_, colour_, 0);
  }
  // Angles from +x towards +y (clockwise on the screen).
  void arc(ImVec2 centre, float radius, float from, float to) const {
    list_.PathArcTo(at(centre), radius * unit_, from, to, 24);
    list_.PathStroke(colour_, 0, width_);
  }
  void box(ImVec2 a, ImVec2 b, float rounding) const {
    list_.AddRect(at(a), at(b), colour_, rounding * unit_, 0, width_);
  }

 private:
  std::vector<ImVec2> mapped(std::initializer_list<ImVec2> points) const {
    std::vector<ImVec2> path;
    for (const ImVec2& p : points) path.push_back(at(p));
    return path;
  }
  ImDrawList& list_;
  ImVec2 centre_;
  float unit_, width_;
  ImU32 colour_;
};

void turn(const Pen& pen, bool clockwise) {
  const float side = clockwise ? 1.0f : -1.0f;
  if (clockwise) {
    pen.arc({0, 1}, 5, -kPi * 0.95f, kPi * 0.35f);
  } else {
    pen.arc({0, 1}, 5, kPi * 0.65f, kPi * 1.95f);
  }
  pen.fill({{side * -7.5f, 0.6f}, {side * -2.2f, 0.6f}, {side * -4.9f, 4.6f}});
}

void almond(const Pen& pen) {
  pen.line({{-7, 0}, {-4.5f, -3}, {-1.5f, -4.4f}, {1.5f, -4.4f}, {4.5f, -3}, {7, 0},
            {4.5f, 3}, {1.5f, 4.4f}, {-1.5f, 4.4f}, {-4.5f, 3}}, true);
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float size, ImU32 colour) {
  const Pen pen(list, centre, size, colour);
  switch (icon) {
    case Icon::none: return;
    case Icon::play: return pen.fill({{-4, -6}, {6.5f, 0}, {-4, 6}});
    case Icon::pause:
      pen.fill({{-5, -6}, {-1.5f, -6}, {-1.5f, 6}, {-5, 6}});
      return pen.fill({{1.5f, -6}, {5, -6}, {5, 6}, {1.5f, 6}});
    case Icon::first:
      pen.line({{-5.5f, -5.5f}, {-5.5f, 5.5f}});
      return pen.fill({{5, -5.5f}, {5, 5.5f}, {-3.5f, 0}});
    case Icon::last:
      pen.line({{5.5f, -5.5f}, {5.5f, 5.5f}});
      return pen.fill({{-5, -5.5f}, {3.5f, 0}, {-5, 5.5f}});
    case Icon::step_back: return pen.fill({{3.5f, -5.5f}, {3.5f, 5.5f}, {-5, 0}});
    case Icon::step_forward: return pen.fill({{-3.5f, -5.5f}, {5, 0}, {-3.5f, 5.5f}});
    case Icon::loop:
      pen.line({{-4, -3.5f}, {4, -3.5f}, {6, -1.5f}, {6, 1}});
      pen.line({{4, 3.5f}, {-4, 3.5f}, {-6, 1.5f}, {-6, -1}});
      pen.fill({{-4, 0.4f}, {-4, 6.6f}, {-7.5f, 3.5f}});
      return pen.fill({{4, -6.6f}, {7.5f, -3.5f}, {4, -0.4f}});
    case Icon::eye:
      almond(pen);
      return pen.disc({0, 0}, 2.2f);
    case Icon::eye_off:
      almond(pen);
      return pen.line({{-6, 6}, {6, -6}});
    case Icon::mute:
      pen.fill({{-7, -2.2f}, {-4, -2.2f}, {0, -6}, {0, 6}, {-4, 2.2f}, {-7, 2.2f}});
      pen.line({{2.5f, -2.5f}, {7, 2.5f}});
      return pen.line({{7, -2.5f}, {2.5f, 2.5f}});
    case Icon::solo:
      pen.arc({0, 0}, 5.5f, kPi, 2 * kPi);
      pen.fill({{-7, 0}, {-4, 0}, {-4, 5.5f}, {-7, 5.5f}});
      return pen.fill({{4, 0}, {7, 0}, {7, 5.5f}, {4, 5.5f}});
    case Icon::trash:
      pen.line({{-6, -4}, {6, -4}});
      pen.line({{-2, -6}, {2, -6}});
      pen.line({{-4.5f, -4}, {-3.8f, 6}, {3.8f, 6}, {4.5f, -4}});
      pen.line({{-1.4f, -1.5f}, {-1.4f, 3.5f}});
      return pen.line({{1.4f, -1.5f}, {1.4f, 3.5f}});
    case Icon::undo: return turn(pen, true);
    case Icon::redo: return turn(pen, false);
    case Icon::refresh:
      pen.arc({0, 0.5f}, 5.2f, -kPi * 0.06f, kPi * 1.42f);
      return pen.fill({{-0.8f, -8}, {-0.8f, -1.6f}, {4.4f, -4.8f}});
    case Icon::camera:
      pen.box({-7, -4}, {7, 5.5f}, 1.5f);
      pen.line({{-3, -4}, {-2, -6}, {2, -6}, {3, -4}});
      return pen.ring({0, 0.6f}, 2.6f);
    case Icon::chevron_left: return pen.line({{2, -4.5f}, {-2.5f, 0}, {2, 4.5f}});
    case Icon::chevron_right: return pen.line({{-2, -4.5f}, {2.5f, 0}, {-2, 4.5f}});
    case Icon::chevron_up: return pen.line({{-4.5f, 2}, {0, -2.5f}, {4.5f, 2}});
    case Icon::chevron_down: return pen.line({{-4.5f, -2}, {0, 2.5f}, {4.5f, -2}});
    case Icon::dot: return pen.disc({0, 0}, 3.6f);
    case Icon::ring: return pen.ring({0, 0}, 5);
    case Icon::dotted_ring:
      for (int i = 0; i < 8; ++i) {
        const float a = static_cast<float>(i) * kPi / 4;
        pen.arc({0, 0}, 5, a, a + kPi / 8);
      }
      return;
    case Icon::diamond: return pen.fill({{0, -6}, {6, 0}, {0, 6}, {-6, 0}});
    case Icon::warning:
      pen.line({{0, -6.5f}, {7, 5.8f}, {-7, 5.8f}}, true);
      pen.line({{0, -2}, {0, 2}});
      return pen.disc({0, 3.9f}, 0.95f);
    case Icon::check: return pen.line({{-5.5f, 0.5f}, {-1.8f, 4.2f}, {5.8f, -4.6f}});
    case Icon::plus:
      pen.line({{-5.5f, 0}, {5.5f, 0}});
      return pen.line({{0, -5.5f}, {0, 5.5f}});
    case Icon::close:
      pen.line({{-4.8f, -4.8f}, {4.8f, 4.8f}});
      return pen.line({{4.8f, -4.8f}, {-4.8f, 4.8f}});
    case Icon::file: return pen.line({{-4.5f, -7}, {1.5f, -7}, {5, -3.5f}, {5, 7}, {-4.5f, 7}}, true);
    case Icon::folder:
      return pen.line({{-7, -5}, {-2, -5}, {-0.5f, -3}, {7, -3}, {7, 5.5f}, {-7, 5.5f}}, true);
    case Icon::home:
      pen.line({{-7, 0}, {0, -6.5f}, {7, 0}});
      return pen.line({{-4.8f, -1}, {-4.8f, 6}, {4.8f, 6}, {4.8f, -1}});
    case Icon::search:
      pen.ring({-1.2f, -1.2f}, 4.6f);
      return pen.line({{2.2f, 2.2f}, {6.4f, 6.4f}});
    case Icon::more:
      pen.disc({-5, 0}, 1.4f);
      pen.disc({0, 0}, 1.4f);
      return pen.disc({5, 0}, 1.4f);
    case Icon::move:
      pen.line({{-7, 0}, {7, 0}});
      pen.line({{0, -7}, {0, 7}});
      pen.line({{-2, -5}, {0, -7}, {2, -5}});
      pen.line({{-2, 5}, {0, 7}, {2, 5}});
      pen.line({{-5, -2}, {-7, 0}, {-5, 2}});
      return pen.line({{5, -2}, {7, 0}, {5, 2}});
    case Icon::rotate:
      pen.arc({0, 0}, 6, kPi * 0.15f, kPi * 1.5f);
      pen.disc({0, 0}, 1.5f);
      return pen.fill({{-0.2f, -9}, {-0.2f, -3}, {4.8f, -6}});
    case Icon::target:
      pen.ring({0, 0}, 4.5f);
      pen.line({{-7.5f, 0}, {-2, 0}});
      pen.line({{2, 0}, {7.5f, 0}});
      pen.line({{0, -7.5f}, {0, -2}});
      return pen.line({{0, 2}, {0, 7.5f}});
    case Icon::lock:
      pen.box({-5, -1}, {5, 6.5f}, 1.2f);
      return pen.line({{-3, -1}, {-3, -4}, {-1.6f, -6}, {1.6f, -6}, {3, -4}, {3, -1}});
  }
}

}  // namespace elbowroom
