// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/report.h"
#include "app/terminal.h"
#include "core/editing/session.h"
#include "core/io/run_files.h"
#include "render/filmstrip.h"

namespace elbowroom {
namespace {

constexpr Rgb kBefore = 0xff7a45, kAfter = 0x3ecf9a;

// Where limbs touch at each time, and the limb that does so most often (-1: none).
std::vector<std::vector<ContactMark>> marks_at(SceneCollision& scene,
                                               const std::vector<double>& times, int& acting) {
  std::vector<std::vector<ContactMark>> marks;
  std::vector<int> hits(scene.limbs().size(), 0);
  std::vector<ContactSample> contacts;
  for (const double t : times) {
    scene.contacts_at(t, -1, false, contacts);
    auto& here = marks.emplace_back();
    for (const auto& contact : contacts) {
      if (contact.limb < 0) continue;
      ContactMark mark;
      mark.place = contact.place;
      here.push_back(mark);
      ++hits[static_cast<std::size_t>(contact.limb)];
    }
  }
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i] > (acting < 0 ? 0 : hits[static_cast<std::size_t>(acting)]))
      acting = static_cast<int>(i);
  return marks;
}

int bad_input(const Error& error) {
  print_error(error);
  return kExitBadInput;
}

int wrong_usage(const Error& error) {
  print_error(error);
  return kExitUsage;
}

}  // namespace

int run_render(const RenderOptions& options, Interruption& interruption) {
  const auto times = parse_times(options.times);
  Status usage = check_scene_options(options.scene);
  if (usage) usage = check_file_name(options.out, "-o");
  if (usage && !times) usage = times.error();
  if (!usage) return wrong_usage(usage.error());
  const auto document = document_from(options.scene);
  if (!document) return bad_input(document.error());
  RunFiles files;
  files.reads(options.scene.project, "the project");
  files.reads(document->scene);
  files.writes(options.out, "-o");
  if (Status distinct = files.check_distinct(); !distinct) return wrong_usage(distinct.error());
  if (Status places = files.check_places(); !places) return bad_input(places.error());
  auto session = open_session(*document);
  if (!session) return bad_input(session.error());
  std::vector<std::string> warnings = session->warnings;
  for (std::string& note : not_looked_at(*session)) warnings.push_back(std::move(note));

  FilmstripRequest request;
  request.times = *times;
  request.columns = options.columns;
  request.frame_width = options.width;
  request.frame_height = options.height;
  request.character = session->scene.character;
  request.title = session->character().name;
  request.caption = session->clip_name();

  // The other version: the same world, another clip of the character.
  World compared = session->scene.world;
  if (!options.compare_clip.empty()) {
    const auto& model = compared.actors.front().model;
    const int clip = model->find_clip(options.compare_clip);
    if (clip < 0)
      return bad_input({"there is no clip \"" + options.compare_clip + "\" to compare with",
                        session->document.scene.character.string(),
                        "`elbowroom info` lists its clips"});
    compared.actors.front().clip = {model, &model->clips[static_cast<std::size_t>(clip)]};
  }

  int acting = -1;
  FilmstripRow first, second;
  first.world = &session->scene.world;
  if (session->clip()) {
    auto scene = contacts_of(*session);
    if (!scene) return bad_input(scene.error());
    first.contacts = marks_at(*scene, *times, acting);
    if (!options.compare_clip.empty()) {
      scene->set_clip(compared.actors.front().clip);
      second.contacts = marks_at(*scene, *times, acting);
    }
  }
  if (acting >= 0) {
    request.limb = session->limbs[static_cast<std::size_t>(acting)].limb.joints;
    for (const auto& own : session->limbs[static_cast<std::size_t>(acting)].limb.following)
      request.limb.push_back(own.joint);
    std::string limb = session->limbs[static_cast<std::size_t>(acting)].limb.name;
    std::replace(limb.begin(), limb.end(), '_', ' ');
    request.caption += "   " + limb;
  }
  request.rows.push_back(first);
  if (!options.compare_clip.empty()) {
    second.world = &compared;
    request.rows[0].label = session->clip_name();
    second.label = compared.actors.front().clip->name;
    // The row whose clip was made from the other is the one that was corrected.
    const bool second_is_corrected = second.label.find(request.rows[0].label) == 0;
    request.rows[0].label_colour = second_is_corrected ? kBefore : kAfter;
    second.label_colour = second_is_corrected ? kAfter : kBefore;
    request.rows.push_back(second);
  }
  const auto picture = render_filmstrip(request, &warnings);
  print_warnings(warnings);
  if (!picture) return bad_input(picture.error());
  const auto bytes = encode_png(*picture);
  if (!bytes) return bad_input(bytes.error());
  if (!interruption.settle()) return kExitInterrupted;
  Status written =
      files.stage(options.out, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (written) written = files.commit();
  if (!written) return bad_input(written.error());
  std::printf("wrote %s, %d x %d\n", options.out.c_str(), picture->width, picture->height);
  return kExitDone;
}

}  // namespace elbowroom
