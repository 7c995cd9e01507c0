// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/commands.h"
#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/report.h"
#include "app/terminal.h"

namespace elbowroom {
namespace {

constexpr double kScanRate = 120;  // Hz; ends of intervals are bisected further

}  // namespace

int run_check(const CheckOptions& options, Interruption& interruption) {
  Status usage = check_scene_options(options.scene);
  RunFiles files;
  files.reads(options.scene.project, "the project");
  files.writes(options.report, "--report");
  if (usage) usage = files.check_distinct();
  const auto wrong_usage = [](const Error& error) {
    print_error(error);
    return kExitUsage;
  };
  if (!usage) return wrong_usage(usage.error());
  const auto refused = [&](const Error& error) {
    return refuse(error, options.report, interruption);
  };
  const auto document = document_from(options.scene);
  if (!document) return refused(document.error());
  files.reads(document->scene);
  if (Status distinct = files.check_distinct(); !distinct) return wrong_usage(distinct.error());
  if (Status places = files.check_places(); !places) return refused(places.error());
  auto session = open_session(*document);
  if (!session) return refused(session.error());
  for (std::string& note : not_looked_at(*session)) session->warnings.push_back(std::move(note));
  print_warnings(session->warnings);
  const ProgressSink progress = terminal_progress();
  if (progress) progress({"looking for contacts", -1});
  auto scene = contacts_of(*session, interruption.token());
  if (!scene) return refused(scene.error());
  std::vector<ContactInterval> contacts, others;
  const auto& clip = session->clip();
  for (auto& contact :
       scene->scan(clip->begin, clip->end, kScanRate, -1, false, interruption.token()))
    (contact.deepest.limb < 0 ? others : contacts).push_back(contact);
  clear_progress();
  if (!interruption.settle()) return leave_interrupted(options.report, empty_report("interrupted"));

  const auto print = [&](const ContactInterval& contact) {
    std::printf(
        "  %-10s %7.3f - %7.3f s  depth %.4g at %.3f s  %s with %s\n",
        contact.deepest.limb < 0
            ? ""
            : session->limbs[static_cast<std::size_t>(contact.deepest.limb)].limb.name.c_str(),
        contact.begin, contact.end, contact.deepest.depth, contact.time_of_deepest,
        contact.deepest.part_a.c_str(), contact.deepest.part_b.c_str());
  };
  std::printf("%s, %.3f s: ", session->clip_name().c_str(), clip->duration());
  if (contacts.empty()) std::printf("no limb collides\n");
  if (!contacts.empty()) {
    std::printf("%zu contact%s of limbs\n", contacts.size(), contacts.size() == 1 ? "" : "s");
    for (const auto& contact : contacts) print(contact);
  }
  if (!others.empty()) {
    std::printf("other contacts, of no limb:\n");
    for (const auto& contact : others) print(contact);
  }
  const std::string report =
      check_report(contacts.empty() ? "free" : "contacts", *session, *scene, contacts, others);
  if (Status written = write_report(options.report, report); !written) {
    print_error(written.error());
    return kExitBadInput;
  }
  return contacts.empty() ? kExitDone : kExitContacts;
}

}  // namespace elbowroom
