// SPDX-License-Identifier: MIT
#include "ui/toolkit/theme.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

double linear(ImU32 channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(ImU32 colour) {
  return 0.2126 * linear((colour >> IM_COL32_R_SHIFT) & 0xffu) +
         0.7152 * linear((colour >> IM_COL32_G_SHIFT) & 0xffu) +
         0.0722 * linear((colour >> IM_COL32_B_SHIFT) & 0xffu);
}

ImVec4 vector_of(ImU32 colour) { return ImGui::ColorConvertU32ToFloat4(colour); }

}  // namespace

ImU32 Palette::of(Tone tone) const {
  switch (tone) {
    case Tone::text:
      return text;
    case Tone::quiet:
      return quiet;
    case Tone::faint:
      return faint;
    case Tone::accent:
      return accent;
    case Tone::problem:
      return problem;
    case Tone::good:
      return good;
    case Tone::selection:
      return selection;
    case Tone::ghost:
      return ghost;
  }
  return text;
}

Theme dark_theme() {
  Theme theme;
  Palette& p = theme.palette;
  p.ground = colour_of(0x16181d);
  p.panel = colour_of(0x1d2027);
  p.raised = colour_of(0x232731);
  p.line = colour_of(0x2d323d);
  p.text = colour_of(0xe6e9ef);
  p.quiet = colour_of(0x9aa3b2);
  p.faint = colour_of(0x868fa1);  // as dim as 4.5:1 on every ground allows
  p.accent = colour_of(0x4da3ff);
  p.problem = colour_of(0xff7a45);
  p.good = colour_of(0x3ecf9a);
  p.selection = colour_of(0xffd166);
  p.ghost = colour_of(0xa78bfa);
  p.on_accent = colour_of(0x0a1626);
  p.handle = colour_of(0xe6e9ef);
  p.dark = true;
  return theme;
}

Theme light_theme() {
  Theme theme;
  Palette& p = theme.palette;
  p.ground = colour_of(0xe9ecf1);
  p.panel = colour_of(0xf6f7f9);
  p.raised = colour_of(0xffffff);
  p.line = colour_of(0xd2d7e0);
  p.text = colour_of(0x1b1f27);
  p.quiet = colour_of(0x48515f);
  p.faint = colour_of(0x5d6675);
  p.accent = colour_of(0x1560c4);
  p.problem = colour_of(0xb03a0a);
  p.good = colour_of(0x0b6b4b);
  p.selection = colour_of(0x7d5700);
  p.ghost = colour_of(0x5f43c4);
  p.on_accent = colour_of(0xffffff);
  p.handle = colour_of(0x2b313c);
  p.dark = false;
  return theme;
}

ImU32 with_opacity(ImU32 colour, float opacity) {
  const float alpha = std::clamp(std::isfinite(opacity) ? opacity : 1.0f, 0.0f, 1.0f);
  return (colour & ~IM_COL32_A_MASK) |
         (static_cast<ImU32>(std::lround(alpha * 255)) << IM_COL32_A_SHIFT);
}

ImU32 mixed(ImU32 a, ImU32 b, float t) {
  const ImVec4 from = vector_of(a), to = vector_of(b);
  const float w = std::clamp(std::isfinite(t) ? t : 0.0f, 0.0f, 1.0f);
  return ImGui::ColorConvertFloat4ToU32({from.x + (to.x - from.x) * w, from.y + (to.y - from.y) * w,
                                         from.z + (to.z - from.z) * w,
                                         from.w + (to.w - from.w) * w});
}

