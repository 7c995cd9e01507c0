// SPDX-License-Identifier: MIT
#include "ui/panels/limb_joints.h"

#include <algorithm>
#include <cctype>

#include "core/scene/joint_name.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

constexpr std::array<LimbKind, 4> kUsual = {LimbKind::left_arm, LimbKind::right_arm,
                                            LimbKind::left_leg, LimbKind::right_leg};
constexpr float kLimbs = 190;  // width of the list of limbs, pixels at 100 %

const Model& model_of(const PanelContext& context) { return context.state.session->scene.model(); }

bool is_usual(const std::string& limb) {
  return std::any_of(kUsual.begin(), kUsual.end(),
                     [&](LimbKind kind) { return limb == limb_id(kind); });
}

const Limb* found_limb(const PanelContext& context, const std::string& name) {
  for (const LimbModel& limb : context.state.session->limbs)
    if (limb.limb.name == name) return &limb.limb;
  return nullptr;
}

const LimbJoints* set_by_hand(const PanelContext& context, const std::string& name) {
  const auto set = context.state.document->limbs.find(name);
  return set == context.state.document->limbs.end() ? nullptr : &set->second;
}

std::string shown_name(const PanelContext& context, int joint) {
  if (joint < 0) return "";
  const std::string& name = model_of(context).skeleton.joints[static_cast<std::size_t>(joint)].name;
  return name.empty() ? "node " + std::to_string(joint) : name;
}

// What means this joint and no other: its name, or its index where the name is another's too.
std::string reference(const PanelContext& context, int joint) {
  if (joint < 0) return "";
  const Model& model = model_of(context);
  const std::string& name = model.skeleton.joints[static_cast<std::size_t>(joint)].name;
  const NamedJoint named = joint_of_name(model, context.state.session->character(), name);
  return !name.empty() && named.node == joint ? name : std::to_string(joint);
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Why a limb is not there, as the finder has it.
std::string why_missing(const PanelContext& context, const std::string& limb) {
  for (const std::string& warning : context.state.session->warnings)
    if (warning.rfind(limb, 0) == 0) return warning.substr(limb.size());
  return " is not found";
}

// Joints of the skins and what stands above or below them, parents first; how deep each is.
struct Listed {
  int joint = -1, depth = 0;
};
std::vector<Listed> joints_to_choose(const PanelContext& context) {
  const Model& model = model_of(context);
  const Skeleton& skeleton = model.skeleton;
  std::vector<char> listed(skeleton.joints.size(), 0), mesh(skeleton.joints.size(), 0);
  for (const Mesh& one : model.meshes)
    if (one.node >= 0) mesh[static_cast<std::size_t>(one.node)] = 1;
  for (int joint : context.state.session->character().joints)
    for (; joint >= 0 && !listed[static_cast<std::size_t>(joint)];
         joint = skeleton.joints[static_cast<std::size_t>(joint)].parent)
      listed[static_cast<std::size_t>(joint)] = 1;
  for (const int joint : skeleton.order) {
    const auto j = static_cast<std::size_t>(joint);
    const int parent = skeleton.joints[j].parent;
    if (parent >= 0 && listed[static_cast<std::size_t>(parent)] && !mesh[j]) listed[j] = 1;
  }
  std::vector<std::vector<int>> children(skeleton.joints.size());
  std::vector<Listed> stack, list;
  for (auto it = skeleton.order.rbegin(); it != skeleton.order.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    if (!listed[j]) continue;
    const int parent = skeleton.joints[j].parent;
    if (parent < 0)
      stack.push_back({*it, 0});
    else
      children[static_cast<std::size_t>(parent)].push_back(*it);
  }
  while (!stack.empty()) {
    const Listed next = stack.back();
    stack.pop_back();
    list.push_back(next);
    for (const int child : children[static_cast<std::size_t>(next.joint)])
      stack.push_back({child, next.depth + 1});
  }
  return list;
}

std::array<const char*, 3> slot_names(const std::string& limb) {
  if (limb == limb_id(LimbKind::left_arm) || limb == limb_id(LimbKind::right_arm))
    return {"Shoulder", "Elbow", "Wrist"};
  if (limb == limb_id(LimbKind::left_leg) || limb == limb_id(LimbKind::right_leg))
    return {"Hip", "Knee", "Ankle"};
  return {"Root", "Middle", "End"};
}

}  // namespace

