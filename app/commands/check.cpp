// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/report.h"
#include "app/terminal.h"

namespace elbowroom {
namespace {

constexpr double kScanRate = 120;  // Hz; ends of intervals are bisected further

}  // namespace

int run_check(const CheckOptions& options, std::stop_token stop) {
  const auto document = document_from(options.scene);
  if (!document) {
    print_error(document.error());
    return options.scene.project.empty() ? kExitUsage : kExitBadInput;
  }
  const auto refuse = [&](const Error& error) {
    print_error(error);
    if (Status written = write_report(options.report, error_report(error)); !written)
      print_error(written.error());
    return kExitBadInput;
  };
  auto session = open_session(*document);
  if (!session) return refuse(session.error());
  print_warnings(session->warnings);
  const ProgressSink progress = terminal_progress();
  if (progress) progress({"looking for contacts", -1});
  auto scene = contacts_of(*session, stop);
  if (!scene && stop.stop_requested()) return kExitInterrupted;
  if (!scene) return refuse(scene.error());
  std::vector<ContactInterval> contacts, others;
  const auto& clip = session->clip();
  for (auto& contact : scene->scan(clip->begin, clip->end, kScanRate, -1, false, stop))
    (contact.deepest.limb < 0 ? others : contacts).push_back(contact);
  clear_progress();
  if (stop.stop_requested()) return kExitInterrupted;

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
    std::printf("%zu contacts of limbs\n", contacts.size());
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
