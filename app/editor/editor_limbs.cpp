// SPDX-License-Identifier: MIT
// What the character's limbs are and how far they may swing, as the animator says: the document is
// changed at once, the session follows in the background.
#include <algorithm>
#include <utility>

#include "app/editor/editor.h"
#include "core/anatomy/limits.h"

namespace elbowroom {
namespace {

void put_swing_limit(Document& document, const std::string& limb, LimbJointRole role,
                     const SwingPolygon& polygon) {
  auto& polygons = document.swing_limits[limb];
  polygons[static_cast<std::size_t>(role)] = polygon;
  if (std::all_of(polygons.begin(), polygons.end(), [](const auto& p) { return p.empty(); }))
    document.swing_limits.erase(limb);
}

}  // namespace

void Editor::set_swing_limit(const command::SetSwingLimit& wanted) {
  const LimbModel* limb = state_.limb_model();
  const auto view = std::find_if(state_.swings.begin(), state_.swings.end(),
                                 [&](const SwingView& v) { return v.role == wanted.role; });
  if (!limb || view == state_.swings.end()) return;
  if (wanted.phase != Phase::cancelled && !wanted.polygon.empty()) {
    LimbModel tried = *limb;
    if (Status sound = set_swing_polygon(tried, wanted.role, wanted.polygon); !sound) {
      tell(Notice::Kind::error, sound.error());
      return;
    }
  }
  std::string joint = view->joint;
  std::transform(joint.begin(), joint.begin() + (joint.empty() ? 0 : 1), joint.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  edit((wanted.polygon.empty() ? "Own limit of the " : "Swing limit of the ") + joint, wanted.phase,
       [&, name = limb->limb.name](Document& document) {
         put_swing_limit(document, name, wanted.role, counter_clockwise(wanted.polygon));
       });
  if (!history_.previewing()) scene_changed();
}

void Editor::set_limb_joints(const command::SetLimbJoints& wanted) {
  if (!session_ || wanted.limb.empty()) return;
  const std::string title = limb_title(wanted.limb);
  if (wanted.joints && !wanted.joints->none()) {
    const Model& model = session_->scene.model();
    const auto limb = limb_between(model, session_->character(), wanted.limb, *wanted.joints);
    if (!limb) {
      tell(Notice::Kind::error, limb.error());
      return;
    }
    const auto fitted = fit_limb_model(model, session_->character(), *limb, session_->findings);
    if (!fitted) {
      tell(Notice::Kind::error, fitted.error());
      return;
    }
  }
  const std::string step = !wanted.joints          ? title + " as it is found"
                           : wanted.joints->none() ? title + " is no limb"
                                                   : "Joints of " + title;
  edit(step, Phase::committed, [&](Document& document) {
    const bool usual = limb_title(wanted.limb) != wanted.limb;
    if (wanted.joints && (usual || !wanted.joints->none()))
      document.limbs[wanted.limb] = *wanted.joints;
    else
      document.limbs.erase(wanted.limb);
    // What was being prepared for a limb that is none any more is for nobody.
    const bool gone = wanted.joints ? wanted.joints->none() : !usual;
    if (!gone || document.draft.limb != wanted.limb) return;
    document.draft.limb.clear();
    document.draft.window.reset();
    document.draft.target.reset();
  });
  scene_changed();
}

// The session with the document's limbs and swing limits, made in the background.
void Editor::refit() {
  // Whoever reads the files looks at the limbs again when they are read.
  if (!session_ || state_.opening.active) return;
  coming_scene_.reset();
  begin_job(opening_, state_.opening, "Finding limbs");
  opening_.stop =
      files_thread_.run([this, session = session_, document = history_.document(),
                         ticket = opening_.ticket, mailbox = mailbox_](const std::stop_token&) {
        auto fresh = std::make_shared<Session>(refit_project_session(*session, document));
        mailbox->post([this, ticket, fresh] {
          if (ticket != opening_.ticket) return;
          state_.opening.active = false;
          refitted(std::move(*fresh));
        });
      });
}

void Editor::refitted(Session session) {
  for (const auto& warning : session.warnings)
    if (std::find(session_->warnings.begin(), session_->warnings.end(), warning) ==
        session_->warnings.end())
      tell(Notice::Kind::warning, {warning, "", ""});
  if (state_.planning.active) cancel_plan();
  // Where only limits are others, the motion touches what it touched.
  const bool others = session.document.limbs != session_->document.limbs ||
                      session.limbs.size() != session_->limbs.size();
  take_session(std::move(session));
  if (others) {
    unseen_.reset();
    state_.strip.reset();
    state_.source_strip.reset();
    show_anew();
  } else {
    state_.candidate.reset();
    shown_target_.reset();
    shown_limb_.clear();
    refresh();
    prepare_contacts();
  }
  // The document may have gone on meanwhile.
  scene_changed();
}

}  // namespace elbowroom