void LimbJointsDialog::open(const PanelContext& context) {
  std::string limb = std::exchange(context.view.joints_of, {});
  if (limb.empty() && context.state.limb_model()) limb = context.state.limb_model()->limb.name;
  choose(context, limb.empty() ? limb_id(LimbKind::left_arm) : limb);
}

void LimbJointsDialog::choose(const PanelContext& context, const std::string& limb) {
  limb_ = limb;
  slot_ = 0;
  search_.clear();
  joints_ = {-1, -1, -1};
  touched_ = false;
  if (const Limb* found = found_limb(context, limb))
    joints_ = {found->root, found->middle, found->end};
  scroll_ = true;
  try_it(context);
}

LimbJoints LimbJointsDialog::wanted(const PanelContext& context) const {
  return {reference(context, joints_[0]), reference(context, joints_[1]),
          reference(context, joints_[2])};
}

void LimbJointsDialog::try_it(const PanelContext& context) {
  tried_.reset();
  error_.reset();
  gives_way_.clear();
  if (joints_[0] < 0 || joints_[2] < 0) return;
  const Session& session = *context.state.session;
  const Model& model = session.scene.model();
  const std::string name = limb_.empty() ? "chain" : limb_;
  auto limb = limb_between(model, session.character(), name, wanted(context));
  if (!limb) {
    error_ = limb.error();
    return;
  }
  if (auto fitted = fit_limb_model(model, session.character(), *limb, session.findings); !fitted) {
    error_ = fitted.error();
    return;
  }
  tried_ = std::move(*limb);
  for (const LimbModel& other : session.limbs)
    if (other.limb.name != name && (model.skeleton.is_within(other.limb.root, tried_->root) ||
                                    model.skeleton.is_within(tried_->root, other.limb.root)))
      gives_way_.push_back(limb_title(other.limb.name));
}

// A click in the list: the slot has its joint, the next one is to follow.
void LimbJointsDialog::set_joint(const PanelContext& context, int joint) {
  joints_[slot_] = joint;
  touched_ = true;
  // A middle that was of other ends is none of these.
  if (slot_ != 1 && joints_[0] >= 0 && joints_[2] >= 0 && joints_[1] >= 0) {
    const Skeleton& skeleton = model_of(context).skeleton;
    if (joints_[1] == joints_[0] || joints_[1] == joints_[2] ||
        !skeleton.is_within(joints_[1], joints_[0]) || !skeleton.is_within(joints_[2], joints_[1]))
      joints_[1] = -1;
  }
  if (slot_ == 0 && joints_[2] < 0) slot_ = 2;
  search_.clear();
  scroll_ = true;
  try_it(context);
}

void LimbJointsDialog::list_limbs(const PanelContext& context) {
  const auto row = [&](const std::string& name, const std::string& title) {
    RowOptions options;
    const bool there = found_limb(context, name) != nullptr;
    const LimbJoints* by_hand = set_by_hand(context, name);
    options.icon = there ? Icon::dot : Icon::ring;
    options.icon_tone = there ? Tone::good : Tone::faint;
    options.tone = there ? Tone::text : Tone::quiet;
    options.right = by_hand ? (by_hand->none() ? "none" : "by hand")
                    : there ? "found"
                            : "not found";
    options.right_tone = Tone::quiet;
    options.selected = limb_ == name;
    if (list_row(context.ui, title, options).clicked) choose(context, name);
  };
  for (const LimbKind kind : kUsual) row(limb_id(kind), limb_title(limb_id(kind)));
  for (const LimbModel& limb : context.state.session->limbs)
    if (!is_usual(limb.limb.name)) row(limb.limb.name, limb.limb.name);
  for (const auto& [name, joints] : context.state.document->limbs)
    if (!is_usual(name) && !found_limb(context, name)) row(name, name);
  RowOptions fresh;
  fresh.icon = Icon::plus;
  fresh.selected = limb_.empty();
  fresh.hint = "A tail, a tentacle, a spine: any chain of joints, by a name of your own";
  if (list_row(context.ui, "New chain…###New chain", fresh).clicked) choose(context, "");
}

