// SPDX-License-Identifier: MIT
#include "app/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/io/safe_file.h"

namespace elbowroom {
namespace {

using Json = nlohmann::ordered_json;

std::string limb_name(const SceneCollision& scene, int limb) {
  return limb < 0 ? std::string() : scene.limbs()[static_cast<std::size_t>(limb)].limb.name;
}

Json interval_json(const SceneCollision& scene, const ContactInterval& contact) {
  Json item;
  if (contact.deepest.limb >= 0) item["limb"] = limb_name(scene, contact.deepest.limb);
  item["pair"] = Json::array({contact.deepest.part_a, contact.deepest.part_b});
  item["interval"] = Json::array({contact.begin, contact.end});
  item["depth"] = contact.deepest.depth;
  item["time"] = contact.time_of_deepest;
  const Vec3& place = contact.deepest.place;
  item["place"] = Json::array({place.x, place.y, place.z});
  return item;
}

Json intervals_json(const SceneCollision& scene, const std::vector<ContactInterval>& contacts) {
  Json list = Json::array();
  for (const auto& contact : contacts) list.push_back(interval_json(scene, contact));
  return list;
}

Json allowed_json(const SceneCollision& scene) {
  Json list = Json::array();
  for (const auto& entry : scene.allowed_contacts().entries)
    list.push_back({{"pair", Json::array({entry.part_a, entry.part_b})},
                    {"reason", allowed_reason_id(entry.reason)},
                    {"patches", entry.patches},
                    {"depth", entry.depth}});
  return list;
}

std::string text_of(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json nothing_of(const std::string& status) {
  Json report;
  report["status"] = status;
  report["clip"] = Json();
  for (const char* list : {"corrections", "collisions_before", "collisions_after", "other_contacts",
                           "allowed_contacts", "limits_widened", "warnings"})
    report[list] = Json::array();
  return report;
}

}  // namespace

std::string correction_report(const std::string& status, const Session& session,
                              const SceneCollision& scene, const CorrectionOutcome& outcome,
                              const Outputs& outputs) {
  Json report;
  report["status"] = status;
  report["clip"] = session.clip_name();
  report["corrections"] = Json::array();
  Json widened = Json::array();
  for (const WindowReport& window : outcome.windows) {
    Json item;
    item["limb"] = limb_name(scene, window.limb);
    item["window"] = Json::array({window.begin, window.end});
    item["status"] = window.status == CorrectionStatus::corrected   ? "corrected"
                     : window.status == CorrectionStatus::cancelled ? "interrupted"
                                                                    : "failed";
    item["accepted"] = window.accepted;
    item["seed"] = window.seed;
    item["certified"] = window.certified;
    if (!window.not_certified.empty()) item["not_certified"] = window.not_certified;
    item["depth_sampled"] = window.depth_sampled;
    item["min_clearance"] = window.min_clearance;
    item["scene_clearance"] = window.scene_clearance;
    item["planned_clearance"] = window.planned_clearance;
    item["plan_ms"] = window.plan_ms;
    item["smooth_ms"] = window.smooth_ms;
    item["verify_ms"] = window.verify_ms;
    item["certify_ms"] = window.certify_ms;
    item["total_ms"] = window.total_ms;
    item["validity_checks"] = window.validity_checks;
    item["edge_checks"] = window.edge_checks;
    item["iterations"] = window.iterations;
    item["landmarks"] = window.landmarks;
    item["peak_speed"] = window.peak_speed;
    item["peak_acceleration"] = window.peak_acceleration;
    item["deviation_from_clip"] = window.deviation_from_clip;
    item["cost"] = window.accepted ? Json() : Json(window.cost);
    item["attempts"] = window.attempts;
    item["blocked_by"] = window.blocked_by.empty() ? Json() : Json(window.blocked_by);
    if (!window.reason.empty()) item["reason"] = window.reason;
    std::size_t rank = 1;
    for (const auto& other : outcome.other_ways) {
      if (&outcome.windows[other.window] != &window) continue;
      const WindowReport& way = other.report;
      Json entry{{"cost", way.cost},
                 {"seed", way.seed},
                 {"certified", way.certified},
                 {"min_clearance", way.min_clearance},
                 {"scene_clearance", way.scene_clearance},
                 {"peak_speed", way.peak_speed},
                 {"peak_acceleration", way.peak_acceleration},
                 {"deviation_from_clip", way.deviation_from_clip}};
      ++rank;
      if (outcome.windows.size() == 1) entry["file"] = other_way_file(outputs.out, rank).string();
      item["alternatives"].push_back(std::move(entry));
    }
    if (window.status == CorrectionStatus::failed) {
      item["suggestions"] = Json::array();
      for (const Suggestion& suggestion : window.suggestions)
        item["suggestions"].push_back(
            {{"what", suggestion_id(suggestion.kind)},
             {"works", suggestion.works},
             {"limb", suggestion.limb},
             {"window", Json::array({suggestion.window.lower, suggestion.window.upper})},
             {"text", suggestion.text()}});
    }
    report["corrections"].push_back(item);
    for (const auto& name : window.limits_widened)
      widened.push_back({{"limb", limb_name(scene, window.limb)}, {"dof", name}});
  }
  report["collisions_before"] = intervals_json(scene, outcome.before);
  report["collisions_after"] = intervals_json(scene, outcome.after);
  report["other_contacts"] = intervals_json(scene, outcome.other);
  report["allowed_contacts"] = allowed_json(scene);
  report["limits_widened"] = widened;
  report["warnings"] = session.warnings;
  for (const std::string& note : outcome.notes) report["warnings"].push_back(note);
  return text_of(report);
}

std::string check_report(const std::string& status, const Session& session,
                         const SceneCollision& scene, const std::vector<ContactInterval>& contacts,
                         const std::vector<ContactInterval>& others) {
  Json report;
  report["status"] = status;
  report["clip"] = session.clip_name();
  report["corrections"] = Json::array();
  report["collisions_before"] = intervals_json(scene, contacts);
  report["collisions_after"] = intervals_json(scene, contacts);
  report["other_contacts"] = intervals_json(scene, others);
  report["allowed_contacts"] = allowed_json(scene);
  report["limits_widened"] = Json::array();
  report["warnings"] = session.warnings;
  return text_of(report);
}

std::vector<std::string> not_looked_at(const Session& session) {
  const auto& all = session.document.corrections;
  const auto own = std::count_if(all.begin(), all.end(), [&](const Correction& correction) {
    return !correction.muted && session.is_of_clip(correction.clip);
  });
  if (own == 0) return {};
  return {"this is the source clip; the project's " + std::to_string(own) +
          (own == 1 ? " correction is" : " corrections are") +
          " not looked at (`elbowroom solve` verifies them)"};
}

std::string empty_report(const std::string& status) { return text_of(nothing_of(status)); }

std::string error_report(const Error& error) {
  Json report = nothing_of("bad_input");
  report["error"] = {{"what", error.what}, {"where", error.where}, {"remedy", error.remedy}};
  return text_of(report);
}

Status write_report(const std::filesystem::path& path, const std::string& text) {
  if (path.empty()) return Done{};
  return write_file_safely(path, text);
}

}  // namespace elbowroom