double contrast(ImU32 a, ImU32 b) {
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

float usable_scale(double scale) {
  return std::isfinite(scale) ? static_cast<float>(std::clamp(scale, 0.75, 3.0)) : 1.0f;
}

void apply(const Theme& theme, double wanted_scale) {
  const float scale = usable_scale(wanted_scale);
  const auto px = [scale](float size) { return std::round(size * scale); };
  const Palette& p = theme.palette;
  const Metrics& m = theme.metrics;

  ImGuiStyle style;  // all that is not set here is Dear ImGui's default, whatever was set before
  style.WindowPadding = {px(m.padding), px(m.gap)};
  style.WindowRounding = 0;
  style.WindowBorderSize = 0;
  style.ChildRounding = px(m.rounding);
  style.ChildBorderSize = 0;
  style.PopupRounding = px(m.rounding);
  style.PopupBorderSize = std::max(1.0f, px(1));
  style.FramePadding = {px(10), std::floor((px(m.control) - px(m.text)) / 2)};
  style.FrameRounding = px(m.rounding);
  style.FrameBorderSize = 0;
  style.ItemSpacing = {px(m.gap), px(6)};
  style.ItemInnerSpacing = {px(6), px(4)};
  style.IndentSpacing = px(16);
  style.ScrollbarSize = px(10);
  style.ScrollbarRounding = px(5);
  style.GrabMinSize = px(10);
  style.GrabRounding = px(3);
  style.TabRounding = px(m.rounding);
  style.WindowMinSize = {px(32), px(16)};
  style.DisplaySafeAreaPadding = {px(4), px(4)};
  style.CircleTessellationMaxError = 0.15f;
  style.CurveTessellationTol = 0.8f;

  const auto set = [&style](ImGuiCol which, ImU32 colour) {
    style.Colors[which] = vector_of(colour);
  };
  const ImU32 hovered = mixed(p.raised, p.text, 0.07f), held = mixed(p.raised, p.text, 0.13f);
  set(ImGuiCol_Text, p.text);
  set(ImGuiCol_TextDisabled, p.faint);
  set(ImGuiCol_WindowBg, p.panel);
  set(ImGuiCol_ChildBg, with_opacity(p.panel, 0));
  set(ImGuiCol_PopupBg, p.raised);
  set(ImGuiCol_Border, p.line);
  set(ImGuiCol_BorderShadow, 0);
  set(ImGuiCol_FrameBg, p.raised);
  set(ImGuiCol_FrameBgHovered, hovered);
  set(ImGuiCol_FrameBgActive, held);
  set(ImGuiCol_TitleBg, p.raised);
  set(ImGuiCol_TitleBgActive, p.raised);
  set(ImGuiCol_TitleBgCollapsed, p.raised);
  set(ImGuiCol_MenuBarBg, p.panel);
  set(ImGuiCol_ScrollbarBg, with_opacity(p.panel, 0));
  set(ImGuiCol_ScrollbarGrab, mixed(p.line, p.text, 0.06f));
  set(ImGuiCol_ScrollbarGrabHovered, mixed(p.line, p.text, 0.2f));
  set(ImGuiCol_ScrollbarGrabActive, mixed(p.line, p.text, 0.3f));
  set(ImGuiCol_CheckMark, p.accent);
  set(ImGuiCol_SliderGrab, p.handle);
  set(ImGuiCol_SliderGrabActive, p.handle);
  set(ImGuiCol_Button, p.raised);
  set(ImGuiCol_ButtonHovered, hovered);
  set(ImGuiCol_ButtonActive, held);
  set(ImGuiCol_Header, mixed(p.raised, p.accent, 0.16f));
  set(ImGuiCol_HeaderHovered, hovered);
  set(ImGuiCol_HeaderActive, held);
  set(ImGuiCol_Separator, p.line);
  set(ImGuiCol_SeparatorHovered, p.accent);
  set(ImGuiCol_SeparatorActive, p.accent);
  set(ImGuiCol_ResizeGrip, 0);
  set(ImGuiCol_ResizeGripHovered, p.line);
  set(ImGuiCol_ResizeGripActive, p.accent);
  set(ImGuiCol_Tab, p.panel);
  set(ImGuiCol_TabHovered, hovered);
  set(ImGuiCol_TabActive, p.raised);
  set(ImGuiCol_TabUnfocused, p.panel);
  set(ImGuiCol_TabUnfocusedActive, p.raised);
  set(ImGuiCol_TextSelectedBg, with_opacity(p.accent, 0.35f));
  set(ImGuiCol_DragDropTarget, p.selection);
  set(ImGuiCol_NavHighlight, p.accent);
  set(ImGuiCol_NavWindowingHighlight, p.accent);
  set(ImGuiCol_ModalWindowDimBg, with_opacity(colour_of(0x000000), p.dark ? 0.5f : 0.3f));
  set(ImGuiCol_NavWindowingDimBg, with_opacity(colour_of(0x000000), 0.3f));
  ImGui::GetStyle() = style;
}

}  // namespace elbowroom