void LimbJointsDialog::describe(const PanelContext& context) {
  Ui& ui = context.ui;
  if (limb_.empty()) {
    text_input(ui, "Name of the chain", new_name_, {.placeholder = "tail"});
    return;
  }
  title(ui, limb_title(limb_));
  const Limb* found = found_limb(context, limb_);
  const LimbJoints* by_hand = set_by_hand(context, limb_);
  if (touched_ && tried_)
    note(ui, "Chosen: " + tried_->why + ".");
  else if (found)
    note(ui, (by_hand ? "Set by hand: " : "Why: ") + found->why + ".");
  else
    note(ui, limb_title(limb_) + why_missing(context, limb_) + ".");
}

void LimbJointsDialog::list_slots(const PanelContext& context) {
  const auto names = slot_names(limb_);
  for (std::size_t i = 0; i < names.size(); ++i) {
    RowOptions row;
    std::string joint = shown_name(context, joints_[i]);
    if (i == 1 && joints_[1] < 0)
      joint = tried_ ? shown_name(context, tried_->middle) + " (by itself)" : "by itself";
    if (joint.empty()) joint = "choose below";
    row.right = joint;
    row.right_tone = joints_[i] >= 0 ? Tone::text : Tone::quiet;
    row.selected = slot_ == i;
    row.icon = Icon::none;
    row.hint = "Click, then choose a joint in the list below";
    if (i == 1 && joints_[1] >= 0) row.actions = {{Icon::close, "By itself", false, true}};
    const RowResult result = list_row(context.ui, std::string(names[i]), row);
    if (result.clicked) {
      slot_ = i;
      scroll_ = true;
    }
    if (result.action == 0) {
      joints_[1] = -1;
      touched_ = true;
      try_it(context);
    }
  }
}

void LimbJointsDialog::list_joints(const PanelContext& context, float height) {
  Ui& ui = context.ui;
  TextOptions options;
  options.placeholder = "Search joints";
  options.label_shown = false;
  text_input(ui, "Search joints", search_, options);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, mixed(ui.palette().panel, ui.palette().ground, 0.7f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(4)});
  if (ImGui::BeginChild("joints", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding)) {
    const std::string wanted = lower(search_);
    int shown = 0;
    for (const Listed& listed : joints_to_choose(context)) {
      const std::string name = shown_name(context, listed.joint);
      if (!wanted.empty() && lower(name).find(wanted) == std::string::npos) continue;
      ++shown;
      const auto scope = ui.scope(listed.joint);
      RowOptions row;
      row.icon = Icon::none;
      row.indent = wanted.empty() ? std::min(listed.depth, 14) : 0;
      std::string role;
      for (std::size_t i = 0; i < joints_.size(); ++i)
        if (joints_[i] == listed.joint) role = lower(slot_names(limb_)[i]);
      row.right = role;
      row.right_tone = Tone::accent;
      row.selected = joints_[slot_] == listed.joint;
      const std::string hint = "Click: this is the " + lower(slot_names(limb_)[slot_]);
      row.hint = hint;
      if (row.selected && scroll_) {
        ImGui::SetScrollHereY(0.5f);
        scroll_ = false;
      }
      if (list_row(ui, name, row).clicked) set_joint(context, listed.joint);
    }
    if (shown == 0) note(ui, "No joint has that in its name.", Tone::quiet);
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

void LimbJointsDialog::verdict(const PanelContext& context) {
  Ui& ui = context.ui;
  if (error_) {
    inline_error(ui, {sentence(error_->what), "", sentence(error_->remedy)}, false);
    return;
  }
  if (gives_way_.empty()) return;
  std::string others;
  for (const std::string& other : gives_way_) others += (others.empty() ? "" : ", ") + other;
  inline_note(ui, Tone::selection, others + " will give way", "They share joints with it.");
}

void LimbJointsDialog::answers(const PanelContext& context) {
  Ui& ui = context.ui;
  const std::string name = limb_.empty() ? new_name_ : limb_;
  const LimbJoints* by_hand = limb_.empty() ? nullptr : set_by_hand(context, limb_);
  const auto answer = [&](std::optional<LimbJoints> joints) {
    context.emit(command::SetLimbJoints{name, std::move(joints)});
    context.view.dialog = Dialog::none;
  };
  const bool named =
      !limb_.empty() ||
      (!new_name_.empty() && !is_usual(new_name_) && !found_limb(context, new_name_) &&
       new_name_.find("..") == std::string::npos && new_name_ != "auto");
  const bool another = touched_ || limb_.empty();
  const ButtonOptions use{.look = ButtonLook::primary,
                          .hint = "The limb goes over these joints from now on",
                          .enabled = tried_.has_value() && named && another,
                          .why_not = !named    ? "Give the chain a name that is no other limb's"
                                     : error_  ? "These joints are no limb: see above"
                                     : !tried_ ? "Choose its first and its last joint"
                                               : "These are its joints already"};
  const ButtonOptions none{
      .look = ButtonLook::danger,
      .hint = is_usual(limb_) ? "This character has no such limb" : "Takes the chain away",
      .enabled = is_usual(limb_) ? !(by_hand && by_hand->none()) : by_hand != nullptr,
      .why_not = "It is none already"};
  const ButtonOptions as_found{.hint = "What is set by hand is taken away",
                               .enabled = by_hand && is_usual(limb_),
                               .why_not = "Nothing is set by hand"};
  const ButtonOptions cancel{};
  if (button(ui, "Not a limb", none))
    answer(is_usual(limb_) ? std::optional(LimbJoints{}) : std::nullopt);
  ImGui::SameLine();
  if (button(ui, "As found", as_found)) answer(std::nullopt);
  const float right = button_width(ui, "Use these joints", use) +
                      button_width(ui, "Cancel", cancel) + ui.px(ui.theme().metrics.gap);
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                       std::max(0.0f, ImGui::GetContentRegionAvail().x - right));
  if (button(ui, "Cancel", cancel)) context.view.dialog = Dialog::none;
  ImGui::SameLine();
  if (button(ui, "Use these joints", use)) answer(wanted(context));
}

void LimbJointsDialog::draw(const PanelContext& context) {
  Ui& ui = context.ui;
  bool open = context.state.open();
  if (begin_dialog(ui, "Joints of the limbs", open, {760, 620})) {
    const float foot = ui.px(ui.theme().metrics.control + 10);
    const float all = ImGui::GetContentRegionAvail().y - foot;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    if (ImGui::BeginChild("limbs", {ui.px(kLimbs), all})) list_limbs(context);
    ImGui::EndChild();
    ImGui::SameLine(0, ui.px(16));
    if (ImGui::BeginChild("limb", {0, all})) {
      describe(context);
      list_slots(context);
      space(ui, 6);
      const float said = error_ || !gives_way_.empty() ? ui.px(64) : 0;
      const float search = ui.px(ui.theme().metrics.control + ui.theme().metrics.gap);
      list_joints(context, std::max(ui.px(80), ImGui::GetContentRegionAvail().y - search - said));
      verdict(context);
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    answers(context);
    end_dialog(ui);
  }
  if (!open) context.view.dialog = Dialog::none;
}

}  // namespace elbowroom
